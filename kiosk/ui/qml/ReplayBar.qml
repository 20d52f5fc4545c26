// Below a replay: where it is, and the keys that drive it.
import QtQuick
import Recollect
import "."

Rectangle {
    id: bar

    required property ReplayControls replay
    required property var words

    color: Theme.ink

    Shortcut { sequence: "Space"; autoRepeat: false; onActivated: bar.replay.toggle() }
    Shortcut { sequence: "Right"; onActivated: bar.replay.step() }
    Shortcut { sequence: "Left"; onActivated: bar.replay.back() }
    Shortcut { sequence: "Home"; onActivated: bar.replay.seek(0) }
    Shortcut { sequence: "End"; onActivated: bar.replay.seek(bar.replay.steps) }
    Shortcut { sequences: ["Up", "+"]; onActivated: bar.replay.faster() }
    Shortcut { sequences: ["Down", "-"]; onActivated: bar.replay.slower() }
    Shortcut { sequences: ["Escape", "Q", "Ctrl+Q"]; autoRepeat: false; onActivated: bar.replay.leave() }

    component Words: PlainText {
        anchors.verticalCenter: parent.verticalCenter
        font.pixelSize: 20
        color: Theme.paper
    }

    Row {
        anchors { left: parent.left; leftMargin: Theme.gap; verticalCenter: parent.verticalCenter }
        height: parent.height
        spacing: Theme.gap
        Words { text: bar.replay.runs ? "▶" : "❚❚"; width: 28 }
        Words { text: bar.replay.title; font.bold: true }
        Words { text: bar.replay.position; color: bar.replay.differs ? Theme.amber : Theme.paper }
        Words { visible: bar.replay.differs; text: bar.words["replay-differs"]; color: Theme.amber; font.bold: true }
    }
    Words {
        anchors { right: parent.right; rightMargin: Theme.gap }
        text: bar.replay.speed + "     Space  ← →  ↑ ↓  Esc"
    }
    Rectangle {
        anchors { left: parent.left; right: parent.right; top: parent.top }
        height: 8 * Theme.unit
        color: Theme.faintInk
        Rectangle {
            width: parent.width * bar.replay.played / Math.max(1, bar.replay.steps)
            height: parent.height
            color: Theme.amber
        }
        MouseArea {
            objectName: "replay-line"
            // Not a stop of Tab's: its keys are the arrows, wherever the keyboard is.
            Accessible.role: Accessible.Slider
            Accessible.name: bar.words["replay-line"]
            Accessible.description: bar.replay.position
            Accessible.onIncreaseAction: bar.replay.step()
            Accessible.onDecreaseAction: bar.replay.back()
            anchors { fill: parent; bottomMargin: -10 * Theme.unit }
            onClicked: mouse => bar.replay.seek(Math.round(mouse.x / width * bar.replay.steps))
        }
    }
}
