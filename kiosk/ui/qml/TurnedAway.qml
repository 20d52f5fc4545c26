// The helper's back, while it is rated, and a word on why: on the window's lower edge, on a wide page between the way back
// and the way on, and on an upright one beside the controls.
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
    // Where the last card can end on a wide page, and where the way on ends on an upright one.
    readonly property real over: form.y + form.foot + (wide ? -Theme.gap - form.kept : form.way.height)
    readonly property real clear: (wide ? 8 : 24) * Theme.unit
    // Whether there is room for the words before it, and how much they take.
    readonly property real needs: words.width + 0.5 * Theme.gap
    readonly property bool tells: to - from >= back.width + needs + 2 * Theme.gap
    readonly property real least: from + Theme.gap + (tells && !Theme.mirrored ? needs : 0)
    readonly property real most: to - Theme.gap - back.width - (tells && Theme.mirrored ? needs : 0)
    // In the middle of a wide page, and at the edge of an upright one.
    readonly property real wished: !tells ? (from + to - back.width) / 2
        : wide ? line + (form.column - back.width + Theme.ahead * needs) / 2
        : Theme.mirrored ? from + Theme.gap : least

    AvatarBack {
        id: back
        objectName: "turned-away"
        x: Math.round(Math.max(away.least, Math.min(away.most, away.wished)))
        y: Math.round(away.windowLayout.room - height)
        height: Math.min(192 * Theme.unit, away.windowLayout.room - away.over - away.clear)
        visible: away.gone && away.form.still && height >= 80 * Theme.unit && away.to - away.from >= width + 2 * Theme.gap
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
        // In one line with the ways, or with the controls.
        y: away.wide ? away.form.y + away.form.foot + (away.form.way.height - height) / 2
            : away.windowLayout.cornerY + (away.windowLayout.corner.height - height) / 2
        width: Math.ceil(measured.advanceWidth)
        visible: back.visible && away.tells
        text: away.why
        horizontalAlignment: Text.AlignRight
        font.pixelSize: Theme.size(away.wide ? 34 : 36)
        color: Theme.faintInk
    }
}
