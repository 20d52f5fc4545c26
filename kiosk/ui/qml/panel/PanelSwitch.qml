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
    readonly property real knob: 40 * Theme.unit

    choosable: true
    chosen: on
    verticalPadding: 4 * Theme.unit
    readonly property real between: 0.6 * Theme.gap
    Accessible.role: Accessible.CheckBox

    contentItem: Item {
        id: parts
        readonly property real before: bar.sign > 0 ? bar.sign + 0.6 * bar.font.pixelSize : 0
        readonly property real behind: bar.between + Math.ceil(state.width) + 0.85 * bar.between + track.width
        implicitWidth: before + Math.ceil(natural.advanceWidth(bar.words)) + 2 * Theme.unit + behind
        implicitHeight: Math.max(letters.implicitHeight, track.height)
        // As wide as in bold, so that its words stay where they are.
        FontMetrics {
            id: natural
            font { family: bar.font.family; pixelSize: bar.font.pixelSize; bold: true }
        }
        PlainText {
            id: state
            x: Theme.across(parts.width - track.width - 0.85 * bar.between - width, width, parts.width)
            y: (parts.height - height) / 2
            width: Math.ceil(Math.max(natural.advanceWidth(bar.whenOn), natural.advanceWidth(bar.whenOff)))
            text: bar.on ? bar.whenOn : bar.whenOff
            font: bar.font
            color: bar.front
            horizontalAlignment: Text.AlignRight
            Accessible.ignored: true
        }
        Drawing {
            visible: bar.drawing !== ""
            x: Theme.across((bar.sign - width) / 2, width, parts.width)
            y: (parts.height - height) / 2
            scale: bar.sign / 24
            path: bar.drawing
            ink: bar.front
        }
        Balanced {
            id: letters
            x: Theme.across(parts.before, width, parts.width)
            y: (parts.height - height) / 2
            width: parts.width - parts.before - parts.behind
            text: bar.words
            font: bar.font
            color: bar.front
            horizontalAlignment: Text.AlignLeft
            least: 0.6
            lineHeight: 0.9
            Accessible.ignored: true
        }
        // The knob says which it is without a colour.
        Rectangle {
            id: track
            x: Theme.across(parent.width - width, width, parent.width)
            y: (parent.height - height) / 2
            width: 1.9 * bar.knob + 12 * Theme.unit
            height: bar.knob + 12 * Theme.unit
            radius: height / 2
            color: bar.on ? Theme.white : Theme.shelf
            border { color: bar.on ? Theme.white : Theme.faintInk; width: 3 * Theme.unit }
            Rectangle {
                readonly property real edge: (track.height - height) / 2
                x: Theme.across(bar.on ? track.width - edge - width : edge, width, track.width)
                y: edge
                width: bar.on ? bar.knob : 0.8 * bar.knob
                height: width
                radius: width / 2
                color: bar.on ? Theme.sea : Theme.faintInk
            }
        }
    }
}
