// Turns one thing on and off, and shows which of the two it is: by the place of its knob, a tick on it, and its colour.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: bar

    required property bool on
    readonly property real knob: 42 * Theme.unit
    readonly property real reach: 1.9 * knob + 12 * Theme.unit
    readonly property real between: 0.6 * Theme.gap

    choosable: true
    chosen: on
    // It has no face of its own: what is filled beside it is what is pressed.
    solid: false
    Accessible.role: Accessible.CheckBox

    contentItem: Item {
        id: parts
        implicitWidth: wide(bar.words, bar.font) + bar.between + bar.reach
        implicitHeight: Math.max(letters.implicitHeight, track.height)
        // What is measured depends on the font, which is named for that reason alone.
        function wide(text: string, _font: font): real {
            return Math.ceil(natural.advanceWidth(text)) + 2 * Theme.unit
        }
        FontMetrics {
            id: natural
            font: bar.font
        }
        Balanced {
            id: letters
            anchors.verticalCenter: parent.verticalCenter
            width: parts.width - bar.between - bar.reach
            text: bar.words
            font: bar.font
            color: Theme.ink
            horizontalAlignment: Text.AlignLeft
            least: 0.6
            lineHeight: 0.9
            Accessible.ignored: true
        }
        Rectangle {
            id: track
            x: parts.width - width
            y: (parts.height - height) / 2
            width: bar.reach
            height: bar.knob + 12 * Theme.unit
            radius: height / 2
            color: bar.on ? Theme.sea : Theme.white
            border { color: bar.on ? Theme.sea : Theme.faintInk; width: 3 * Theme.unit }
            Rectangle {
                readonly property real edge: (track.height - height) / 2
                x: bar.on ? track.width - edge - width : edge
                y: edge
                width: bar.on ? bar.knob : 0.8 * bar.knob
                height: width
                radius: width / 2
                color: bar.on ? Theme.white : Theme.faintInk
                Drawing {
                    visible: bar.on
                    anchors.centerIn: parent
                    scale: 0.8 * bar.knob / 24
                    thick: 3
                    path: "M5 12.5 L10 17.5 L19 7"
                    ink: Theme.sea
                }
            }
        }
    }
    background: Item {
        FocusRing {
            around: bar
            reach: 0
            radius: 12 * Theme.unit
        }
    }
}
