// The helper's back, while it is rated, and a word on why: on the window's lower edge, on a wide page between the way back
// and the way on, and on an upright one beside the controls. Where the ratings leave height, it stands closer.
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
    // Whether it stands closer, and how high it is then at most. It is no larger than its face on other pages.
    readonly property real usual: 192 * Theme.unit
    readonly property bool close: form.spare >= 0.5 * usual
    readonly property real most: close ? Math.min((wide ? 2 : 2.5) * usual, usual + form.spare, (room - (wide && tells ? needs + 2 * Theme.gap : 0)) / back.shape) : usual
    // On an upright page the words then stand above the controls, and have the width up to the page's edge.
    readonly property bool above: close && !wide
    readonly property real apart: (close ? 1 : 0.5) * Theme.gap
    // Whether there is room for the words beside it, and how much they take.
    readonly property real needs: Math.ceil(measured.advanceWidth) + apart
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
    PlainText {
        id: words
        objectName: "why-turned-away"
        readonly property bool before: away.wide && !Theme.mirrored
        x: before ? back.x - away.needs : back.x + back.width + away.apart
        // In one line with the ways, or with the controls.
        y: away.above ? Math.min(back.y + 0.45 * back.height, away.windowLayout.cornerY - Theme.gap) - height
            : away.wide ? away.form.y + away.form.foot + (away.form.way.height - height) / 2
            : away.windowLayout.cornerY + (away.windowLayout.corner.height - height) / 2
        width: away.above ? away.line + away.form.column - x : Math.ceil(measured.advanceWidth)
        visible: back.visible && away.tells
        text: away.why
        horizontalAlignment: before ? Text.AlignRight : Text.AlignLeft
        wrapMode: away.above ? Text.Wrap : Text.NoWrap
        font.pixelSize: Theme.size(away.close ? away.wide ? 40 : 46 : away.wide ? 34 : 36)
        color: Theme.faintInk
    }
}
