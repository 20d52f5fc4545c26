// A part that a session needs at any time: where nothing is made between frames, it comes with the session.
import QtQuick

Loader {
    required property bool shown
    // Whether a session needs it by now or soon, and whether it is then made in the time between frames.
    required property bool needed
    required property bool prepares
    readonly property bool wanted: shown || needed
    asynchronous: prepares && !shown
    visible: shown && status === Loader.Ready
    active: false
    onWantedChanged: if (wanted) active = true
}
