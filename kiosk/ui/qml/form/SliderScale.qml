// A line between two ends. Its handle is not there until the visitor puts it somewhere: one that stood there would
// suggest an answer.
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
    required property bool answered
    required property int given
    // How it looks if the page belongs to it; else null.
    property LoneRating lone: null
    required property bool dense        // whether there is little height for it
    // Whether there is much height for it.
    property bool large: false
    // Whether it is a row of a table, as high as the points of the others.
    property bool own: false
    // How its row looks if the words for its ends stand at both sides of the line, level with it; null if they do not.
    property var flank: null
    // How high that row is, with its margins.
    property real tall: 0
    signal chosen(int value)

    readonly property int range: highest - lowest
    readonly property int leap: Math.max(1, Math.round(range / 10))
    // Whether its row has room for the words below the line: this then has their width, and beads that are easy to hit.
    readonly property bool spread: flank !== null && tall >= 112 * Theme.unit + 1.37 * flank.end
        && Math.max(lower.implicitWidth, upper.implicitWidth) < width / 2 - Theme.gap
    // How high the line is: as the points of the others, and as easy to hit.
    readonly property real rail: spread ? 84 * Theme.unit : flank?.point ?? (lone ? 112 : own ? 92 : dense ? 64 : large ? 112 : 76) * Theme.unit
    // The handle, with room around it in the line.
    readonly property real thickness: rail - 12 * Theme.unit

    readonly property real words: Math.max(lower.height, upper.height)
    readonly property real apart: (spread ? 4 : own ? 6 : large && Theme.textSize <= 1.15 ? 14 : 12) * Theme.unit
    // Among other kinds of items the ends stand beside the line.
    readonly property bool level: !own && !lone && !large
    readonly property real most: 250 * Theme.unit * Theme.textSize
    readonly property bool below: spread || !flank && (!level || width < 4 * most)
    readonly property real leftRoom: below ? 0 : flank ? flank.left + Theme.gap : Math.min(lower.implicitWidth, most) + Theme.gap
    readonly property real rightRoom: below ? 0 : flank ? flank.right + Theme.gap : Math.min(upper.implicitWidth, most) + Theme.gap

    // In a row, what has air below its letters is in the middle by what can be seen of it.
    height: spread ? rail + apart + words - 8 * Theme.unit : flank ? rail : below ? rail + apart + words : Math.max(rail, words)

    PlainText {
        id: lower
        y: scale.below ? slider.height + scale.apart : (scale.height - height) / 2
        x: Theme.across(0, width, scale.width)
        width: scale.below ? slider.width / 2 - Theme.gap : scale.leftRoom - Theme.gap
        text: scale.leftEnd
        horizontalAlignment: scale.flank && !scale.spread ? Text.AlignRight : Text.AlignLeft
        lineHeight: scale.flank && !scale.spread ? 0.9 : 1
        font.pixelSize: scale.flank?.end ?? scale.lone?.end ?? Theme.size(scale.own ? 28 : scale.large && Theme.textSize <= 1.15 ? 34 : 30)
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    PlainText {
        id: upper
        y: scale.below ? lower.y : (scale.height - height) / 2
        x: Theme.across(scale.below ? slider.width - width : scale.leftRoom + slider.width + scale.rightRoom - width, width, scale.width)
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
        x: Theme.across(scale.leftRoom, width, scale.width)
        y: scale.below ? 0 : (scale.height - height) / 2
        // On a page of several, its ends stand at the same edges as those of the points.
        width: scale.width - scale.leftRoom - scale.rightRoom
        height: scale.rail
        padding: 0
        // Where the line is as wide as the points, its ends stand below the middles of the first and the last.
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
            id: rod
            x: 0
            y: (slider.height - height) / 2
            width: slider.width
            height: scale.rail
            radius: height / 2
            // As the points of the others.
            color: Theme.touchable
            border { color: Theme.sea; width: (slider.hovered ? 5 : 3) * Theme.unit }
            // Where the middle of the handle can be.
            readonly property real inset: slider.leftPadding + scale.thickness / 2
            readonly property real span: slider.width - 2 * inset
            Rectangle {
                anchors.centerIn: parent
                width: rod.span
                height: 4 * Theme.unit
                color: Theme.sea
            }
            // Beads show that there is something to touch. There are as many for every slider, whatever its values, and all
            // are alike: no bead may stand for a value more than another. Between them is as good a place as on them.
            Repeater {
                id: beads
                model: 11
                Rectangle {
                    required property int index
                    readonly property real pitch: rod.span / (beads.count - 1)
                    // On whole pixels, or small beads look square.
                    x: Math.round(rod.inset + index * pitch - width / 2)
                    y: Math.round((rod.height - height) / 2)
                    width: 2 * Math.round(Math.min(60 * Theme.unit, 0.74 * pitch, (scale.spread ? 0.67 : 0.56) * scale.rail) / 2)
                    height: width
                    radius: width / 2
                    color: Theme.white
                    border { color: Theme.sea; width: 3 * Theme.unit }
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
}
