// The helper's back, while it is rated, and a word on why: on a wide page over the edge of the first card, where the
// title's line has room for it, and on an upright one beside the controls.
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
    readonly property real line: windowLayout.pageX + form.bare.x
    readonly property real from: wide ? line
        : windowLayout.steps.visible ? windowLayout.stepsX + windowLayout.steps.width : Theme.gap
    readonly property real to: wide ? Math.min(line + form.bare.width, windowLayout.stepsX) : windowLayout.cornerX
    // Whether there is room for the words before it, and how much they take.
    readonly property real needs: words.width + 0.5 * Theme.gap
    readonly property bool tells: words.height <= back.height && to - from >= back.width + needs + 2 * Theme.gap
    readonly property real least: from + Theme.gap + (tells && !Theme.mirrored ? needs : 0)
    readonly property real most: to - Theme.gap - back.width - (tells && Theme.mirrored ? needs : 0)
    // At one place beside titles of any length, unless they are too long for that.
    readonly property real wished: wide ? (Theme.mirrored ? from + 2.8 * Theme.gap : to - 2.8 * Theme.gap - back.width)
        : !tells ? (from + to - back.width) / 2 : Theme.mirrored ? from + Theme.gap : least

    AvatarBack {
        id: back
        objectName: "turned-away"
        x: Math.round(Math.max(away.least, Math.min(away.most, away.wished)))
        y: Math.round((away.wide ? away.windowLayout.pageY + away.form.bare.height : away.windowLayout.room) - height)
        height: (away.wide ? 122 : 110) * Theme.unit
        visible: away.gone && away.form.still && away.to - away.from >= width + 2 * Theme.gap
            && (away.wide ? y > 0 : away.form.y + away.form.foot + away.form.way.height < y)
    }
    // Measured apart: words whose width depends on their own implicit one have a binding loop when the page turns.
    TextMetrics {
        id: measured
        text: words.text
        font: words.font
    }
    PlainText {
        id: words
        objectName: "why-turned-away"
        x: back.x + (Theme.mirrored ? back.width + away.needs - width : -away.needs)
        y: away.wide ? back.y + (back.height - height) / 2
            : away.windowLayout.cornerY + (away.windowLayout.corner.height - height) / 2
        // In two lines on a wide page, beside titles of many words.
        width: away.wide ? away.form.widths.column([text], font.pixelSize) : Math.ceil(measured.advanceWidth)
        visible: back.visible && away.tells
        text: away.why
        wrapMode: away.wide ? Text.WordWrap : Text.NoWrap
        horizontalAlignment: Text.AlignRight
        font.pixelSize: Theme.size(away.wide ? 28 : 30)
        color: Theme.faintInk
    }
}
