// Where the keys of a number stand. On an upright page: below the card of their field, or above it, over other cards. On a
// wide one: in the helper's place, in the margin, or below everything; they cover no answer unless there is no such place.
import QtQuick
import ".."

QtObject {
    id: keyPlace

    required property PageFrame frame
    required property PageShape page
    // How far from the window's left edge the page begins.
    required property real before
    // What the cards stand in, and how far they are apart.
    required property Item cards
    required property real apart
    // The field that is typed into, and its card; null if there is none.
    required property TypedField field
    required property FormItem card

    readonly property real after: frame.Window.width - before - frame.width
    readonly property real top: frame.begin + cards.y
    readonly property real edge: (frame.width - frame.column) / 2
    // How far keys over an upright page are from the card that they point at. Where they end above it or begin below it,
    // and how much height there is below it.
    readonly property real away: Math.min(36 * Theme.unit, apart)
    readonly property real over: card === null ? 0 : top + card.mapToItem(cards, 0, 0).y - away
    readonly property real under: over + (card?.height ?? 0) + 2 * away
    readonly property real underRoom: frame.foot - Theme.gap - under
    // How much height keys have there, and how much of it the cards that they cover take.
    readonly property real open: underRoom >= 684 * Theme.unit ? underRoom : Math.max(underRoom, over - frame.begin)
    readonly property real covers: open === underRoom ? top + cards.height - under : open
    // How much width they have: as much as the cards, or as what the helper says.
    readonly property real spare: page.upright ? frame.column : page.accompanied ? after - Theme.gap : 0
    // What they point at: the middle of their field. On a wide page, that of an empty field is where it is once something is
    // typed. Its place in its row is named: it changes then.
    readonly property point aim: {
        if (field === null)
            return Qt.point(cards.mapToItem(frame, 0, 0).x, top)
        const wide = page.upright ? field.width : field.settled
        const across = field.x + Theme.across(field.width - wide, wide, field.width) + wide / 2
        const middle = field.parent.mapToItem(cards, across, field.y + field.height / 2)
        return Qt.point(cards.mapToItem(frame, middle.x, 0).x, top + middle.y)
    }

    // How far keys of this place and width are from the cards.
    function awayFrom(x: real, wide: real): real {
        return page.upright ? away : x < 0 ? edge - x - wide : x - edge - frame.column
    }
    // Where keys of this size stand; grand ones take all of the open height.
    function at(wide: real, tall: real, grand: bool): point {
        return page.upright ? overCards(wide, tall, grand) : besideCards(wide, tall)
    }
    function overCards(wide: real, tall: real, grand: bool): point {
        const fits = grand ? open === underRoom : under + tall <= frame.height
        return Qt.point(Math.max(edge, Math.min(frame.width - edge - wide, aim.x - wide / 2)), fits ? under : Math.max(0, over - tall))
    }
    function besideCards(wide: real, tall: real): point {
        // Level with the field, where that is possible.
        const level = field === null ? 0 : Math.max(0, Math.min(frame.height - tall, frame.foot - tall - Theme.gap,
            top + field.mapToItem(cards, 0, field.height / 2).y - tall / 2))
        if (Math.max(before, after) >= wide) {
            const across = after >= wide ? frame.width + (after - (page.accompanied ? Theme.gap : 0) - wide) / 2 : -(before + wide) / 2
            return Qt.point(across, Math.max(4.4 * Theme.gap, Math.min(top, 7 * Theme.gap)))
        }
        if (edge >= wide)
            return Qt.point(frame.width - (edge + wide) / 2, level)
        const below = frame.Window.height - frame.height
        if (below >= tall)
            return Qt.point((frame.width - wide) / 2, frame.height + Math.max(0, (below - tall - 80 * Theme.unit - frame.below) / 2))
        const free = frame.foot - tall - Theme.gap
        return free >= top + cards.height ? Qt.point((frame.width - wide) / 2, free) : Qt.point(frame.width - wide, level)
    }
}
