// All of the experimenter: the shortcuts, the card that asks, the note at the edge, and the panel over everything.
pragma ComponentBehavior: Bound
import QtQuick
import QtQml
import Recollect
import ".."

Item {
    id: desk

    required property ExperimenterScreen experimenter
    // The corner that is held is an upper one: the other than that of the visitor's buttons.
    property bool holdsRight: false

    Instantiator {
        model: desk.experimenter.shortcuts
        delegate: Shortcut {
            id: shortcut
            required property var modelData
            sequence: shortcut.modelData.shortcut
            context: Qt.ApplicationShortcut
            autoRepeat: false
            onActivated: desk.experimenter.press(shortcut.modelData.action)
        }
    }
    // It speaks the experimenter's language, and stays as it is while a visitor's is written from right to left.
    Loader {
        id: panel
        anchors.fill: parent
        active: desk.experimenter.panel.shown
        focus: active
        sourceComponent: PanelView { panel: desk.experimenter.panel }
    }
    // Calls the experimenter without a word: a visitor may be looking.
    Text {
        objectName: "alarm-mark"
        anchors { top: parent.top; horizontalCenter: parent.horizontalCenter; topMargin: 8 * Theme.unit }
        visible: desk.experimenter.calls && !desk.experimenter.panel.shown
        textFormat: Text.PlainText
        text: "▲"
        font.pixelSize: Theme.denser
        color: Theme.deepAmber
        Accessible.ignored: true
    }
    PanelNote {
        // At the lower edge while the panel is open, over what is read last there.
        x: (parent.width - width) / 2
        y: desk.experimenter.panel.shown ? parent.height - height - 14 * Theme.unit : 14 * Theme.unit
        note: desk.experimenter.note
    }
    // For a booth without a keyboard. What lies below takes every touch as if this were not here.
    Item {
        objectName: "hold-corner"
        enabled: desk.experimenter.cornerHolds
        Accessible.ignored: true
        x: desk.holdsRight ? parent.width - width : 0
        width: 110 * Theme.unit
        height: width
        TapHandler {
            objectName: "hold"
            longPressThreshold: 3
            onLongPressed: desk.experimenter.hold()
        }
    }
    // Made when it is first asked for, as few visits need it; then it stays.
    Loader {
        readonly property bool shown: desk.experimenter.card.step !== ""
        anchors { top: parent.top; right: parent.right; margins: Theme.gap }
        active: false
        onShownChanged: if (shown) active = true
        sourceComponent: PinCard {
            card: desk.experimenter.card
            words: desk.experimenter.panel.words
        }
    }
}
