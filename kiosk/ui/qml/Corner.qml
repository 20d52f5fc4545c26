// What a visitor can do on every screen: hear the last sentence again, sound, text size, language, stop; on the start
// screen, sound and text size.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

Grid {
    id: corner

    required property KioskScreen kiosk
    required property var words
    // Whether there is a sentence of the game to be heard again.
    required property bool canRepeat
    required property int places

    readonly property real step: 64 * Theme.unit + spacing
    // Its size with the sentence to be heard again, whether or not there is one now: nothing moves when that comes.
    readonly property int slots: 2 + (kiosk.inSession ? 1 : 0) + (kiosk.inSession && kiosk.languages.length > 1 ? 1 : 0)
        + (kiosk.audible ? 1 : 0)
    readonly property real fullWidth: Math.min(slots, places) * step - spacing
    readonly property real fullHeight: Math.ceil(slots / places) * step - spacing

    columns: places
    spacing: 10 * Theme.unit
    layoutDirection: Qt.RightToLeft
    enabled: kiosk.bare && kiosk.takesInput

    CornerButton {
        objectName: "control-stop"
        visible: corner.kiosk.inSession
        words: corner.words["control-stop"]
        drawing: "M6 6 L18 18 M18 6 L6 18"
        onClicked: corner.kiosk.ask("stop")
    }
    CornerButton {
        objectName: "control-language"
        // On the start screen, every language has a button of its own.
        visible: corner.kiosk.inSession && corner.kiosk.languages.length > 1
        words: corner.words["control-language"]
        drawing: "M12 3 A9 9 0 0 1 12 21 A9 9 0 0 1 12 3 M3.5 9.5 H20.5 M3.5 14.5 H20.5 M12 3 C7.5 8 7.5 16 12 21 M12 3 C16.5 8 16.5 16 12 21"
        onClicked: corner.kiosk.ask("language")
    }
    CornerButton {
        id: size
        objectName: "control-text-size"
        words: corner.words["control-text-size"]
        drawing: "M2.5 16 L6.5 7 L10.5 16 M4 13 H9 M11.5 16 L16.5 3.5 L21.5 16 M13.5 12 H19.5"
        Accessible.description: `${corner.kiosk.textStep + 1} / 3`
        onClicked: corner.kiosk.changeTextSize()
        // Which of the three steps it is.
        Row {
            anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: 9 * Theme.unit }
            spacing: 4 * Theme.unit
            Repeater {
                model: 3
                Rectangle {
                    required property int index
                    width: 7 * Theme.unit
                    height: width
                    radius: width / 2
                    color: index <= corner.kiosk.textStep ? Theme.sea : Theme.edge
                }
            }
        }
    }
    CornerButton {
        objectName: "control-sound"
        visible: corner.kiosk.audible
        words: corner.words[corner.kiosk.sound ? "control-sound-off" : "control-sound-on"]
        drawing: "M3.5 9.5 H7 L12 5 V19 L7 14.5 H3.5 Z " + (corner.kiosk.sound
            ? "M15.5 9 C17 10.7 17 13.3 15.5 15 M18 6.5 C21 9.6 21 14.4 18 17.5" : "M16 9.5 L21 14.5 M21 9.5 L16 14.5")
        onClicked: corner.kiosk.changeSound()
    }
    CornerButton {
        objectName: "control-say-again"
        visible: corner.canRepeat
        words: corner.words["control-say-again"]
        drawing: "M18.5 8 A8 8 0 1 0 20 12.5 M19.5 3.5 V8.5 H14.5"
        onClicked: corner.kiosk.sayAgain()
    }
}
