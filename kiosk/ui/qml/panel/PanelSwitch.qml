// A button of the panel that turns one thing on and off, and says which of the two it is: filled when on, outlined when off.
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

    // As wide in both, so that its words stay where they are.
    font.bold: false
    choosable: true
    chosen: on
    verticalPadding: (stacked ? 9 : 4) * Theme.unit
    readonly property real between: 0.45 * Theme.gap
    Accessible.role: Accessible.CheckBox

    contentItem: Item {
        id: parts
        readonly property real before: bar.sign > 0 && !bar.stacked ? bar.sign + 0.6 * bar.font.pixelSize : 0
        readonly property real above: bar.stacked ? Math.max(bar.sign, track.height) + 0.3 * bar.font.pixelSize : 0
        implicitWidth: bar.stacked ? wide(bar.words, bar.font) : before + wide(bar.words, bar.font) + bar.between + track.width
        implicitHeight: bar.stacked ? above + letters.implicitHeight : Math.max(letters.implicitHeight, track.height)
        // What is measured depends on the font, which is named for that reason alone.
        function wide(text: string, _font: font): real {
            return Math.ceil(natural.advanceWidth(text)) + 2 * Theme.unit
        }
        FontMetrics {
            id: natural
            font: bar.font
        }
        // Only where its words need no second line for it.
        PlainText {
            id: state
            readonly property real spare: parts.width - parts.before - parts.wide(bar.words, bar.font) - bar.between - track.width - width
            readonly property real after: Math.min(14 * Theme.unit, spare)
            readonly property real room: visible ? width + after : 0
            visible: !bar.stacked && spare >= 4 * Theme.unit
            x: parts.width - track.width - after - width
            y: (parts.height - height) / 2
            width: Math.ceil(0.92 * Math.max(parts.wide(bar.whenOn, bar.font), parts.wide(bar.whenOff, bar.font)))
            text: bar.on ? bar.whenOn : bar.whenOff
            font.pixelSize: 0.92 * bar.font.pixelSize
            color: bar.front
            horizontalAlignment: Text.AlignRight
            Accessible.ignored: true
        }
        Drawing {
            visible: bar.drawing !== "" && !bar.stacked
            x: (bar.sign - width) / 2
            y: (parts.height - height) / 2
            scale: bar.sign / 24
            path: bar.drawing
            ink: bar.front
        }
        Balanced {
            id: letters
            x: parts.before
            y: (bar.stacked ? 0.72 * parts.height : 0.5 * parts.height) - height / 2
            width: bar.stacked ? parts.width : parts.width - parts.before - bar.between - state.room - track.width
            text: bar.words
            font: bar.font
            color: bar.front
            horizontalAlignment: bar.stacked ? Text.AlignHCenter : Text.AlignLeft
            least: 0.6
            lineHeight: bar.stacked ? 1 : 0.9
            Accessible.ignored: true
        }
        // The knob says which it is without a colour.
        Rectangle {
            id: track
            x: bar.stacked ? (parts.width - width) / 2 : parts.width - width
            y: (bar.stacked ? 0.3 * parts.height : 0.5 * parts.height) - height / 2
            width: 1.9 * bar.knob + 12 * Theme.unit
            height: bar.knob + 12 * Theme.unit
            radius: height / 2
            color: bar.on ? Theme.white : Theme.shelf
            border { color: bar.on ? Theme.white : Theme.faintInk; width: 3 * Theme.unit }
            Rectangle {
                readonly property real edge: (track.height - height) / 2
                x: bar.on ? track.width - edge - width : edge
                y: edge
                width: bar.on ? bar.knob : 0.8 * bar.knob
                height: width
                radius: width / 2
                color: bar.on ? Theme.sea : Theme.faintInk
            }
        }
    }
}
