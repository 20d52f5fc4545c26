// What a visitor can do on every screen: stop, language, text size, sound, hear the last sentence again; on the start
// screen, text size and sound. They go on in this order from the corner, as a row or as a column.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

Item {
    id: corner

    required property KioskScreen kiosk
    required property var words
    // Whether there is a sentence of the game to be heard again.
    required property bool canRepeat
    // How many stand in a row; 1 for a column, whose first is the lowest.
    required property int places

    readonly property real spacing: 12 * Theme.unit
    // A column has room for larger ones than a row, unless larger texts need it.
    readonly property real size: (places === 1 && Theme.textSize <= 1 ? 80 : 68) * Theme.unit
    readonly property real step: size + spacing
    // How much further from the others the one stands that ends everything.
    readonly property real apart: kiosk.inSession ? 12 * Theme.unit : 0
    readonly property bool translated: kiosk.inSession && kiosk.languages.length > 1
    readonly property list<bool> shown: [kiosk.inSession, translated, true, kiosk.audible, canRepeat]
    readonly property int count: before(shown.length)
    // Its size with the sentence to be heard again, whether or not there is one now: nothing moves when that comes.
    readonly property int slots: before(shown.length - 1) + 1
    readonly property real fullWidth: long(slots) + (places > 1 ? apart : 0)
    readonly property real fullHeight: high(slots) + (places > 1 ? 0 : apart)

    // How many are seen before this one.
    function before(at: int): int {
        return shown.filter((seen, i) => seen && i < at).length
    }

    // How much room so many need, but for the gap after the first.
    function long(many: int): real {
        return Math.min(many, places) * step - spacing
    }
    function high(many: int): real {
        return Math.ceil(many / places) * step - spacing
    }

    width: long(count) + (places > 1 ? apart : 0)
    height: high(count) + (places > 1 ? 0 : apart)
    enabled: kiosk.bare && kiosk.takesInput

    component Control: CornerButton {
        required property int at
        readonly property int nth: corner.before(at)
        visible: corner.shown[at]
        width: corner.size
        readonly property real past: at > 0 ? corner.apart : 0
        x: corner.width - nth % corner.places * corner.step - width - (corner.places > 1 && nth < corner.places ? past : 0)
        y: corner.places === 1 ? corner.height - nth * corner.step - height - past : Math.floor(nth / corner.places) * corner.step
    }

    Control {
        at: 0
        objectName: "control-stop"
        words: corner.words["control-stop"]
        drawing: "M6 6 L18 18 M18 6 L6 18"
        onClicked: corner.kiosk.ask("stop")
    }
    Control {
        at: 1
        objectName: "control-language"
        // On the start screen, every language has a button of its own.
        words: corner.words["control-language"]
        drawing: "M12 3 A9 9 0 0 1 12 21 A9 9 0 0 1 12 3 M3.5 9.5 H20.5 M3.5 14.5 H20.5 M12 3 C7.5 8 7.5 16 12 21 M12 3 C16.5 8 16.5 16 12 21"
        onClicked: corner.kiosk.ask("language")
    }
    Control {
        at: 2
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
                    color: index <= corner.kiosk.textStep ? Theme.sea : Theme.highContrast ? Theme.white : Theme.edge
                    border { color: Theme.edge; width: Theme.highContrast ? Theme.unit : 0 }
                }
            }
        }
    }
    Control {
        at: 3
        objectName: "control-sound"
        words: corner.words[corner.kiosk.sound ? "control-sound-off" : "control-sound-on"]
        drawing: "M3.5 9.5 H7 L12 5 V19 L7 14.5 H3.5 Z " + (corner.kiosk.sound
            ? "M15.5 9 C17 10.7 17 13.3 15.5 15 M18 6.5 C21 9.6 21 14.4 18 17.5" : "M16 9.5 L21 14.5 M21 9.5 L16 14.5")
        onClicked: corner.kiosk.changeSound()
    }
    Control {
        at: 4
        objectName: "control-say-again"
        words: corner.words["control-say-again"]
        // A speech bubble, and in it an arrow that turns back.
        drawing: "M4 1 H20 A3 3 0 0 1 23 4 V16 A3 3 0 0 1 20 19 H11.5 L6.5 23.5 V19 H4 A3 3 0 0 1 1 16 V4 A3 3 0 0 1 4 1 Z M15.8 7.6 A4.6 4.6 0 1 0 16.6 10.6 M16.4 4.4 V8 H12.8"
        onClicked: corner.kiosk.sayAgain()
    }
}
