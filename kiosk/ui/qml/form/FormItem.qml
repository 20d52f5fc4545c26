// One item of a form: its text, its way to answer, and a word if it is missed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: box

    required property int index
    required property var modelData
    // As the form's object describes it.
    readonly property var item: modelData
    required property FormScreen form
    required property KioskScreen kiosk
    required property var words
    required property PageShape page
    required property RatingRows rows
    required property LoneRating lone
    required property PlainQuestions questions
    // How much of what can be added to the distances of this page is added, from 0 to 1, and how much higher than usual
    // options are.
    property real loosened: 0
    property real grown: 0
    // Whether all options of it are as high as the highest.
    property bool even: false
    // Whether the keys on the screen type into it.
    property bool keyed: false
    // Whether it is the one to answer next. Its edge says so: what is chosen is filled, and the keyboard's ring is black.
    property bool due: false

    // Whether its scale stands beside its text, and whether the words for the ends head it as in a table.
    readonly property bool beside: rows.beside(item)
    readonly property bool headed: rows.heads(index)
    // Whether its scale of many points stands below its question although the others do not.
    readonly property bool crowned: rows.crowned(item)
    // How much further than usual it is from the item before it.
    readonly property real parted: rows.parted(index)
    // Whether a number stands beside its text, at the end of the card, and what it may be in the question's line.
    readonly property bool inline: questions.inline(item)
    readonly property bool ranged: questions.ranged(item)
    // Whether it has a field below its text that is as wide as the card.
    readonly property bool below: questions.below(item)
    // Whether its options stand in columns.
    readonly property bool columned: questions.columns !== null
    // How it is laid out on the sheet of an upright page; null if it is not on one.
    readonly property var stack: rows.stack
    // How it is laid out where the page has room for that; else null.
    readonly property var roomy: questions.roomy
    // Whether it has no card.
    readonly property bool bare: page.alone && !page.solo || questions.open
    signal entered(Item field)

    readonly property var answer: form.answers[item.id]
    readonly property bool refused: form.refused.includes(item.id)
    readonly property bool missed: form.missing.includes(item.id) || refused
    readonly property int optionRows: choices?.rows ?? 0
    readonly property ChoiceList choices: way.item as ChoiceList
    // How high it is without all that, and how much can be added to the distances.
    readonly property real plain: head + (inline ? Math.max(told.height, way.height) : told.height + (way.active ? usualSpacing + (choices?.least ?? way.height) : 0)) + 2 * usualMargin
    readonly property real addable: page.alone || beside || stack !== null || roomy !== null ? 0 : 32 * Theme.unit
    readonly property real usualSpacing: roomy?.spacing ?? (page.solo ? lone.spacing : page.alone ? 2 * Theme.gap : spacingUnits() * Theme.unit)
    readonly property real margin: usualMargin + addable * loosened / 2
    readonly property real usualMargin: bare ? 0 : stack?.margin ?? roomy?.margin ?? (page.solo ? lone.margin
        : rows.own || rows.table ? Math.max((rows.table ? 4 : 10) * Theme.unit, rows.margin - taken / 2) : marginUnits() * Theme.unit)
    // A word that the item is missed takes that of the margins of its row: rows stay where they are.
    readonly property real taken: rows.measured ? Math.max(0, told.height - rows.height) : 0
    // Letters have some air above them already; what stands below them does not.
    readonly property real raised: crowned ? 5 * Theme.unit : stack !== null ? stack.raised : page.alone && roomy === null || beside || inline || page.dense ? 0 : 4 * Theme.unit
    // How far a statement on a sheet is from its points: a word that it is missed takes of that, and of the margin above.
    readonly property real off: stack === null ? 0 : Math.max(6 * Theme.unit, Math.min(stack.spacing, pointsAt - told.height + stack.margin - raised - 9 * Theme.unit))
    readonly property real pointsAt: stack === null ? 0 : rows.pointsAt(question.lineCount)
    readonly property var ways: ({
        likert: points, differential: points, pictures: points, slider: line, single: choice, multiple: choice,
        integer: number, text: letters, page: null
    })

    // How far its question is from its scale or its options among other items, and its content from the card's edges.
    function spacingUnits(): real {
        if (page.dense)
            return 4
        if (page.easy)
            return 18
        if (page.airy)
            return 22
        return columned ? 12 : page.calm ? 14 : 8
    }
    function marginUnits(): real {
        if (beside)
            return page.dense ? 9 : 20
        if (page.dense)
            return 8
        if (page.tight)
            return 10
        if (page.easy)
            return inline ? 28 : 30
        if (page.airy)
            return 26
        if (columned)
            return inline && !ranged ? 8 : 16
        return page.largeText ? 13 : 17
    }
    // How large the letters of its question are.
    function asking(): real {
        if (item.kind === "page")
            return Theme.size(36)
        if (stack !== null)
            return stack.text
        if (page.solo)
            return lone.asking(item.shown)
        if (roomy !== null || columned)
            return questions.asking
        if (page.alone)
            return Theme.heading
        if (beside || item.kind === "slider" && rows.text > 0)
            return missed ? rows.noted(item) : rows.text
        if (page.dense)
            return Theme.reading
        return page.easy ? Theme.size(36) : page.airy ? Theme.size(38) : Theme.body
    }
    // What is typed counts as done when the field is left, but not when a word over the screen takes the keyboard away.
    function done() {
        if (kiosk.bare)
            form.finish(item.id)
    }
    function fill(text: string) {
        const field = way.item as TypedField
        const number = way.item as NumberField
        if (field)
            field.text = text
        else if (number)
            number.text = text
    }
    // Whether a digit is an answer to it.
    function takes(digit: int): bool {
        return box.ways[item.kind] === points && digit <= item.points
    }
    // Whether a digit began its number, which was empty.
    function begins(digit: int): bool {
        const number = way.item as NumberField
        if (number === null || number.text !== "")
            return false
        take()
        number.text = digit
        return true
    }
    // Whether nothing is said to it yet.
    function isOpen(): bool {
        return visible && (answer ?? null) === null && !form.exempt.includes(item.id)
    }
    function take() {
        (guest.active ? guest : way).forceActiveFocus(Qt.TabFocusReason)
    }

    objectName: `item-${item.id}`
    readonly property bool there: !form.hidden.includes(item.id)
    visible: there
    // Qt would give the keyboard back to a field that is not to be seen.
    onVisibleChanged: {
        if (!visible) {
            way.focus = false
            guest.focus = false
        }
    }
    // The words for the ends stand above the first part of a sheet.
    readonly property real head: parted + (topped ? rows.sheet.head : beside && headed && !rows.own ? ((way.item as PointScale)?.words ?? 0) + 8 * Theme.unit : 0)
    // Whether it is the first part of a sheet, and the band with these words is joined to it.
    readonly property bool first: page.before(index) === null
    readonly property bool topped: first && rows.sheet !== null && rows.sheet.head > 0

    // How far its part of a sheet lies under the next one, whose edge is its own, too; the last is as high.
    readonly property bool last: page.after(index) === null
    readonly property real joint: rows.sheet === null || last ? 0 : rows.joint
    // How high the band at the foot of a sheet is, if it has one and this is the last part.
    readonly property real foot: last && stack !== null ? rows.foot : 0
    height: head + content.height + 2 * margin + (rows.sheet !== null && last ? rows.joint : 0) + foot
    // Its edge lies over those of its neighbours on a sheet.
    z: due || missed ? 1 : 0

    TableHead {
        objectName: "table-head"
        visible: box.topped
        width: box.width
        height: box.head + card.border.width
        rows: box.rows
        leftEnd: box.item.left ?? ""
        rightEnd: box.item.right ?? ""
        inset: box.page.inset
    }
    TableHead {
        objectName: "table-foot"
        visible: box.foot > 0
        y: box.height - height
        width: box.width
        height: box.foot + card.border.width
        rows: box.rows
        leftEnd: box.item.left ?? ""
        rightEnd: box.item.right ?? ""
        inset: box.page.inset
        foot: true
    }
    ItemCard {
        id: card
        // Parts of a sheet share the line between them.
        anchors { fill: parent; topMargin: box.head; bottomMargin: box.foot - box.joint }
        item: box.item.id
        bare: box.bare
        missed: box.missed
        due: box.due && !box.bare
        joinsAbove: box.rows.sheet !== null && (box.topped || !box.first)
        joinsBelow: box.joint > 0 || box.foot > 0
    }

    Column {
        id: content
        anchors { left: parent.left; right: parent.right; margins: box.bare ? 0 : box.page.inset }
        // In the middle of its card, on whole pixels.
        y: Math.round(box.head + box.margin - box.raised + (box.rows.sheet !== null ? box.rows.joint / 2 : 0))
        // The word that a rating alone is missed stands in that distance, and its points stay where they are.
        spacing: box.page.solo && box.missed ? Math.max(20 * Theme.unit, box.usualSpacing - told.spacing - note.height) : box.usualSpacing

        Item {
            id: asked
            width: parent.width
            // Where the middle of a row is: that of the points, and not of words above them.
            readonly property real scaled: (way.item as PointScale)?.tall ?? (way.item as SliderScale)?.rail ?? 0
            // How high the words are that head the points, where they are not in a band.
            readonly property real heads: (way.item as PointScale)?.head ?? 0
            // The text is level with the points. With the light words below them, these stand a little above the middle.
            readonly property real axis: box.rows.flank ? middle : box.rows.own ? Math.max((height - way.height + scaled) / 2 + 0.3 * box.rows.margin, told.height / 2 - 8 * Theme.unit) : middle
            // Rows of one line and of two are as high; with words for its ends it is as high as a scale and a line of words.
            readonly property real middle: Math.max(box.rows.own || box.rows.table ? box.rows.height : scaled, told.height, box.beside && !box.page.dense ? (1 + box.rows.closeness) * 1.37 * box.rows.text : 0) / 2
            height: box.stack?.height ?? (box.crowned ? box.rows.flank.crownedHeight : box.beside ? 2 * middle : box.inline ? Math.max(told.height, way.height) : told.height + (way.active ? content.spacing + way.height : 0))
            Column {
                id: told
                x: Theme.across(0, width, asked.width)
                y: box.stack !== null ? box.pointsAt - box.off - height : box.crowned ? 0 : box.beside ? asked.axis - height / 2 : box.inline ? (asked.height - height) / 2 : 0
                width: box.beside && !box.crowned ? box.rows.textWidth : box.inline ? asked.width - box.questions.fieldWidth : asked.width
                spacing: box.inline || box.below && !box.ranged || box.rows.sheet ? 0 : box.page.solo ? 12 * Theme.unit : box.usualSpacing
                Balanced {
                    id: question
                    width: parent.width
                    text: box.item.shown
                    Accessible.name: box.item.text
                    font {
                        pixelSize: box.asking()
                        bold: box.item.kind !== "page"
                    }
                    lineHeight: box.item.kind === "page" ? 1.15 : box.stack !== null || box.page.solo ? 0.92 : box.rows.closeness
                    horizontalAlignment: box.page.solo ? Text.AlignHCenter : Text.AlignLeft
                }
                // What a number may be, below the question where the number stands beside that.
                PlainText {
                    width: parent.width
                    visible: (box.inline || box.below) && !box.ranged && text !== ""
                    text: box.item.range ?? ""
                    horizontalAlignment: Text.AlignLeft
                    font.pixelSize: box.questions.open ? Theme.size(36) : box.page.large || box.columned || box.roomy !== null ? Theme.size(32) : Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.faintInk
                }
                PlainText {
                    id: note
                    width: parent.width
                    visible: box.missed && !box.crowned
                    text: box.refused ? box.words["form-refused"] : box.form.wrong.includes(box.item.id) ? box.item.wrong ?? box.words["form-missing"]
                        : box.words[box.item.required ? "form-missing" : "form-skipped"]
                    font { pixelSize: Theme.small; bold: true }
                    horizontalAlignment: question.horizontalAlignment
                    wrapMode: Text.Wrap
                    color: Theme.deepAmber
                }
            }
            // The same in the question's line.
            PlainText {
                visible: (box.inline || box.below) && box.ranged
                x: Theme.across(question.contentWidth + 1.25 * Theme.gap, width, asked.width)
                y: told.y + question.y + question.baselineOffset - baselineOffset
                text: box.item.range ?? ""
                font.pixelSize: Theme.size(box.questions.open ? 36 : 32)
                color: Theme.faintInk
            }
            // A row whose question has a line to itself has no height for a second.
            PlainText {
                visible: box.missed && box.crowned
                x: Theme.across(question.contentWidth + 1.25 * Theme.gap, width, asked.width)
                y: told.y + question.y + question.baselineOffset - baselineOffset
                text: box.words[box.item.required ? "form-missing" : "form-skipped"]
                font { pixelSize: Theme.small; bold: true }
                color: Theme.deepAmber
            }
            Loader {
                id: way
                readonly property real room: box.beside && !box.crowned ? box.rows.scaleWidth - box.rows.beyond : asked.width - box.rows.beyond
                x: Theme.across(box.crowned ? 0 : box.beside ? asked.width - box.rows.scaleWidth : box.inline ? asked.width - width : 0, width, asked.width)
                y: box.stack !== null ? box.pointsAt : box.crowned ? asked.height - height : box.rows.flank ? asked.middle - height / 2 : box.rows.own ? asked.axis - asked.scaled / 2 : box.inline ? (asked.height - height) / 2 : box.beside ? asked.middle - asked.scaled / 2 - asked.heads : told.height + content.spacing
                active: (box.ways[box.item.kind] ?? null) !== null
                visible: active
                sourceComponent: box.ways[box.item.kind] ?? null
            }
            // On a sheet, that it does not apply is a column of its own after the points.
            Loader {
                active: box.item.exempts && box.rows.sheet !== null
                visible: active
                x: Theme.across(asked.width - width, width, asked.width)
                y: box.stack !== null ? box.pointsAt + (box.stack.point - height) / 2 : asked.middle - height / 2
                sourceComponent: exemption
            }
        }
        // A kind of another package, drawn by its own file.
        Loader {
            id: guest
            readonly property var drawn: item
            width: parent.width
            active: box.item.source !== ""
            visible: active
            Component.onCompleted: if (active) setSource(box.item.source, {
                item: box.item, answer: box.answer ?? null, theme: Theme, alone: box.page.alone
            })
            onLoaded: drawn.answered.connect(value => box.form.give(box.item.id, value))
        }
        Loader {
            active: box.item.exempts && box.rows.sheet === null
            visible: active
            x: Theme.across(0, width, parent.width)
            sourceComponent: exemption
        }
        Binding {
            target: guest.item
            property: "answer"
            value: box.answer ?? null
            when: guest.item !== null
        }
    }

    Connections {
        target: box.form
        function onFilled(item: string, text: string) {
            if (item === box.item.id)
                box.fill(text)
        }
    }

    Component {
        id: exemption
        NotApplicable {
            objectName: `not-applicable-${box.item.id}`
            on: box.form.exempt.includes(box.item.id)
            words: box.words["form-not-applicable"]
            label: box.item.text
            dense: box.page.dense
            tabled: box.rows.sheet !== null
            onClicked: box.form.dismiss(box.item.id)
        }
    }
    Component {
        id: points
        PointScale {
            width: way.room
            beside: box.beside
            headed: box.headed
            own: box.rows.own
            flank: box.rows.flank
            table: box.rows.sheet
            crowned: box.crowned
            lift: box.rows.own ? 0 : box.usualMargin + asked.middle - tall / 2 + 8 * Theme.unit
            item: box.item.id
            label: box.item.text
            points: box.item.points
            pictures: box.item.pictures
            leftEnd: box.item.left
            rightEnd: box.item.right
            value: box.answer ?? 0
            lone: box.page.solo ? box.lone : null
            dense: box.page.dense
            tight: box.page.tight
            large: box.page.large
            onChosen: point => box.form.rate(box.item.id, point)
        }
    }
    Component {
        id: line
        SliderScale {
            width: way.room
            own: box.rows.own
            flank: box.rows.flank
            tall: box.rows.height + 2 * box.rows.margin
            item: box.item.id
            label: box.item.text
            lowest: box.item.lowest
            highest: box.item.highest
            leftEnd: box.item.left
            rightEnd: box.item.right
            none: box.words["form-none"]
            answered: box.answer !== undefined
            given: box.answer ?? 0
            lone: box.page.solo ? box.lone : null
            dense: box.page.dense || box.page.tight || (box.page.largeText && !box.page.large)
            large: box.page.large
            onChosen: value => box.form.rate(box.item.id, value)
        }
    }
    Component {
        id: choice
        ChoiceList {
            width: Math.min(content.width, box.questions.optionsWidth)
            item: box.item.id
            label: box.item.text
            options: box.item.options
            several: box.item.kind === "multiple"
            chosen: box.answer === undefined ? [] : several ? box.answer : [box.answer]
            questions: box.questions
            arranged: box.questions.rows(box.item)
            grown: box.grown
            even: box.even
            onPicked: option => several ? box.form.toggle(box.item.id, option) : box.form.choose(box.item.id, option)
        }
    }
    Component {
        id: number
        NumberField {
            room: content.width
            tall: box.questions.fieldHeight
            inline: box.inline
            column: box.questions.columnWidth
            filling: box.below
            keyed: box.keyed
            item: box.item.id
            form: box.form
            label: box.item.text
            range: box.item.range
            minus: box.item.minus
            widest: box.item.widest
            pattern: box.item.pattern
            less: box.words["form-less"]
            more: box.words["form-more"]
            hint: box.words["form-number"]
            onTyped: text => box.form.draft(box.item.id, text)
            onDone: box.done()
            onEntered: field => box.entered(field)
        }
    }
    Component {
        id: letters
        TypedField {
            id: field
            form: box.form
            focus: true
            objectName: `text-${box.item.id}`
            width: Math.min(content.width, 1000 * Theme.unit)
            label: box.item.text
            hint: box.words["form-type"]
            longest: box.item.longest
            onTextChanged: box.form.draft(box.item.id, text)
            onEditingFinished: box.done()
            onPointed: box.entered(field)
        }
    }
}
