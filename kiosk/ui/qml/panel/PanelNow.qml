// What is going on now, in the largest letters of the panel, and at its end the way back to it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: now

    required property PanelScreen panel
    // How large its words are; the state is larger, as far as it has one line.
    required property real size
    // How wide the column at the right end of the page is: what is pressed begins where that does. 0 on an upright page.
    property real side: 0
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property var stage: panel.today.tiles.find(each => each.name === "stage")
    readonly property bool underWay: choices.underWay
    readonly property bool pausing: choices.onBreak ?? false
    // Ending the break is the same then.
    readonly property bool goesOn: !pausing && (choices.canBeNext ?? false)
    readonly property bool beside: side > 0
    readonly property bool tabled: Theme.textSize <= 1.15
    // A session is paused for as long as the panel is open; the stage comes second then.
    readonly property string word: (underWay ? words["console-paused"] : pausing ? words["console-on-break"] : stage?.value) ?? ""
    readonly property string second: underWay ? stage?.value ?? "" : ""
    readonly property string told: stage?.line ?? ""
    // What is pressed most is filled and stands at the end, and the way back is quiet beside it then. A session that is to
    // stay paused has a way out that says so.
    readonly property bool stays: underWay && !goesOn && (choices.staysPaused ?? false)
    readonly property string main: (pausing ? words["console-break-end"] : goesOn ? words["console-next"] : stays ? words["console-stay-paused"] : choices.back) ?? ""
    readonly property string quiet: pausing || goesOn || stays ? choices.back ?? "" : ""

    readonly property real inset: Math.round(1.4 * Theme.gap)
    readonly property real above: Math.round((!beside ? 1 : inRow ? 0.3 : 0.5) * Theme.gap)
    readonly property real space: Math.round((beside ? 8 : 14) * Theme.unit)
    readonly property real sign: underWay ? Math.round((tabled ? 2.9 : 2.4) * Theme.dense) : 0
    readonly property real signGap: underWay ? Math.round(1.1 * Theme.gap) : 0
    readonly property real across: Math.floor(beside ? side - inset : width - 2 * inset)
    readonly property real tall: Math.round((beside ? 104 : 112) * Theme.unit)
    readonly property real low: Math.round((beside ? 72 : 76) * Theme.unit)
    // In the middle of a wide band stand the quiet ones, where that leaves the state its room.
    readonly property real middling: Math.round(1.45 * Theme.dense)
    readonly property real middle: Math.ceil(Math.max(0, quiet === "" ? 0 : 1.02 * wordWidths.bold(quiet, middling) + 2 * middling + 56 * Theme.unit))
    readonly property real before: quiet === "" ? 0 : middle + Theme.gap
    readonly property bool inRow: beside && tabled && quiet !== "" && width - side - before - Theme.gap - inset - sign - signGap >= Math.max(1.04 * wordWidths.bold(word, 4.6 * Theme.dense), 11 * Theme.dense)
    readonly property real room: (beside ? width - side - Theme.gap : width - inset) - (inRow ? before : 0) - inset - sign - signGap
    // Smaller where the state has a long name, and in two lines only where even small letters do not fit.
    readonly property real crown: Math.floor(Math.max(2.4 * Theme.dense, Math.min(4.6 * Theme.dense, 98 * room / Math.max(1, wordWidths.bold(word, 100)))))
    // How much nearer the line below it stands than its letters ask for.
    readonly property real close: Math.floor((beside ? 0.1 : 0.05) * crown)
    readonly property real lettering: lettered(size)
    readonly property Item way: stays ? stay : back

    // The words of its buttons have one line, where that does not make them small.
    function lettered(size: real): real {
        const most = (!tabled ? 1 : beside ? 1.15 : 1.3) * size
        return Math.floor(Math.max(Math.min(size, 1.2 * Theme.dense), Math.min(most, ...[main, quiet].map(text => (across - 50 * Theme.unit) / (wordWidths.bold(text, 1) + 2.3)))))
    }
    // How high the words are, and what is pressed.
    function saidDeep(size: real): real {
        const line = each => Math.ceil(1.37 * each)
        const behind = behinds(size) || second === "" || told === ""
        return Math.max(sign, line(crown) * (0.08 + 0.92 * wordWidths.lines(word, crown, 1.03 * room)) - close + (second + told === "" ? 0 : behind ? 1 : 2) * line(under(size)))
    }
    function pressedDeep(size: real): real {
        const letters = lettered(size)
        const button = (text, least) => Math.max(least, 1.4 * letters * wordWidths.lines(text, letters, across - 2.05 * letters - 36 * Theme.unit) + 18 * Theme.unit)
        const each = [button(main, tall), ...(quiet === "" ? [] : [button(quiet, low)])]
        return inRow ? Math.max(...each) : each.reduce((sum, high) => sum + high + space, -space)
    }
    // Close the panel, and let the session stay paused or go on.
    function leave(paused: bool) {
        if (underWay && (choices.staysPaused ?? false) !== paused)
            panel.wish("pause", "")
        panel.wish("panel", "")
    }
    function under(size: real): real {
        return (beside ? 1.08 : 1.25) * size
    }
    function behinds(size: real): bool {
        return second !== "" && wordWidths.bold(second, under(size)) * 1.02 + 0.5 * size + wordWidths.plain(told, under(size)) * 1.02 <= room
    }
    // How high it is if its words are written so large.
    function deep(size: real): real {
        const said = saidDeep(size), ways = pressedDeep(size)
        return Math.ceil(2 * above + (beside ? Math.max(said, ways) : said + Theme.gap + ways))
    }
    WordWidths {
        id: wordWidths
    }

    height: Math.ceil(2 * above + (beside ? Math.max(said.height, ways.height) : said.height + Theme.gap + ways.height))
    radius: Theme.radius
    color: Theme.stated
    border { color: Theme.highContrast ? Theme.edge : "transparent"; width: 2 * Theme.unit }

    // The sign of a pause: two bars, and no disc around them, which would look like a button.
    Drawing {
        visible: now.underWay
        x: now.inset + (now.sign - width) / 2 - 0.14 * now.sign
        y: said.y + (said.height - height) / 2
        scale: 1.55 * now.sign / 24
        thick: 3.6
        path: "M8.6 5 V19 M15.4 5 V19"
        ink: Theme.sea
    }
    Item {
        id: said
        objectName: "today-stage"
        x: now.inset + now.sign + now.signGap
        y: now.beside ? Math.floor((now.height - height) / 2) : now.above
        width: now.room
        height: Math.max(now.sign, lines.height)
        Accessible.role: Accessible.Grouping
        Accessible.name: now.stage?.title ?? ""
        Column {
            id: lines
            // Large letters have more room above them than below.
            y: Math.floor((parent.height - height) / 2 - (now.beside ? 0.09 : 0.06) * now.crown)
            width: parent.width
            spacing: -now.close
            PlainText {
                width: parent.width
                text: now.word
                font { pixelSize: now.crown; bold: true }
                lineHeight: 0.92
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            Grid {
                columns: now.behinds(now.size) ? 2 : 1
                columnSpacing: 0.5 * now.size
                PlainText {
                    visible: text !== ""
                    width: Math.min(implicitWidth, now.room)
                    text: now.second
                    font { pixelSize: now.under(now.size); bold: true }
                    color: Theme.ink
                    wrapMode: Text.Wrap
                }
                PlainText {
                    visible: text !== ""
                    width: Math.min(implicitWidth, now.room)
                    text: now.told
                    font.pixelSize: now.under(now.size)
                    color: Theme.faintInk
                    wrapMode: Text.Wrap
                }
            }
        }
    }
    // What is filled stands first for the keyboard, and in a row at its end.
    Grid {
        id: ways
        x: !now.beside ? now.inset : now.width - now.side - (now.inRow ? now.before : 0)
        y: now.beside ? Math.floor((now.height - height) / 2) : said.y + said.height + Theme.gap
        columns: now.inRow ? 2 : 1
        columnSpacing: Theme.gap
        rowSpacing: now.space
        layoutDirection: now.inRow ? Qt.RightToLeft : Qt.LeftToRight
        verticalItemAlignment: Grid.AlignVCenter

        component Way: PanelButton {
            readonly property string play: "M8 5 L19 12 L8 19 Z"
            property bool leads: true
            width: leads || !now.inRow ? now.across : now.middle
            least: leads ? now.tall : now.low
            ground: "transparent"
            font { pixelSize: leads || !now.inRow ? now.lettering : now.middling; bold: true }
        }
        Way {
            objectName: "break-end"
            filled: true
            visible: now.pausing
            words: now.words["console-break-end"]
            drawing: play
            onClicked: now.panel.wish("break", "")
        }
        Way {
            objectName: "action-next"
            filled: true
            visible: now.goesOn
            words: now.words["console-next"]
            drawing: "M4 12 H20 M13.5 5.5 L20 12 L13.5 18.5"
            onClicked: now.panel.wish("next", "")
        }
        Way {
            id: stay
            objectName: "action-pause"
            visible: now.stays
            filled: true
            words: now.words["console-stay-paused"]
            onClicked: now.leave(true)
        }
        Way {
            id: back
            objectName: "panel-back"
            leads: now.quiet === ""
            filled: leads
            words: now.choices.back ?? ""
            drawing: now.underWay ? play : "M20 12 H4 M10.5 5.5 L4 12 L10.5 18.5"
            onClicked: now.leave(false)
        }
    }
}
