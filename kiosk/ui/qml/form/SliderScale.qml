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
    signal chosen(int value)

    readonly property int range: highest - lowest
    readonly property int leap: Math.max(1, Math.round(range / 10))
    readonly property real rail: (own ? lined ? 84 : ends > 0 ? 80 : 92 : dense ? 62 : large ? lined ? 112 : ends > 0 ? 108 : 126 : level ? 90 : 100) * Theme.unit
    readonly property real tick: (dense ? 18 : 24) * Theme.unit
    // The handle, with room around it in the line.
    readonly property real thickness: 0.78 * rail

    readonly property real words: Math.max(lower.height, upper.height)
    readonly property real apart: (centred ? 4 : own ? 6 : large ? 4 : 7) * Theme.unit
    readonly property bool centred: ends > 0 && below && !alone
    // Its line ends where the middles of the points of the others are.
    readonly property real inset: centred ? Math.max(0, (ends - rail) / 2) : 0
    readonly property real otherInset: centred ? Math.max(0, (otherEnds - rail) / 2) : 0
    // Among other kinds of items the ends stand beside the line, and what there is to do in it.
    readonly property bool level: !own && !alone && !large
    readonly property real most: 250 * Theme.unit * Theme.textSize
    readonly property bool below: !level || width < 4 * most
    readonly property real leftRoom: below ? 0 : Math.min(lower.implicitWidth, most) + Theme.gap
    readonly property real rightRoom: below ? 0 : Math.min(upper.implicitWidth, most) + Theme.gap

    height: below ? slider.height + apart + words : Math.max(slider.height, words)

    PlainText {
        id: lower
        y: scale.below ? slider.height + scale.apart : (scale.height - height) / 2
        x: Theme.across(0, width, scale.width)
        width: scale.centred ? scale.ends : scale.below ? slider.width / 2 - Theme.gap : scale.leftRoom - Theme.gap
        text: scale.leftEnd
        horizontalAlignment: scale.centred ? Text.AlignHCenter : Text.AlignLeft
        lineHeight: scale.centred ? 0.86 : 1
        font.pixelSize: Theme.size(scale.ends > 0 && !scale.alone ? scale.own ? 26 : 28 : scale.own ? 28 : 30)
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    PlainText {
        id: upper
        y: scale.below ? lower.y : (scale.height - height) / 2
        x: Theme.across(scale.centred ? scale.width - width : scale.leftRoom + slider.width + scale.rightRoom - width, width, scale.width)
        width: scale.centred ? scale.otherEnds : scale.below ? lower.width : scale.rightRoom - Theme.gap
        text: scale.rightEnd
        horizontalAlignment: scale.centred ? Text.AlignHCenter : scale.below ? Text.AlignRight : Text.AlignLeft
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
        y: scale.below ? 0 : (scale.height - height) / 2
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
            // No frame: it would look like a field to type in.
            color: "transparent"
            // Where the middle of the handle can be.
            readonly property real inset: slider.leftPadding + scale.thickness / 2
            Rectangle {
                x: groove.inset
                y: (scale.rail - height) / 2
                width: slider.width - 2 * groove.inset
                height: (scale.dense ? 6 : 10) * Theme.unit
                radius: height / 2
                color: Theme.sea
            }
            // A tenth of the way each, or a step where there are fewer; longer at the ends and in the middle.
            Repeater {
                id: ticks
                model: Math.min(10, scale.range) + 1
                Rectangle {
                    required property int index
                    readonly property bool end: index === 0 || index === ticks.model - 1 || 2 * index === ticks.model - 1
                    readonly property real middle: groove.inset + index / (ticks.model - 1) * (slider.width - 2 * groove.inset)
                    x: middle - width / 2
                    y: (scale.rail - height) / 2
                    width: (end ? 8 : 4) * Theme.unit
                    height: (end ? 1.9 : 1.1) * scale.tick
                    radius: width / 2
                    color: Theme.sea
                }
            }
            FocusRing {
                around: slider
                reach: 22 * Theme.unit
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
    // stands between the ends; in the line where they stand beside it, or leave no room.
    Rectangle {
        visible: hint.visible && !hint.beneath
        anchors { fill: hint; leftMargin: -0.5 * Theme.gap; rightMargin: -0.5 * Theme.gap }
        color: Theme.white
    }
    PlainText {
        id: hint
        objectName: `touch-${scale.item}`
        readonly property real between: scale.centred ? scale.width - 2 * Math.max(scale.ends, scale.otherEnds) : slider.width - 2 * Math.max(lower.contentWidth, upper.contentWidth)
        readonly property bool beneath: scale.below && implicitWidth + 2 * Theme.gap <= between
        visible: !scale.answered && !slider.pressed
        x: slider.x + (slider.width - width) / 2
        y: beneath ? lower.y : slider.y + (slider.height - height) / 2
        width: implicitWidth
        text: scale.touch
        font.pixelSize: scale.level ? Theme.small : lower.font.pixelSize
        color: Theme.faintInk
    }
}
