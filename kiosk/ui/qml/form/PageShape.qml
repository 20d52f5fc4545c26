// What a page of a form asks and how much room there is for it: everything on the page is laid out by this.
import QtQuick
import Recollect
import ".."

QtObject {
    id: page

    required property FormScreen form
    required property WordWidths widths
    required property bool upright
    // Whether the helper stands beside the page.
    required property bool accompanied
    // How wide a card is, and how much height there is for all of them.
    required property real column
    required property real room

    readonly property var items: form.items
    // All questions that are laid out alike; kept here, as each look at one would fetch the list from the form again.
    readonly property var wordings: form.wordings
    readonly property bool alone: items.length === 1
    // Whether it is one rating of any kind: it has a card as wide as those of several.
    readonly property bool solo: alone && ["likert", "differential", "pictures", "slider"].includes(items[0].kind)
    // How many items it is laid out for: as many as the fullest page has that asks on the same scale. So points are as
    // large on all of these and stand in the same columns.
    readonly property int places: alone ? 1 : Math.max(items.length, form.fullest)
    readonly property bool dense: places > 4
    // Whether there is little height for what stands on the page.
    readonly property bool tight: room < 720 * Theme.unit
    // Whether there is much.
    readonly property bool large: upright && !dense
    // Large texts need the room that distances have elsewhere.
    readonly property bool largeText: Theme.textSize > 1.15
    readonly property bool airy: large && !largeText

    // Whether there is nothing but ratings on the page.
    readonly property bool rates: items.every(item => scales(item) || item.kind === "slider")
    // The same, and that an item does not apply may be an answer.
    readonly property bool scaled: items.every(item => ["likert", "slider"].includes(item.kind))
    // Whether there are just a few plain questions, and room for them.
    readonly property bool few: !tight && !largeText && items.length <= 3
        && items.every(item => ["integer", "single", "text"].includes(item.kind) && !item.exempts)
    // Whether they stand beside the helper, and distances may grow.
    readonly property bool calm: accompanied && few
    // Whether they have an upright page, whose height is for large options.
    readonly property bool easy: few && upright && !alone
    // Whether a few ratings have an upright page.
    readonly property bool rated: airy && !alone && rates

    // Whether it is one choice, or two plain questions: these are large, where they have room for that.
    readonly property bool chosen: alone && items[0].options !== undefined && !items[0].exempts
    readonly property bool brief: !tight && (chosen || items.length === 2
        && items.every(item => (item.options !== undefined || item.kind === "integer") && !item.exempts))

    // Whether the page says which of the form's pages it is, and whether a line above the cards shows that too.
    readonly property bool numbered: form.progress !== ""
    readonly property bool lined: numbered
    // How far below that line the first card begins, and what it leaves of the height for cards.
    readonly property real lead: !lined ? 0 : (largeText ? 8 : upright ? 28 : 20) * Theme.unit
    readonly property real free: room - lead
    // The same with air below the last card: that of a wide page is clear of the helper's back, and that of an upright one
    // ends where four cards do. What is pointed out may take this air.
    readonly property real cleared: free - (upright ? 20 : 32) * Theme.unit
    // How far cards are from each other at least.
    readonly property real gap: (dense || tight ? 8 : 12) * Theme.unit
    // How far the content of a card is from its left and right edges, and what that leaves of its width.
    readonly property real inset: solo && upright ? 28 * Theme.unit : brief && upright ? 28 * Theme.unit : solo || brief ? 40 * Theme.unit : (easy ? 1.5 : 1.2) * Theme.gap
    readonly property real inner: brief && alone ? column : column - 2 * inset

    function scales(item: var): bool {
        return item.kind === "likert" && !item.exempts
    }
    // The items that are not hidden. No property: one of its own would for a moment be that of the page before.
    function seen(): var {
        return items.filter(item => !form.hidden.includes(item.id))
    }
    // How many places there are for those, at least.
    function rows(): int {
        return Math.max(1, form.fullest, seen().length)
    }
    // The item that is seen before this one, and the one after it; null if there is none.
    function before(at: int): var {
        return items.slice(0, at).filter(item => !form.hidden.includes(item.id)).pop() ?? null
    }
    function after(at: int): var {
        return items.slice(at + 1).find(item => !form.hidden.includes(item.id)) ?? null
    }
}
