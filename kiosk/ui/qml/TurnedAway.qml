// The helper's back, while it is rated, and its word on why: on the window's lower edge, on a wide page between the way back
// and the way on, and on an upright one beside the controls or above them. Where the ratings leave height, it is larger.
import QtQuick
import "."

Item {
    id: away

    required property WindowLayout windowLayout
    required property FormView form
    // Whether the helper has left its place.
    required property bool gone
    required property string why

    readonly property bool wide: windowLayout.wide
    readonly property real line: windowLayout.pageX + (form.width - form.column) / 2
    readonly property real from: wide ? line + (Theme.mirrored ? form.onTakes : form.backTakes)
        : windowLayout.steps.visible ? windowLayout.stepsX + windowLayout.steps.width : Theme.gap
    readonly property real to: wide ? line + form.column - (Theme.mirrored ? form.backTakes : form.onTakes) : windowLayout.cornerX
    readonly property real room: to - from - 2 * Theme.gap
    // Where the last card can end on a wide page, and where the way on ends on an upright one.
    readonly property real over: form.y + form.foot + (wide ? -Theme.gap - form.kept - form.spare : form.way.height)
    readonly property real clear: (wide ? 8 : Theme.textSize > 1 ? 24 : 40) * Theme.unit
    // How high it is at most where they leave none, and where they do.
    readonly property real usual: 192 * Theme.unit
    readonly property real most: wide ? Math.min(1.5 * usual, usual + form.spare, (room - (tells ? needs + 2 * Theme.gap : 0)) / back.shape) : 2.3 * usual
    // How much of an upright page's height it still leaves then.
    readonly property real slack: wide ? 0 : Math.max(0, windowLayout.room - form.y - form.usualFoot + form.spare - form.way.height - clear - most)
    readonly property real letters: Theme.size(wide ? 36 : above ? 40 : 34)
    // What it says stands in a bubble: how far its words are from the edge of that, and how far that is from the back.
    readonly property real pad: 28 * Theme.unit
    readonly property real apart: 30 * Theme.unit
    readonly property real needs: Math.ceil(measured.advanceWidth) + 2 * pad + apart
    // How much height it needs above the controls.
    readonly property real tall: Math.ceil(1.37 * Theme.size(40)) + 36 * Theme.unit
    // On an upright page that stands above the controls, where there is height for it, and has the width up to the page's edge.
    readonly property bool above: !wide && windowLayout.cornerY - over >= tall + 1.5 * Theme.gap
    readonly property bool tells: above || room >= back.shape * usual + needs
    readonly property real least: from + Theme.gap + (wide && tells && !Theme.mirrored ? needs : 0)
    readonly property real last: to - Theme.gap - back.width - (tells && Theme.mirrored ? needs : 0)
    // In the middle of a wide page, and at the edge of an upright one.
    readonly property real wished: wide ? line + (form.column - back.width) / 2 : least

    AvatarBack {
        id: back
        objectName: "turned-away"
        x: Math.round(Math.max(away.least, Math.min(away.last, away.wished)))
        y: Math.round(away.windowLayout.room - height)
        height: Math.min(away.most, away.windowLayout.room - away.over - away.clear)
        visible: away.gone && away.form.still && height >= 80 * Theme.unit && away.room >= width
    }
    // Measured apart: words whose width depends on their own implicit one have a binding loop when the page turns.
    TextMetrics {
        id: measured
        text: words.text
        font: words.font
    }
    Rectangle {
        id: bubble
        objectName: "turned-away-bubble"
        readonly property bool before: away.wide && !Theme.mirrored
        readonly property real inner: Math.ceil(measured.advanceWidth)
        width: Math.min(inner, away.above ? away.line + away.form.column - x - 2 * away.pad : inner) + 2 * away.pad
        height: words.height + (away.wide || away.above ? 36 : 24) * Theme.unit
        x: before ? back.x - away.needs : back.x + back.width + away.apart
        // In one line with the ways, or with the controls.
        y: away.above ? Math.min(back.y + 0.5 * back.height, away.windowLayout.cornerY - Theme.gap) - height
            : away.wide ? away.form.y + away.form.foot + (away.form.way.height - height) / 2
            : Math.min(away.windowLayout.cornerY + away.windowLayout.corner.height / 2, away.windowLayout.room - 0.3 * Theme.gap - height / 2) - height / 2
        visible: back.visible && away.tells
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }

        PlainText {
            id: words
            objectName: "why-turned-away"
            x: away.pad
            y: (bubble.height - height) / 2
            width: bubble.width - 2 * away.pad
            text: away.why
            horizontalAlignment: Text.AlignHCenter
            wrapMode: away.above ? Text.Wrap : Text.NoWrap
            font.pixelSize: away.letters
            color: Theme.ink
        }
        SpeechTail {
            width: 44 * Theme.unit
            height: 30 * Theme.unit
            x: (bubble.before ? bubble.width + 10 * Theme.unit : -10 * Theme.unit) - width / 2
            y: (bubble.height - height) / 2
            rotation: bubble.before ? -90 : 90
        }
    }
}
