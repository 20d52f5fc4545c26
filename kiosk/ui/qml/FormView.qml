// A page of a form: its items, one way on, and a keyboard while something is typed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."
import "form"

PageFrame {
    id: view

    required property FormScreen form
    // How far from the window's left edge the page begins.
    required property real before

    readonly property bool alone: form.items.length === 1
    readonly property bool dense: form.items.length > 4
    // What there is of a card's width, without its margins.
    readonly property real inner: column - (easy ? 3 : 2.4) * Theme.gap
    // How the rows of a wide page look if the words for the ends of their scales stand at both sides; null if not so.
    readonly property var flank: width > height && !alone && !dense && Theme.textSize <= 1.15 ? flanks() : null
    // Whether scales stand beside their texts, below each other: then the words for their ends are read once.
    readonly property real rowText: width <= height || alone || Theme.textSize > 1.15 ? 0
        : flank?.text ?? sizes.find(size => fits(size, 2)) ?? sizes.find(size => fits(size, 3)) ?? 0
    // Whether every row has the words for its own ends: the eye need not look for them.
    readonly property bool own: flank !== null || rowText > 0 && !dense && rates() && ownRows() <= room
    readonly property list<real> sizes: [36, 32, 29].map(Theme.size)
    // How much of a row is its text's and its scale's.
    readonly property real textWidth: flank?.textWidth ?? 0.42 * inner
    readonly property real scaleWidth: flank?.scaleWidth ?? 0.54 * inner
    // How high a row is, and how much of it is above and below that.
    readonly property real rowHeight: flank?.height ?? 98 * Theme.unit + 1.37 * Theme.size(28)
    readonly property real rowMargin: flank !== null ? spareMargin(flank.height, flank.tall) - partings * parting / 2 / Math.max(1, form.items.filter(item => !form.hidden.includes(item.id)).length) : 18 * Theme.unit
    // How much further a row is from the one before it where only one of them has many points below its question: they
    // are seen as two kinds. The margins of all rows give it, where they are large enough.
    readonly property int partings: form.items.filter((_, at) => parts(at)).length
    readonly property real parting: partings > 0 && spareMargin(flank.height, flank.tall) >= 22 * Theme.unit ? 18 * Theme.unit : 0
    FontMetrics {
        id: letters
        font { pixelSize: 100; bold: true }
    }
    // The widths of words in these letters: each is measured once, although many sizes are tried.
    readonly property var known: ({})
    function measured(word: string): real {
        if (known[word] === undefined)
            known[word] = letters.advanceWidth(word)
        return known[word]
    }
    // How many lines a question has at this size, in so much width.
    function lines(text: string, size: real, wide: real): int {
        const room = 98 * wide / size, gap = measured(" ")
        let count = 1, at = 0
        for (const word of text.split(" ")) {
            const long = measured(word)
            count += at > 0 && at + gap + long > room ? 1 : 0
            at = at > 0 && at + gap + long <= room ? at + gap + long : long
        }
        return count
    }
    function fits(size: real, most: int): bool {
        let tall = 60 * Theme.unit
        for (const item of form.items) {
            const count = lines(item.shown, size, textWidth)
            tall += form.hidden.includes(item.id) ? 0 : !scales(item) ? (dense || tight ? 170 : 210) * Theme.unit
                : Math.max((dense ? 72 : 92) * Theme.unit, (dense ? count : Math.max(2, count)) * 1.37 * size) + (dense ? 18 : 40) * Theme.unit + spread
            if (scales(item) && count > most)
                return false
        }
        return tall <= room
    }
    // How rows look with the words for their ends at both sides. Many points stand below their question, in the card's
    // width; beside it where there is no height for that, and then with their words below them.
    function flanks(): var {
        return !rates() ? null : form.items.some(many) ? flanked(true) ?? flanked(false) : flanked(false)
    }
    function many(item: var): bool {
        return scales(item) && item.points > 7
    }
    // The largest points, words, letters and fewest lines whose rows fit: the text has the width that a scale leaves.
    function flanked(over: bool): var {
        const longer = form.items.filter(many), shorter = form.items.filter(item => !many(item))
        const beside = over ? shorter : form.items
        const points = Math.max(1, ...form.items.map(item => scales(item) && item.points <= 7 ? item.points : 5))
        const widest = over ? 0 : Math.max(0, ...longer.map(item => item.points * 1.24 * 72 * Theme.unit))
        for (const [dot, word, letter, most] of [[100, 32, 36, 2], [100, 32, 34, 2], [100, 32, 32, 2], [100, 32, 32, 3],
            [92, 30, 36, 2], [92, 30, 32, 2], [92, 30, 32, 3], [84, 28, 36, 2], [84, 28, 32, 2], [84, 28, 29, 2], [84, 28, 29, 3]]) {
            const point = dot * Theme.unit, end = Theme.size(word), text = Theme.size(letter)
            const left = folded(beside, "left", end), right = folded(beside, "right", end)
            const scaleWidth = Math.max(widest, left + right + 2 * Theme.gap + (points + 0.27 * (points - 1)) * point)
            const textWidth = inner - scaleWidth - 2 * Theme.gap
            const counts = beside.map(item => lines(item.shown, text, textWidth))
            const height = Math.max(point, longer.length > 0 && !over ? 76 * Theme.unit + 1.37 * end : 0, 1.37 * text * Math.max(2, ...counts))
            const tall = over ? 1.37 * text + 18 * Theme.unit + point : height
            const fits = over ? longer.every(item => crowned(item, point, end, text)) : longer.every(item => reach(item, end) < scaleWidth / 2 - Theme.gap)
            if (fits && textWidth > 0.3 * inner && Math.max(0, ...counts) <= most && spareMargin(height, tall) >= 14 * Theme.unit)
                return {point, end, left, right, scaleWidth, textWidth, text, height, over, tall}
        }
        return null
    }
    // How wide the longer word for an end of a scale is.
    function reach(item: var, size: real): real {
        return 1.03 * Math.max(thin.advanceWidth(item.left), thin.advanceWidth(item.right)) * size / 100
    }
    // Whether a question and a word that it is missed fit one line, and its points and the words for their ends another.
    function crowned(item: var, point: real, end: real, text: real): bool {
        const note = Math.max(letters.advanceWidth(words["form-missing"]), letters.advanceWidth(words["form-skipped"])) * Theme.small / 100
        const ends = (thin.advanceWidth(item.left) + thin.advanceWidth(item.right)) * end / 100
        return 1.03 * (letters.advanceWidth(item.shown) * text / 100 + note) + 1.25 * Theme.gap <= inner
            && 1.03 * ends + 2 * Theme.gap + (item.points + 0.24 * (item.points - 1)) * point <= inner
    }
    // What the page's height leaves above and below each row that is so high, up to a limit. Rows of many points may be
    // higher than the others.
    function spareMargin(height: real, tall: real): real {
        const rows = form.items.filter(item => !form.hidden.includes(item.id))
        const all = rows.reduce((sum, item) => sum + (many(item) ? tall : height), 0)
        return Math.min(44 * Theme.unit, ((room - all) / Math.max(1, rows.length) - spread) / 2)
    }
    // How wide the words for these ends are, in two lines if they are long. In steps: so the scales of pages with almost
    // the same words stand at one place.
    function folded(items: var, end: string, size: real): real {
        const wide = words => thin.advanceWidth(words.join(" ")) * size / 100
        let most = 0
        for (const item of items) {
            const words = item[end].split(" ")
            most = Math.max(most, wide(words) <= 5.4 * size ? wide(words)
                : Math.min(...words.map((_, at) => Math.max(wide(words.slice(0, at)), wide(words.slice(at))))))
        }
        return Math.ceil(1.03 * most / (16 * Theme.unit)) * 16 * Theme.unit
    }
    function ownRows(): real {
        const size = Theme.size(28)
        let tall = 0
        for (const item of form.items) {
            const end = Math.max(letters.advanceWidth(item.left), letters.advanceWidth(item.right)) * size / 100
            if (end > scaleWidth / 2 - Theme.gap)
                return Infinity
            tall += form.hidden.includes(item.id) ? 0
                : Math.max(rowHeight, lines(item.shown, rowText, textWidth) * 1.37 * rowText) + 2 * rowMargin + spread
        }
        return tall
    }
    // Whether an upright page of ratings has height for large distances, even with two lines in each card.
    readonly property bool ample: {
        const two = 2 * 1.37 * Theme.size(38), card = two + 1.37 * Theme.size(30) + (Theme.textSize > 1 ? 194 : 202) * Theme.unit
        return rated && form.items.length * card <= room - lead
    }
    readonly property real spread: (dense || tight ? 8 : tiles !== null ? 22 : 12) * Theme.unit
    // Whether a line over the page tells which page it is.
    readonly property bool lined: upright && besides
    // How far below it the first card begins.
    readonly property real lead: lined && Theme.textSize <= 1.15 ? 28 * Theme.unit : 0
    // Whether there is little height for what stands on the page.
    readonly property bool tight: room < 720 * Theme.unit

    // Whether a few plain questions have the page to themselves.
    readonly property bool calm: accompanied && few
    readonly property bool few: !tight && Theme.textSize <= 1.15 && form.items.length <= 3
        && form.items.every(item => ["integer", "single", "text"].includes(item.kind) && !item.exempts)

    // How large the options of such a page are where all stand in columns, and how high; null where they do not fit so.
    readonly property var tiles: {
        if (!calm || upright || alone || mirrored)
            return null
        for (const size of [34, 33, 32, 31, 30, 29].map(Theme.size))
            for (const height of [84, 80, 78, 77, 76, 75, 74, 72, 68])
                if (form.items.every(item => tiled(item, size)) && tiledHeight(height, size) - 22 * Theme.unit <= room)
                    return {size, height: height * Theme.unit}
        return null
    }
    readonly property real asking: Theme.size(36)
    // How many options each row has where an odd number of them takes fewer rows side by side than in halves, which would
    // leave a hole; none where it does not.
    function shared(item: var, size: real): var {
        const all = item.options ?? []
        if (item.kind !== "single" || all.length % 2 === 0)
            return []
        const wide = all.map(option => 1.01 * thin.advanceWidth(option.text) * size / 100 + 84 * Theme.unit)
        for (let rows = 1; rows < all.length / 2; rows++) {
            const few = Math.floor(all.length / rows), more = all.length % rows
            const counts = Array.from({length: rows}, (_, row) => row < more ? few + 1 : few)
            for (const way of [counts, counts.slice().reverse()]) {
                let at = 0
                if (way.every(count => {
                    at += count
                    return wide.slice(at - count, at).reduce((sum, each) => sum + each + 16 * Theme.unit, 0) <= inner + 16 * Theme.unit
                }))
                    return way
            }
        }
        return []
    }
    FontMetrics {
        id: thin
        font.pixelSize: 100
    }
    // Whether all of its options have room in halves of the card, or in rows that they share.
    function tiled(item: var, size: real): bool {
        if (item.kind === "integer")
            return true
        if (item.kind !== "single")
            return false
        const half = (inner - 16 * Theme.unit) / 2 - 79 * Theme.unit
        // Small letters are set on whole pixels, and take a little more.
        return shared(item, size).length > 0 || item.options.every(option => 1.01 * thin.advanceWidth(option.text) * size / 100 <= half)
    }
    // Whether what a number may be has room in its question's line.
    function ranged(item: var): bool {
        return item.kind === "integer" && letters.advanceWidth(item.text) * asking / 100
            + 1.01 * thin.advanceWidth(item.range) * Theme.size(32) / 100 + 1.5 * Theme.gap <= inner - 470 * Theme.unit
    }
    // Whether they have an upright one, whose height is for large options.
    readonly property bool easy: few && upright && !alone
    // How large these options are: as large as leaves them in as many rows as the usual size does.
    readonly property real optionSize: {
        if (!easy)
            return Theme.size(34)
        const usual = form.items.map(item => columnsAt(item, Theme.size(34)))
        return [38, 36].map(Theme.size).find(size => form.items.every((item, at) => columnsAt(item, size) === usual[at])) ?? Theme.size(34)
    }
    function columnsAt(item: var, size: real): int {
        if (item.kind !== "single")
            return 0
        const gap = 14 * Theme.unit, many = item.options.length
        const widest = Math.max(...item.options.map(option => 1.01 * thin.advanceWidth(option.text) * size / 100)) + 104 * Theme.unit
        const fit = Math.min(many, Math.floor((inner + gap) / (widest + gap)))
        return fit < 1 ? 0 : Math.ceil(many / Math.ceil(many / fit))
    }
    function tiledHeight(height: real, size: real): real {
        let tall = 0
        for (const item of form.items) {
            const lines = Math.ceil(letters.advanceWidth(item.text) * asking / 100 / inner)
            const rows = shared(item, size).length || Math.ceil((item.options?.length ?? 0) / 2)
            tall += form.hidden.includes(item.id) ? 0 : item.kind === "integer" ? (ranged(item) ? 130 : 138) * Theme.unit
                : lines * 1.37 * asking + (50 + (height + 16) * rows) * Theme.unit
        }
        return tall
    }

    // Whether a number stands beside its text: an upright screen's cards are broad enough for both, and so are those of a short wide page.
    function inline(item: var): bool {
        return (upright || calm && !mirrored) && !alone && Theme.textSize <= 1.15 && item.kind === "integer" && !item.exempts
            && letters.advanceWidth(item.text) * Theme.size(38) / 100 + 470 * Theme.unit <= column - 2.4 * Theme.gap
    }
    readonly property bool upright: width < height
    readonly property bool mirrored: Theme.mirrored
    // Whether a few ratings have an upright page to themselves.
    readonly property bool rated: upright && !alone && Theme.textSize <= 1.15 && form.items.length < 5
        && rates()
    // Whether the keys of a number stand in the helper's place.
    readonly property bool keysBeside: keyboard.visible && keyboard.numbers

    // What is over the first card in the title's line beside its words.
    readonly property rect bare: {
        const words = titleWidth + (besides ? progress.follows ? Theme.gap + progress.width : column : 0)
        const edge = (width - column) / 2
        return mirrored ? Qt.rect(edge, 0, column - cornered - words, begin + home.y) : Qt.rect(edge + words, 0, width - edge - words, begin + home.y)
    }
    // Whether it is and stays so.
    readonly property bool still: keyboard.field === null && (upright || !pane.long)

    // Or over other questions.
    readonly property bool keysOver: keyboard.visible && keyboard.numbers && upright && !alone
    // Pale letters would not have the contrast that was asked for.
    readonly property real setBack: keysOver && !Theme.highContrast ? 0.3 : 1

    wider: !alone && rates()
    title: form.title
    // A long title of a questionnaire's own would reach the controls.
    cornered: upright ? 0 : Math.max(0, 360 * Theme.unit - (width - column) / 2)
    // Pale until the page is answered, and yet to be pressed: what is left out is pointed out then.
    quiet: form.skips || !form.complete
    way.waits: !form.skips && !form.complete
    way.reason: form.waiting
    way.note: way.fills && way.waits ? form.waiting : ""
    way.opacity: keyboard.grand ? 1 : setBack
    label: words[form.skips ? "form-skip" : "form-next"]
    beside: progress
    besides: form.progress !== ""
    onWent: form.proceed()
    covered: keyboard.field === null || keyboard.numbers ? 0 : keyboard.height
    lift: {
        if (covered === 0)
            return 0
        const at = begin + home.y + keyboard.field.mapToItem(home, 0, 0).y
        const free = height - covered - way.height - 2 * Theme.gap
        return Math.max(0, Math.min(at - Theme.gap, at + keyboard.field.height - free))
    }

    // One press of a digit answers the scale that has the keyboard, or else the first that is not answered, and goes on
    // to the next.
    function answer(digit: int): bool {
        let at = -1
        for (let i = 0; i < boxes.count && at < 0; i++)
            if ((boxes.itemAt(i) as FormItem).activeFocus)
                at = i
        for (let i = 0; i < boxes.count && at < 0; i++)
            if ((boxes.itemAt(i) as FormItem).isOpen())
                at = i
        if (at < 0 || !(boxes.itemAt(at) as FormItem).takes(digit))
            return false
        goOn(at)
        view.form.rate(view.form.items[at].id, digit)
        // The answer may have shown or hidden the items after it.
        goOn(at)
        return true
    }
    // Whether there is nothing but ratings on the page.
    function rates(): bool {
        return form.items.every(item => scales(item) || item.kind === "slider")
    }
    function scales(item: var): bool {
        return item.kind === "likert" && !item.exempts
    }
    // Whether the item that is seen before this one has the same scale, and so the same words at its ends.
    function repeats(at: int): bool {
        const one = earlier(at), other = form.items[at] ?? null
        return one !== null && other !== null && scales(one) && one.points === other.points && one.left === other.left && one.right === other.right
    }
    // Whether one of this item and that before it has many points below its question, and the other has not.
    function parts(at: int): bool {
        const one = earlier(at), other = form.items[at] ?? null
        return flank !== null && flank.over && one !== null && other !== null && !form.hidden.includes(other.id) && many(one) !== many(other)
    }
    // The item that is seen before this one.
    function earlier(at: int): var {
        let before = at - 1
        while (before >= 0 && form.hidden.includes(form.items[before]?.id))
            before--
        return form.items[before] ?? null
    }
    // Give the keyboard to the next item that is to be seen, or to the way on.
    function goOn(at: int) {
        let next = at + 1
        while (next < boxes.count && !boxes.itemAt(next).visible)
            next++
        if (next < boxes.count)
            (boxes.itemAt(next) as FormItem).take()
        else
            way.button.forceActiveFocus(Qt.TabFocusReason)
    }

    Keys.onPressed: event => {
        const digit = event.text === "" ? 0 : "1234567890".indexOf(event.text) + 1
        event.accepted = digit > 0 && answer(digit)
        if (!event.accepted)
            pane.turn(event)
    }

    // Where keys over an upright page end above their card or begin below it, and how much height there is below it.
    readonly property real padOver: keyboard.card === null ? 0 : begin + home.y + keyboard.card.mapToItem(home, 0, 0).y - keyboard.away
    readonly property real padUnder: padOver + (keyboard.card?.height ?? 0) + 2 * keyboard.away
    readonly property real underRoom: foot - Theme.gap - padUnder
    // Where the keys of a number stand. On an upright page: below the card of their field, or above it, over other cards.
    // On a wide one: in the helper's place, in the margin, or below everything; they cover no answer unless there is no
    // such place.
    function padPlace(wide: real, tall: real): point {
        if (upright) {
            const edge = (width - column) / 2, across = Math.max(edge, Math.min(width - edge - wide, keyboard.aim.x - wide / 2))
            const under = keyboard.grand ? keyboard.open === underRoom : padUnder + tall <= height
            return Qt.point(across, under ? padUnder : Math.max(0, padOver - tall))
        }
        const after = Window.width - before - width
        const beside = keyboard.field === null ? 0
            : Math.max(0, Math.min(height - tall, foot - tall - Theme.gap, begin + home.y + keyboard.field.mapToItem(home, 0, keyboard.field.height / 2).y - tall / 2))
        if (Math.max(before, after) >= wide)
            return Qt.point(after >= wide ? width + (after - (accompanied ? Theme.gap : 0) - wide) / 2 : -(before + wide) / 2, Math.max(4.4 * Theme.gap, Math.min(begin + home.y, 7 * Theme.gap)))
        if ((width - column) / 2 >= wide)
            return Qt.point(width - wide - ((width - column) / 2 - wide) / 2, beside)
        if (Window.height - height >= tall)
            return Qt.point((width - wide) / 2, height + Math.max(0, (Window.height - height - tall - 80 * Theme.unit - below) / 2))
        const free = foot - tall - Theme.gap
        return free >= begin + home.y + home.height ? Qt.point((width - wide) / 2, free) : Qt.point(width - wide, beside)
    }

    // Why the way on waits, beside it. Where it has the page's width, that is its note.
    PlainText {
        objectName: "form-waiting"
        parent: view.way
        visible: !view.way.fills && view.way.waits && text !== "" && width + 2 * Theme.gap < view.way.freeRoom
        text: view.form.waiting
        font.pixelSize: Theme.size(28)
        color: Theme.faintInk
        x: Theme.across(parent.width - width - view.way.button.width - Theme.gap, width, parent.width)
        y: (view.way.button.height - height) / 2
        Accessible.ignored: true
    }
    // To tap beside everything is to have done with typing.
    Item {
        objectName: "ground"
        parent: view
        z: -1
        anchors.fill: parent
        TapHandler { onTapped: view.way.button.forceActiveFocus() }
    }
    // The same as a line of as many parts, over an upright page. The part of this page is the darkest and thickest.
    Row {
        visible: view.lined
        y: -0.5 * Theme.gap
        width: view.column
        spacing: 8 * Theme.unit
        Repeater {
            model: view.form.pages
            Rectangle {
                required property int index
                width: (view.column - (view.form.pages - 1) * 8 * Theme.unit) / Math.max(1, view.form.pages)
                readonly property bool present: index === view.form.page - 1
                y: (14 * Theme.unit - height) / 2
                height: (present ? 14 : 8) * Theme.unit
                radius: height / 2
                color: present ? Theme.sea : index < view.form.page ? Qt.tint(Theme.paper, Qt.alpha(Theme.sea, 0.5)) : Theme.sand
            }
        }
    }
    // Which page this is, in words: dots tell how far the whole visit is.
    Text {
        id: progress
        objectName: "form-progress"
        textFormat: Text.PlainText
        visible: view.besides
        text: view.form.progress
        font.pixelSize: Theme.size(34)
        // Beside the title on a wide screen, where the controls and the dots of the visit are at the end of its line.
        readonly property bool follows: view.width > view.height && view.titleWidth + width + Theme.gap < view.column - view.cornered + 1
        x: follows ? Theme.across(view.titleWidth + Theme.gap, width, view.column - view.cornered) : Theme.across(view.column - width, width, view.column)
        // In the title's line.
        y: -Theme.gap - 0.5 * (Theme.pageTitle * 1.36 + height) + (follows ? 0.13 * Theme.pageTitle : 0)
        color: Theme.faintInk
        Accessible.role: Accessible.StaticText
        Accessible.name: text
    }
    FocusScope {
        id: home
        y: view.alone ? Math.max(view.lead, view.sink(height)) : view.lead
        width: parent?.width ?? 0
        height: pane.height
        // At first at no item: no key of the page before may answer or skip one; Tab goes to the first.
        focus: true
        Accessible.role: Accessible.Form
        Accessible.name: view.form.progress || (view.form.items[0]?.text ?? "")
        ScrollPane {
            id: pane
            width: parent.width
            room: view.room - view.lead
            more: view.words["scroll-more"]
            // Further apart where the page has room for it; and what belongs together, too.
            readonly property real plain: summed(box => box.plain + (view.tiles !== null ? 22 : view.ample || view.easy ? 24 : 30) * Theme.unit) - (view.tiles !== null ? 12 * Theme.unit : 0)
            readonly property int rows: summed(box => box.rows)
            // How much higher than usual each row of options of an upright page is.
            readonly property real grown: view.easy && rows > 0 ? Math.max(0, Math.min(16 * Theme.unit, Math.floor((room - plain) / rows))) : 0
            readonly property real addable: summed(box => box.addable)
            readonly property real loosened: (view.calm || view.rated) && addable > 0 ? Math.max(0, Math.min(1, (room - plain - rows * grown) / addable)) : 0
            readonly property real tall: summed(box => box.height)
            // Adds up what each item that is there has of something.
            function summed(of: var): real {
                let sum = 0
                for (let i = 0; i < boxes.count; i++) {
                    const box = boxes.itemAt(i) as FormItem
                    sum += box?.there ? of(box) : 0
                }
                return sum
            }
            spacing: Math.max(view.spread,
                Math.min((view.width < view.height ? 72 : view.wider ? 26 : 44) * Theme.unit, (room - tall) / Math.max(1, boxes.count)))
            Repeater {
                id: boxes
                model: view.form.items
                FormItem {
                    id: asked
                    required property int index
                    required property var modelData
                    width: parent?.width ?? 0
                    item: modelData
                    form: view.form
                    kiosk: view.kiosk
                    words: view.words
                    alone: view.alone
                    dense: view.dense
                    tight: view.tight
                    calm: view.calm
                    paired: view.tiles?.size ?? 0
                    pairHeight: view.tiles?.height ?? 0
                    shared: view.tiles !== null ? view.shared(modelData, view.tiles.size) : []
                    asking: view.asking
                    ranged: view.tiles !== null && view.ranged(modelData)
                    loosened: pane.loosened
                    grown: pane.grown
                    optionSize: view.optionSize
                    easy: view.easy
                    large: view.width < view.height && view.form.items.length < 5
                    beside: view.own || view.rowText > 0 && view.scales(modelData)
                    own: view.own
                    flank: view.flank
                    rowHeight: view.rowHeight
                    rowMargin: view.rowMargin
                    parting: view.parts(index) ? view.parting : 0
                    rowText: view.rowText
                    textWidth: view.textWidth
                    scaleWidth: view.scaleWidth
                    ample: view.ample
                    headed: !view.repeats(index)
                    // Over an upright page the keys cover other questions: these step back until they can be seen again.
                    opacity: keyboard.card === asked ? 1 : view.setBack
                    inline: view.inline(modelData)
                    keyed: keyboard.field !== null && keyboard.card === asked
                    onEntered: field => {
                        keyboard.card = asked
                        keyboard.field = field
                    }
                }
            }
        }
    }
    ScreenKeyboard {
        id: keyboard
        parent: view
        form: view.form
        place: view.padPlace(width, height)
        // As wide as what the helper says, or as the cards.
        spare: view.upright ? view.column
             : view.accompanied ? Window.width - view.before - view.width - Theme.gap : 0
        away: view.upright ? Math.min(36 * Theme.unit, pane.spacing) : x < 0 ? (view.width - view.column) / 2 - x - width : x - (view.width + view.column) / 2
        open: view.underRoom >= 684 * Theme.unit ? view.underRoom : Math.max(view.underRoom, view.padOver - view.begin)
        covers: open === view.underRoom ? view.begin + home.y + home.height - view.padUnder : open
        near: (card as FormItem)?.inline ?? false
        // On a wide page the end of an empty field, where it is once something is typed. Its place in its row is named: it
        // changes then.
        aim: {
            const wide = view.upright ? field?.width : field?.settled
            const middle = field?.parent.mapToItem(home, field.x + Theme.across(field.width - wide, wide, field.width) + wide / 2, field.y + field.height / 2) ?? Qt.point(0, 0)
            return Qt.point(home.mapToItem(view, middle.x, 0).x, view.begin + home.y + middle.y)
        }
        words: view.words
        onDone: view.way.button.forceActiveFocus(Qt.MouseFocusReason)
    }
    Connections {
        target: view.way
        function onActiveFocusChanged() {
            if (view.way.activeFocus)
                keyboard.field = null
        }
    }
    Connections {
        target: keyboard.field
        // Keys that cover other questions go when one of these is answered.
        function onActiveFocusChanged() {
            if (view.upright && keyboard.numbers && !keyboard.field.activeFocus)
                keyboard.field = null
        }
    }
    Connections {
        target: view.form
        // A field that is hidden while something is typed takes its keyboard along.
        function onMarked() {
            if (keyboard.field !== null && !keyboard.field.visible)
                keyboard.field = null
        }
        // A new page begins at its top, for eyes and for the keyboard.
        function onTurned() {
            keyboard.field = null
            pane.rewind()
            home.focus = true
        }
        function onMissed(item: string) {
            for (let i = 0; i < boxes.count; i++) {
                const box = boxes.itemAt(i) as FormItem
                if (box.item.id === item) {
                    pane.reveal(box)
                    box.take()
                }
            }
        }
    }
}
