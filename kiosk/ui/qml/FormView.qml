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

    // Whether a line over the cards tells which page it is.
    readonly property bool lined: shape.lined
    // Whether the keys of a number stand in the helper's place.
    readonly property bool keysBeside: keyboard.visible && keyboard.numbers
    // Or over an upright page. Its other questions step back then, and its way on, whose words can still be read, is not
    // filled: what is next is to be done with typing. Pale letters would not have the contrast that was asked for.
    readonly property bool under: keysBeside && shape.upright && !Theme.highContrast

    // How much of the ways' line they take at both ends of a wide page, with and without a way back, whatever is answered
    // and pointed out: what stands between them stays where it is.
    readonly property real backTakes: way.backWish
    readonly property real onTakes: {
        const label = text => Math.max(way.button.least, wordWidths.bold(text, way.letters) + 2 * way.button.leftPadding)
        const reasons = form.reasons.map(reason => wordWidths.slack * wordWidths.plain(reason, Theme.size(32)))
        return Math.max(label(words["form-skip"]), label(words["form-next"]) + view.nearby + Math.max(0, ...reasons))
    }
    // How far what is missing stands before the way on that it belongs to.
    readonly property real nearby: 16 * Theme.unit
    // Whether the helper stands behind a wide page, with its back to it, and how much height above the ways is its back's.
    property bool turned: false
    readonly property real kept: turned && !shape.upright && wider && Theme.textSize <= 1.15
        ? Math.max(0, 200 * Theme.unit - (height - usualFoot + Theme.gap)) : 0
    // How much height its ratings leave to that back, which is larger then. Below an upright page, the ways stand higher.
    readonly property real spare: !turned ? 0 : Math.max(0, shape.solo ? shape.cleared - pane.tall : ratingRows.sheet ? ratingRows.left : shape.scaled ? pane.vacant : 0)
    // How much of that is above the ways.
    property real sunk: 0
    raised: shape.upright ? spare - sunk : 0
    // Whether it is and stays so.
    readonly property bool still: keyboard.field === null && (shape.upright || !pane.long)

    wider: shape.solo || shape.scaled
    title: form.title
    // A long title of a questionnaire's own would reach the controls.
    cornered: shape.upright ? 0 : Math.max(0, 360 * Theme.unit - (width - column) / 2)
    // Pale until the page is answered, and yet to be pressed: what is left out is pointed out then.
    quiet: form.skips || !form.complete || under
    way.waits: !form.skips && !form.complete
    way.reason: form.waiting
    way.note: way.fills && way.waits ? form.waiting : ""
    label: words[form.skips ? "form-skip" : "form-next"]
    beside: progress
    // A title that has one line keeps it, and the line of pages tells what the number would.
    readonly property real titleWish: wordWidths.slack * wordWidths.bold(title, Theme.pageTitle)
    readonly property real numberSize: Theme.size(shape.upright && Theme.textSize > 1 ? 30 : 34)
    readonly property real numberWish: wordWidths.slack * wordWidths.plain(form.progress, numberSize) + Theme.gap
    besides: shape.numbered && (titleWish + numberWish <= column - cornered || titleWish > column - cornered)
    onWent: form.proceed()
    covered: keyboard.field === null || keyboard.numbers ? 0 : keyboard.height
    lift: {
        if (covered === 0)
            return 0
        const at = begin + home.y + keyboard.field.mapToItem(home, 0, 0).y
        const free = height - covered - way.height - 2 * Theme.gap
        return Math.max(0, Math.min(at - Theme.gap, at + keyboard.field.height - free))
    }

    WordWidths {
        id: wordWidths
        // A study's questions are the same for all visitors, and a long form has many.
        mostKept: 2000
    }
    PageShape {
        id: shape
        form: view.form
        widths: wordWidths
        upright: view.width < view.height
        accompanied: view.accompanied
        column: view.column
        room: view.room - view.kept
    }
    RatingRows {
        id: ratingRows
        page: shape
        widths: wordWidths
        notes: [view.words["form-missing"], view.words["form-skipped"]]
        exemption: view.words["form-not-applicable"]
    }
    LoneRating {
        id: loneRating
        page: shape
    }
    PlainQuestions {
        id: plainQuestions
        page: shape
        widths: wordWidths
    }
    KeyPlace {
        id: keyPlace
        frame: view
        page: shape
        before: view.before
        cards: home
        apart: pane.spacing
        field: keyboard.field
        card: keyboard.card
    }

    // The items of the page, in their order.
    function all(): var {
        return Array.from({length: boxes.count}, (_, at) => boxes.itemAt(at) as FormItem)
    }
    // One press of a digit answers the scale that has the keyboard, or else the first that is not answered, and goes on
    // to the next. A number that is still empty begins with it: its field looks ready to type in before it is touched.
    function answer(digit: int): bool {
        const active = all().findIndex(box => box.activeFocus), at = active >= 0 ? active : all().findIndex(box => box.isOpen())
        if (at >= 0 && all()[at].begins(digit % 10))
            return true
        if (at < 0 || !all()[at].takes(digit))
            return false
        goOn(at)
        form.rate(form.items[at].id, digit)
        // The answer may have shown or hidden the items after it.
        goOn(at)
        return true
    }
    // Give the keyboard to the next item that is to be seen, or to the way on.
    function goOn(at: int) {
        const next = all().slice(at + 1).find(box => box.visible)
        if (next)
            next.take()
        else
            way.button.forceActiveFocus(Qt.TabFocusReason)
    }

    Keys.onPressed: event => {
        const digit = event.text === "" ? 0 : "1234567890".indexOf(event.text) + 1
        event.accepted = digit > 0 && answer(digit)
        if (!event.accepted)
            pane.turn(event)
    }

    // Why the way on waits, beside it. Where it has the page's width, that is its note.
    PlainText {
        objectName: "form-waiting"
        parent: view.way
        visible: !view.way.fills && view.way.waits && text !== "" && width + view.nearby + Theme.gap < view.way.freeRoom
        text: view.form.waiting
        font.pixelSize: Theme.size(32)
        color: Theme.faintInk
        x: Theme.across(parent.width - width - view.way.button.width - view.nearby, width, parent.width)
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
    PageLine {
        visible: view.lined
        // Large letters have more air below them, and leave less of the height.
        y: (shape.largeText ? -0.75 : -0.62) * Theme.gap
        width: view.column
        pages: view.form.pages
        page: view.form.page
    }
    // Which page this is, in words: dots tell how far the whole visit is.
    Text {
        id: progress
        objectName: "form-progress"
        textFormat: Text.PlainText
        visible: view.besides
        text: view.form.progress
        font.pixelSize: view.numberSize
        // Beside the title on a wide screen, where the controls and the dots of the visit are at the end of its line.
        readonly property bool follows: !shape.upright && view.titleWidth + width + Theme.gap < view.column - view.cornered + 1
        x: follows ? Theme.across(view.titleWidth + Theme.gap, width, view.column - view.cornered) : Theme.across(view.column - width, width, view.column)
        // In the title's line.
        y: -Theme.gap - 0.5 * (Theme.pageTitle * 1.36 + height) + (follows ? 0.13 * Theme.pageTitle : 0)
        color: Theme.faintInk
        Accessible.role: Accessible.StaticText
        Accessible.name: text
    }
    FocusScope {
        id: home
        // The card of a rating alone on its page begins where the first of several does.
        y: plainQuestions.roomy !== null ? shape.lead + plainQuestions.larger.sunk(height)
            : (view.wider ? view.turned : !shape.alone) ? shape.lead : Math.max(shape.lead, view.sink(height))
        width: parent?.width ?? 0
        height: pane.height
        // At first at no item: no key of the page before may answer or skip one; Tab goes to the first.
        focus: true
        Accessible.role: Accessible.Form
        Accessible.name: view.form.progress || (view.form.items[0]?.text ?? "")
        ScrollPane {
            id: pane
            width: parent.width
            room: shape.free
            more: view.words["scroll-more"]
            // How far cards stand from each other at least. Options in columns leave the height for more.
            readonly property real least: plainQuestions.roomy !== null ? plainQuestions.larger.apart(plainQuestions.roomy) : plainQuestions.columns !== null ? plainQuestions.cardGap : shape.gap
            // Further apart where the page has room for it; and what belongs together, too.
            readonly property real plain: summed(box => box.plain + (plainQuestions.columns !== null ? plainQuestions.cardGap : (shape.easy ? 24 : 30) * Theme.unit))
                - (plainQuestions.columns !== null ? 12 * Theme.unit : 0)
            readonly property int optionRows: summed(box => box.optionRows)
            // Whether all options of each question are as high as its highest, where the page has room for that, and how much
            // that takes.
            readonly property real uneven: summed(box => box.choices?.uneven ?? 0)
            readonly property bool even: plainQuestions.roomy !== null || plain + uneven <= plainQuestions.sure
            // How much higher than usual each row of options of an upright page is: two lines fit the highest.
            readonly property real most: 28 * Theme.unit
            readonly property real grown: !shape.easy || plainQuestions.roomy !== null || optionRows === 0 ? 0 : room - plain >= optionRows * most ? most
                : Math.max(0, Math.floor((room - plain - (even ? uneven : 0)) / optionRows))
            readonly property real addable: summed(box => box.addable)
            readonly property real loosened: (shape.calm || shape.rated) && addable > 0 ? Math.max(0, Math.min(1, (room / share - plain - optionRows * grown) / addable)) : 0
            readonly property real tall: summed(box => box.height)
            readonly property real heads: summed(box => box.head)
            // Adds up what each item that is there has of something.
            function summed(of: var): real {
                return view.all().reduce((sum, box) => sum + (box?.there ? of(box) : 0), 0)
            }
            // How many times as many places as items the page has.
            readonly property real share: shape.rows() / Math.max(1, shape.seen().length)
            // How much the places take that the page has beyond its items, as far as high cards do not need it.
            readonly property real vacant: Math.min(room * (1 - boxes.count / Math.max(boxes.count, shape.rows())), room - tall - shape.seen().length * least)
            spacing: ratingRows.sheet ? 0 : Math.max(least, Math.min((shape.upright ? 72 : view.wider ? 28 : 44) * Theme.unit,
                (room - heads - share * (tall - heads)) / Math.max(boxes.count, shape.rows())))
            Repeater {
                id: boxes
                model: view.form.items
                FormItem {
                    id: asked
                    width: parent?.width ?? 0
                    form: view.form
                    kiosk: view.kiosk
                    words: view.words
                    page: shape
                    rows: ratingRows
                    lone: loneRating
                    questions: plainQuestions
                    loosened: pane.loosened
                    grown: pane.grown
                    even: pane.even
                    // Over an upright page the keys cover other questions: these step back until they can be seen again.
                    opacity: keyboard.card === asked || !view.under ? 1 : 0.3
                    keyed: keyboard.field !== null && keyboard.card === asked
                    // While keys on the screen type into one, that is the one which is answered.
                    due: (!shape.alone || shape.solo) && (keyboard.field !== null ? keyed : view.form.due === modelData.id)
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
        where: keyPlace
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
            if (shape.upright && keyboard.numbers && !keyboard.field.activeFocus)
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
            const box = view.all().find(box => box.item.id === item)
            if (box) {
                pane.reveal(box)
                box.take()
            }
        }
    }
}
