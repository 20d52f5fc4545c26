// A page: it is made when it is first shown, or before that while nothing else happens; then it stays.
import QtQuick
import Recollect
import "."

Loader {
    id: page

    required property string name
    required property KioskScreen kiosk
    required property WindowLayout windowLayout
    // Whether it is made before it is shown, in the time between frames.
    required property bool prepares
    readonly property bool shown: kiosk.screen === name
    // What of it the helper says.
    readonly property string aside: (item as PageFrame)?.aside ?? ""
    // A page that is not seen keeps its size until it is filled: laying out all their texts anew holds up the others.
    readonly property bool follows: shown || status !== Loader.Ready || windowLayout.wide && kiosk.coming === name
    Binding on width { when: page.follows; value: page.windowLayout.widthOn(page.name); restoreMode: Binding.RestoreNone }
    Binding on height { when: page.follows; value: page.windowLayout.heightOn(page.name); restoreMode: Binding.RestoreNone }
    asynchronous: !shown
    visible: shown && status === Loader.Ready
    focus: visible && kiosk.bare
    active: prepares
    onShownChanged: if (shown) active = true
}
