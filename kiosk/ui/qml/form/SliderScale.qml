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
    signal chosen(int value)

    readonly property real most: 250 * Theme.unit * Theme.textSize
    readonly property real leftRoom: Math.min(lower.implicitWidth, most)
    readonly property real rightRoom: Math.min(upper.implicitWidth, most)
    // The ends stand beside the line, where there is room for that, and else below it.
    readonly property bool below: alone || width < 4 * most
    readonly property int range: highest - lowest
    readonly property int leap: Math.max(1, Math.round(range / 10))
    // The words stand in the line, above its marks.
    readonly property real rail: hint.implicitHeight + (dense ? 26 : large ? 78 : 52) * Theme.unit
    readonly property real tick: (dense ? 10 : 24) * Theme.unit
    readonly property real thickness: rail + 10 * Theme.unit

    readonly property real words: Math.max(lower.height, upper.height)
    readonly property real apart: (large ? 0.5 : 0.3) * Theme.gap

    height: below ? slider.height + words + apart : Math.max(slider.height, words)

    PlainText {
        id: lower
        y: scale.below ? slider.height + scale.apart : (scale.height - height) / 2
        x: Theme.across(0, width, scale.width)
        width: scale.below ? slider.width / 2 - Theme.gap : scale.leftRoom
        text: scale.leftEnd
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: Theme.size(30)
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    PlainText {
        id: upper
        y: scale.below ? lower.y : (scale.height - height) / 2
        x: Theme.across(scale.below ? slider.width - width : scale.leftRoom + slider.width + 2 * Theme.gap, width, scale.width)
        width: scale.below ? lower.width : scale.rightRoom
        text: scale.rightEnd
        horizontalAlignment: scale.below ? Text.AlignRight : Text.AlignLeft
        font.pixelSize: Theme.size(30)
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
        x: Theme.across(scale.below ? 0 : scale.leftRoom + Theme.gap, width, scale.width)
        y: scale.below ? 0 : (scale.height - height) / 2
        // On a page of several, its ends stand at the same edges as those of the points.
        width: scale.alone ? Math.min(900 * Theme.unit, scale.width) : scale.below ? scale.width : scale.width - scale.leftRoom - scale.rightRoom - 2 * Theme.gap
        height: scale.thickness
        padding: 0
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
            color: Theme.white
            border { color: Theme.sea; width: 3 * Theme.unit }
            readonly property real line: scale.rail - scale.tick / 2 - (scale.dense ? 6 : scale.large ? 20 : 12) * Theme.unit
            Rectangle {
                x: scale.thickness / 2
                y: groove.line - height / 2
                width: slider.width - scale.thickness
                height: (scale.dense ? 4 : 6) * Theme.unit
                radius: height / 2
                color: Theme.lightSea
            }
            // A tenth of the way each, or a step where there are fewer, and one at each end; where the middle of the handle can be.
            Repeater {
                id: ticks
                model: Math.min(10, scale.range) + 1
                Rectangle {
                    required property int index
                    readonly property bool end: index === 0 || index === ticks.model - 1
                    readonly property real middle: scale.thickness / 2 + index / (ticks.model - 1) * (slider.width - scale.thickness)
                    x: middle - width / 2
                    y: groove.line - height / 2
                    width: (end ? 4 : 3) * Theme.unit
                    height: scale.tick + (end ? 8 * Theme.unit : 0)
                    radius: width / 2
                    color: Theme.lightSea
                }
            }
            FocusRing {
                around: slider
                reach: 22 * Theme.unit
            }
        }
        handle: Rectangle {
            objectName: `handle-${scale.item}`
            x: slider.visualPosition * (slider.width - width)
            y: (slider.height - height) / 2
            width: scale.thickness
            height: width
            radius: width / 2
            visible: scale.answered || slider.pressed
            color: Theme.sea
            border { color: Theme.white; width: 4 * Theme.unit }
        }
    }
    // In the line as long as nothing is chosen: a handle that stood somewhere would suggest an answer.
    PlainText {
        id: hint
        objectName: `touch-${scale.item}`
        visible: !scale.answered && !slider.pressed
        x: slider.x + (slider.width - width) / 2
        y: slider.y + (slider.height - height) / 2 - (scale.dense ? 5 : scale.large ? 22 : 18) * Theme.unit
        text: scale.touch
        font.pixelSize: scale.dense ? Theme.small : Theme.body
        color: Theme.faintInk
    }
}
