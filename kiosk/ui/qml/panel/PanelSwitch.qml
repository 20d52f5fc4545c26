// Turns one thing on and off, and says which of the two it is: by its knob, by a word, and by its colour.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: bar

    required property bool on
    // What stands beside the knob: that it is on, and that it is off.
    required property string whenOn
    required property string whenOff
    readonly property real knob: 34 * Theme.unit
    readonly property real between: 0.45 * Theme.gap

    choosable: true
    chosen: on
    // It has no face of its own: what is filled beside it is what is pressed.
    solid: false
    Accessible.role: Accessible.CheckBox

    contentItem: Item {
        id: parts
        implicitWidth: wide(bar.words, bar.font) + bar.between + track.width
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
            width: parts.width - bar.between - state.room - track.width
            text: bar.words
            font: bar.font
            color: bar.front
            horizontalAlignment: Text.AlignLeft
            least: 0.6
            lineHeight: 0.9
            Accessible.ignored: true
        }
        // Only where its words need no second line for it.
        PlainText {
            id: state
            readonly property real spare: parts.width - parts.wide(bar.words, bar.font) - bar.between - track.width - width
            readonly property real after: Math.min(14 * Theme.unit, spare)
            readonly property real room: visible ? width + after : 0
            visible: spare >= 4 * Theme.unit
            x: parts.width - track.width - after - width
            y: (parts.height - height) / 2
            width: Math.ceil(Math.max(parts.wide(bar.whenOn, bar.font), parts.wide(bar.whenOff, bar.font)))
            text: bar.on ? bar.whenOn : bar.whenOff
            font.pixelSize: bar.font.pixelSize
            color: bar.front
            horizontalAlignment: Text.AlignRight
            Accessible.ignored: true
        }
        Rectangle {
            id: track
            x: parts.width - width
            y: (parts.height - height) / 2
            width: 1.9 * bar.knob + 12 * Theme.unit
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
