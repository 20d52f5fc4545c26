// A line between two ends. Its handle is not there until the visitor puts it somewhere.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import ".."

Item {
    id: scale

    required property string item
    required property string label
    required property int lowest
    required property int highest
    required property string leftEnd
    required property string rightEnd
    required property string none       // "nothing is chosen yet"
    required property string touch      // "touch the line"
    required property bool answered
    required property int given
    required property bool alone
    required property bool dense        // whether there is little height for it
    // Whether there is much height for it.
    property bool large: false
    // Whether it is a row of a table, as high as the points of the others.
    property bool own: false
    // How wide the words for its ends are where they stand under the ends of the line; 0 where they do not.
    property real ends: 0
    property real otherEnds: ends
    // Whether each of them has one line there.
    property bool lined: false
    // Whether they stand at both sides of the line instead, level with it.
    property bool flanked: false
    // How large the words for its ends are where they stand so.
    property real endSize: Theme.size(28)
    signal chosen(int value)

    readonly property int range: highest - lowest
    readonly property int leap: Math.max(1, Math.round(range / 10))
    // How high the line is: as easy to hit as a point of the others.
    readonly property real rail: (own ? 60 : large || alone ? 66 : 64) * Theme.unit
    // The handle, with room around it in the line.
    readonly property real thickness: rail - 12 * Theme.unit

    // How large the hand is that points at the line, and what there is to do above it.
    readonly property real hand: (large || alone ? 60 : own ? 46 : 38) * Theme.unit
    readonly property real hintHeight: Math.max(hand, 1.37 * (level ? Theme.small : lower.font.pixelSize))
    readonly property real above: hintHeight + (own ? 1 : 4) * Theme.unit

    readonly property real words: Math.max(lower.height, upper.height)
    readonly property real apart: (own ? 3 : 4) * Theme.unit
    // In a row its line begins and ends where the points of the others do.
    readonly property real point: (lined ? 84 : 80) * Theme.unit
    readonly property real inset: !flanked && own && ends > 0 ? Math.max(0, (ends - point) / 2) : 0
    readonly property real otherInset: !flanked && own && ends > 0 ? Math.max(0, (otherEnds - point) / 2) : 0
    // How far the words for its ends stand within its round ends.
    readonly property real round: 8 * Theme.unit
    // Among other kinds of items the ends stand beside the line, and what there is to do in it.
    readonly property bool level: !own && !alone && !large
    readonly property real most: 250 * Theme.unit * Theme.textSize
    readonly property bool below: !flanked && (!level || width < 4 * most)
    readonly property real leftRoom: flanked ? ends + Theme.gap : below ? 0 : Math.min(lower.implicitWidth, most) + Theme.gap
    readonly property real rightRoom: flanked ? otherEnds + Theme.gap : below ? 0 : Math.min(upper.implicitWidth, most) + Theme.gap

    height: flanked ? above + rail : below ? above + slider.height + apart + words : Math.max(above + slider.height, words)

    PlainText {
        id: lower
        y: scale.below ? slider.y + slider.height + scale.apart : slider.y + (slider.height - height) / 2
        x: Theme.across(scale.below ? scale.inset + scale.round : 0, width, scale.width)
        width: scale.below ? slider.width / 2 - Theme.gap : scale.leftRoom - Theme.gap
        text: scale.leftEnd
        horizontalAlignment: scale.flanked ? Text.AlignRight : Text.AlignLeft
        lineHeight: scale.flanked || scale.ends > 0 && scale.below && !scale.alone ? 0.86 : 1
        font.pixelSize: scale.ends > 0 && !scale.alone ? scale.endSize : Theme.size(scale.own ? 28 : 30)
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    PlainText {
        id: upper
        y: scale.below ? lower.y : slider.y + (slider.height - height) / 2
        x: Theme.across(scale.below ? scale.inset + slider.width - scale.round - width : scale.leftRoom + slider.width + scale.rightRoom - width, width, scale.width)
        width: scale.below ? lower.width : scale.rightRoom - Theme.gap
        text: scale.rightEnd
        horizontalAlignment: scale.below ? Text.AlignRight : Text.AlignLeft
        lineHeight: lower.lineHeight
        font.pixelSize: lower.font.pixelSize
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    Slider {
        id: slider

        // Where it is let go, or where a key has brought it; the first key begins in the middle.
        function tell(to: real) {
            scale.chosen(Math.round(Math.max(scale.lowest, Math.min(scale.highest, to))))
        }
        function step(by: int) {
            tell(scale.answered || Math.abs(by) === scale.range ? value + by : value)
        }
        objectName: `slider-${scale.item}`
        x: Theme.across(scale.leftRoom + scale.inset, width, scale.width)
        y: scale.below ? scale.above : (scale.height - height + scale.above) / 2
        // On a page of several, its ends stand at the same edges as those of the points.
        width: scale.alone ? Math.min(900 * Theme.unit, scale.width) : scale.width - scale.leftRoom - scale.rightRoom - scale.inset - scale.otherInset
        height: scale.rail
        padding: 0
        leftPadding: (scale.rail - scale.thickness) / 2
        rightPadding: leftPadding
        from: scale.lowest
        to: scale.highest
        stepSize: 1
        value: scale.answered ? scale.given : (scale.lowest + scale.highest) / 2
        focusPolicy: Qt.StrongFocus
        focus: true
        Accessible.name: `${scale.label} ${scale.leftEnd} – ${scale.rightEnd}`
        Accessible.description: scale.answered ? `${scale.given}` : scale.none
        Accessible.onIncreaseAction: step(1)
        Accessible.onDecreaseAction: step(-1)
        onPressedChanged: if (!pressed) tell(value)
        Keys.onPressed: event => {
            const ways = {
                [Qt.Key_Left]: -Theme.ahead, [Qt.Key_Right]: Theme.ahead, [Qt.Key_Space]: 0, [Qt.Key_Return]: 0, [Qt.Key_Enter]: 0,
                [Qt.Key_PageDown]: -scale.leap, [Qt.Key_PageUp]: scale.leap,
                [Qt.Key_Home]: -scale.range, [Qt.Key_End]: scale.range
            }
            const by = ways[event.key]
            event.accepted = by !== undefined && (by !== 0 || !scale.answered)
            if (event.accepted)
                step(by)
        }

        background: Rectangle {
            id: groove
            x: 0
            y: (slider.height - height) / 2
            width: slider.width
            height: scale.rail
            radius: height / 2
            // As the points of the others.
            color: Theme.white
            border { color: Theme.sea; width: (slider.hovered ? 5 : 3) * Theme.unit }
            // Where the middle of the handle can be.
            readonly property real inset: slider.leftPadding + scale.thickness / 2
            // A tenth of the way each, or a step where there are fewer. All are alike: a longer one would look chosen.
            Repeater {
                id: ticks
                model: Math.min(10, scale.range) + 1
                Rectangle {
                    required property int index
                    readonly property real middle: groove.inset + index / (ticks.model - 1) * (slider.width - 2 * groove.inset)
                    x: middle - width / 2
                    y: (scale.rail - height) / 2
                    width: 3 * Theme.unit
                    height: 0.3 * scale.rail
                    radius: width / 2
                    color: Theme.sea
                }
            }
            FocusRing {
                around: slider
                reach: 8 * Theme.unit
            }
        }
        handle: Rectangle {
            objectName: `handle-${scale.item}`
            x: slider.leftPadding + slider.visualPosition * (slider.availableWidth - width)
            y: (slider.height - height) / 2
            width: scale.thickness
            height: width
            radius: width / 2
            visible: scale.answered || slider.pressed
            color: Theme.sea
            border { color: Theme.white; width: 4 * Theme.unit }
        }
    }
    // As long as nothing is chosen there is no handle: one that stood there would suggest an answer. What there is to do
    // stands above the line: between the words for its ends it would name the middle.
    PlainText {
        id: hint
        objectName: `touch-${scale.item}`
        readonly property real hand: scale.hand
        readonly property real sign: hand + 4 * Theme.unit
        visible: !scale.answered && !slider.pressed
        x: slider.x + (slider.width - width) / 2
        y: slider.y - scale.above
        width: Math.min(implicitWidth, slider.width)
        height: scale.hintHeight
        verticalAlignment: Text.AlignVCenter
        leftPadding: Theme.mirrored ? 0 : sign
        rightPadding: Theme.mirrored ? sign : 0
        text: scale.touch
        font.pixelSize: scale.level ? Theme.small : lower.font.pixelSize
        color: Theme.ink
        // A hand whose finger points at the line.
        Drawing {
            x: Theme.across((hint.hand - width) / 2, width, hint.width)
            y: (hint.height - height) / 2
            scale: hint.hand / 24
            thick: 1.7
            rotation: 180
            ink: Theme.sea
            path: "M8.5 13.5 V4.3 A1.8 1.8 0 0 1 12.1 4.3 V11 M12.1 9.8 A1.8 1.8 0 0 1 15.7 9.8 V11.5 M15.7 10.9 A1.8 1.8 0 0 1 19.3 10.9 V15.5 "
                + "A6.2 6.2 0 0 1 13.1 21.7 H12.6 A6.2 6.2 0 0 1 7.6 19.2 L4.4 15.2 A1.7 1.7 0 0 1 7 13 L8.5 14.6"
        }
    }
}
