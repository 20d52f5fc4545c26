// A button of the panel that turns one thing on and off, and shows which of the two it is.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: bar

    required property bool on
    readonly property real knob: 40 * Theme.unit
    readonly property color front: solid ? Theme.white : tone

    choosable: true
    chosen: on
    horizontalPadding: 24 * Theme.unit
    // As wide in both, so that its words stay where they are.
    font.bold: true
    Accessible.role: Accessible.CheckBox

    contentItem: Item {
        id: parts
        implicitWidth: letters.implicitWidth + track.width + Theme.gap
        implicitHeight: Math.max(letters.implicitHeight, track.height)
        Balanced {
            id: letters
            x: Theme.across(0, width, parts.width)
            y: (parts.height - height) / 2
            width: parts.width - track.width - Theme.gap
            text: bar.words
            font: bar.font
            color: bar.front
            horizontalAlignment: Text.AlignLeft
            least: 0.6
            Accessible.ignored: true
        }
        // Filled when on; when off, only an outline. The knob says so without a colour.
        Rectangle {
            id: track
            x: Theme.across(parts.width - width, width, parts.width)
            y: (parts.height - height) / 2
            width: 1.9 * bar.knob + 12 * Theme.unit
            height: bar.knob + 12 * Theme.unit
            radius: height / 2
            color: bar.on ? bar.front : "transparent"
            border { color: bar.front; width: 3 * Theme.unit }
            Rectangle {
                readonly property real edge: (track.height - height) / 2
                x: Theme.across(bar.on ? track.width - edge - width : edge, width, track.width)
                y: edge
                width: bar.on ? bar.knob : 0.8 * bar.knob
                height: width
                radius: width / 2
                color: bar.on ? (bar.solid ? Theme.sea : Theme.white) : bar.front
            }
        }
    }
}
