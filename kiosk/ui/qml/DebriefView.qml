// What the study was about, and the code to withdraw with: to be written down, or photographed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property DebriefScreen debrief
    required property string labName

    // As much of the height as the text leaves, so that a page that fits does not scroll.
    readonly property real side: Math.max((texts.halved || view.signed && width > height ? 230 : 290) * Theme.unit, Math.min((signed && width < height ? most : paired ? usual : 350) * Theme.unit, room - texts.height - keepsake.crown - 2 * pad - 2 * rim - (width < height ? 1.1 : 1) * Theme.gap))
    // How large the code may be on an upright page, where the words beside it have to find room.
    readonly property real most: width < height && fits(Theme.size(34), noted, apart, 400) ? 400 : usual
    readonly property real usual: both ? 410 : 352
    // How far the white around the code reaches beyond its own frame, for round corners.
    readonly property real rim: 6 * Theme.unit
    // Whole pixels for each square, so that their edges are sharp.
    readonly property int square: Math.max(2, Math.floor(side / Math.max(1, debrief.squares)))

    // Lines with drawings stand below each other, as large as the page has room for above the card; on a page that has too
    // little for that, without the drawings.
    readonly property bool signed: debrief.lines.length > 0 && debrief.lines[0].sign !== "" && fits(Theme.small, Theme.small, 0.5)
    // Beside the helper, the first line leads to those after it, which stand two by two close below it, in the order in which
    // they are read. A last one is plain, as the first: as large as there is room for that, and for a code that is easy to scan.
    readonly property var rows: inRows(read)
    readonly property var measuredRows: inRows(measures)
    function inRows(all: var): var {
        return all.reduce((rows, each, index) => {
            if (index % 2 === 1)
                rows.push([])
            rows[rows.length - 1].push(each)
            return rows
        }, [[]])
    }
    readonly property real pairedSize: !accompanied || width <= height || read.length < 3 || read[0].sign === "" ? 0
        // Where the helper says the last two, there is room for a line more.
        : pairing(3) || (both ? pairing(4) : 0)
    // How large the letters are then, with so many lines in a card at most; 0 where there is no room.
    function pairing(most: int): real {
        // With less room than for a large code there is still a smaller one.
        return [400, 342].map(card => [36, 35, 34].map(Theme.size).find(size => brief(size, most) && 1.02 * stacked(size) + between + Theme.gap + card * Theme.unit <= room)).find(size => size !== undefined)
            ?? [36, 35, 34, 33, 32].map(Theme.size).find(size => brief(size, most) && stacked(size) + between + 333 * Theme.unit <= room) ?? 0
    }
    readonly property bool pairable: pairedSize > 0
    // Those that stand in pairs are cards, with this much around what they say.
    readonly property real inset: 0.75 * Theme.gap
    readonly property real insetAcross: Theme.gap
    // How far a row is below the one before it: plain lines are close to the cards that they are about.
    function step(index: int): real {
        return index === 0 ? 0 : (index === 1 ? 0.75 : rows[index].length === 1 ? 0.6 : 1) * Theme.gap
    }
    // Heading and text of a plain point are one line, where that has room.
    function runsOn(widths: var, size: real): bool {
        return widths?.length === 2 && (widths[0] + widths[1]) * size / 100 + 0.45 * size <= 0.995 * column
    }
    // How large such a line is: larger than the cards' texts, where all of them have the width and the page has the height.
    readonly property real headingSize: {
        const plain = measuredRows.filter(row => row.length === 1).map(row => row[0])
        const scanned = Math.floor(usual * Theme.unit / Math.max(1, debrief.squares)) * debrief.squares
        const free = room - stacked(pairedSize) - between - 1.2 * Theme.gap - scanned - 2 * rim - 1.5 * Theme.gap
        return [42, 41, 40].map(Theme.size).find(size => plain.every(widths => runsOn(widths, size))
            && plain.length * Math.ceil(1.37 * (size - pairedSize)) <= free) ?? pairedSize
    }
    readonly property real between: rows.reduce((sum, row, index) => sum + step(index), 0)
    // How many lines has the one of this row that has most of them, and how high all rows are.
    function tallest(row: var, size: real): int {
        const plain = row.length === 1
        const width = plain ? column : (column - Theme.gap) / 2 - 2 * insetAcross - 2.5 * size - Theme.gap
        return plain && runsOn(row[0], size) ? 1 : Math.max(...row.map(widths => broken(widths, size, width)))
    }
    function brief(size: real, most: int): bool {
        return measuredRows.every(row => tallest(row, size) <= most)
    }
    function stacked(size: real): real {
        return measuredRows.reduce((sum, row) => sum + (row.length > 1 ? 2 * inset : 0)
            + Math.max(row.length > 1 ? 2.5 * size : 0, tallest(row, size) * (leading + 0.06) * Math.ceil(1.37 * size)), 0)
    }
    readonly property bool paired: signed && pairable
    readonly property real size: paired ? pairedSize : signed ? (width < height ? [38, 36, 34, 32, 30, 29] : [32, 30, 29]).map(Theme.size).find(size => fits(size, noted, apart, most > usual ? most : 290)) ?? Theme.small
        : room < 720 * Theme.unit ? Theme.small : Theme.reading
    // What stands on the card is read from it at home, in a photograph.
    readonly property real noted: [Theme.body, Theme.reading].find(size => fits(Theme.size(32), size, width < height ? 0.5 : 0.4)) ?? Theme.small
    // How far what stands on the card is from its upper and lower edge.
    readonly property real pad: (paired ? 0.75 : signed && width < height ? 1.5 : !signed ? 0.75 : fits(size, noted, apart, 290, 52) ? 1.2 : noted > Theme.small ? 0.5 : 0.75) * Theme.gap
    // How far the lines are apart, in gaps: further where there is room for that.
    readonly property real apart: paired ? 1.34 : (width < height ? [1] : accompanied ? [1.1, 0.9, 0.7] : []).find(apart => fits(Theme.size(32), noted, apart, 290, width < height ? 0 : 52))
        ?? (width > height && noted > Theme.small ? 0.4 : 0.5)
    // Beside a drawing, a heading and its text stand close, so that they are seen as one.
    readonly property real leading: 0.9
    readonly property string kept: words[debrief.code === "" ? "debrief-take-home" : "debrief-take-home-scan"] + (labName === "" ? "" : " · " + labName)
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    FontMetrics {
        id: boldLetters
        font { pixelSize: 100; bold: true }
    }
    // Whether the lines have this size at most, with the card below them in its own.
    function fits(size: real, cardSize: real, apart: real, most = 290, more = 0): bool {
        return estimate(size, cardSize, apart, most) + more * Theme.unit <= (width < height ? 0.93 : Theme.unit < 0.9 ? 0.96 : 1) * room
    }
    // How high lines and card are about then.
    function estimate(size: real, cardSize: real, apart: real, most = 290): real {
        // Small letters are set on whole pixels, which makes them wider.
        const wide = (column - 2.5 * size - Theme.gap) * (Theme.unit < 0.9 ? 0.95 : 0.98)
        const tall = pairable ? stacked(pairedSize) : measures.reduce((sum, widths) => sum + Math.max(2.5 * size, broken(widths, size, wide) * (leading + 0.06) * Math.ceil(1.37 * size)), 0)
        const beside = (column - most * Theme.unit - (width < height ? 4 : 2.5) * Theme.gap) * 0.95
        const noted = notedMeasures.reduce((sum, widths) => sum + lines(widths, cardSize, beside), 0)
        const heading = lines(keptMeasures, 1.08 * Theme.body, width < height ? column - 4 * Theme.gap : beside) * Math.ceil(1.37 * Theme.body)
        const above = width < height ? heading + 0.6 * Theme.gap : 0
        const card = (width < height ? 0 : heading) + 1.38 * Theme.size(72) + noted * Math.ceil(1.37 * cardSize) + (width < height ? 4.1 : cardSize > Theme.small ? 1.8 : 2.6) * Theme.gap
        return tall + (pairable ? between + 2 * apart * Theme.gap : (read.length + 1) * apart * Theme.gap) + above + Math.max((width < height ? Math.max(362, most + 72) + 20 : cardSize > Theme.small ? 318 : 266) * Theme.unit, card)
    }
    // What is added to that where an upright page has room for it.
    readonly property real further: !signed || width > height ? 0
        : Math.max(0, Math.min(Theme.gap, (0.92 * room - estimate(size, noted, apart, most)) / read.length))
    // The widths of texts in letters of 100 pixels, part by part, measured once for all sizes that are tried.
    readonly property bool upright: width < height
    readonly property var measures: read.map(line => measured(line.text, boldLetters))
    readonly property var notedMeasures: [upright ? words["debrief-code"] : "", debrief.withdrawing, debrief.returning, debrief.questions].map(text => measured(text, letters))
    readonly property var keptMeasures: measured(kept, letters)
    function measured(text: string, first: FontMetrics): var {
        return text.split("\n").map((part, index) => (index === 0 ? first : letters).advanceWidth(part))
    }
    // The lines of a point, whose heading is bold; lines that break at words are not full.
    function broken(widths: var, size: real, room: real): int {
        return widths.reduce((sum, wide) => {
            const share = wide * size / 100 / room
            return sum + Math.ceil(share > 1 ? 1.06 * share : share)
        }, 0)
    }
    function lines(widths: var, size: real, room: real): int {
        return widths.reduce((sum, wide) => sum + Math.ceil(wide * size / 100 / room), 0)
    }

    // The helper says the last line. It says the last two where the first of them would stand alone between cards and code.
    readonly property bool both: sayable(debrief.lines, 2) !== "" && debrief.lines.length === 5 && debrief.lines[0].sign !== ""
    aside: both ? sayable(debrief.lines, 2) : sayable(debrief.lines)
    readonly property var read: aside === "" ? debrief.lines : debrief.lines.slice(0, both ? -2 : -1)

    title: debrief.title
    label: words["debrief-continue"]
    onWent: debrief.proceed()
    onVisibleChanged: way.focus = true
    Keys.onPressed: event => pane.turn(event)

    component Point: SignedLine {
        required property var modelData
        text: modelData.text
        sign: view.signed ? modelData.sign : ""
        size: view.size
        leading: view.signed ? view.leading : 1.08
        // Among lines with headings, one without is a heading itself.
        strong: lead === "" && view.read.some(line => line.text.includes("\n"))
    }
    // Those that stand in pairs have a frame.
    component Card: Rectangle {
        id: card
        required property var modelData
        property bool bare: false
        property real tall: said
        readonly property real inset: bare ? 0 : view.inset
        readonly property bool runsOn: bare && view.runsOn(view.measured(modelData.text, boldLetters), view.headingSize)
        readonly property real said: runsOn ? lead.height : point.height
        height: tall + 2 * inset
        radius: Theme.radius
        color: bare ? "transparent" : Theme.white
        border { color: Theme.edge; width: bare ? 0 : 3 * Theme.unit }
        Point {
            id: point
            visible: !card.runsOn
            x: card.bare ? 0 : view.insetAcross
            y: card.inset
            width: card.width - 2 * x
            modelData: card.modelData
            sign: card.bare ? "" : modelData.sign
        }
        Item {
            id: lead
            // The whole point, which is found by it in the preview.
            readonly property string text: card.modelData.text
            readonly property var parts: card.runsOn ? view.sentences(text) : ["", ""]
            visible: card.runsOn
            width: card.width
            height: head.height
            PlainText {
                id: head
                x: Theme.across(0, width, parent.width)
                text: lead.parts[0]
                font { pixelSize: view.headingSize; bold: true }
            }
            PlainText {
                x: Theme.across(head.width + 0.3 * view.headingSize, width, parent.width)
                text: lead.parts[1]
                font.pixelSize: view.headingSize
            }
        }
    }
    ScrollPane {
        id: pane
        width: parent?.width ?? 0
        y: view.sink(height)
        room: view.room
        more: view.words["scroll-more"]
        // Short lines are read with less effort than long ones: in two columns where there is room.
        Item {
            id: parts
            // What is taken home is seen without scrolling.
            readonly property bool cardFirst: keepsake.there && texts.height + keepsake.height + apart > view.room
            width: pane.width
            height: texts.height + keepsake.height + (keepsake.there ? apart : 0)
            // Lines and card stand further apart than the lines, by half of what is free; below cards, as far as from the way on.
            readonly property real apart: view.paired ? Math.max(Theme.gap, Math.min(1.6 * Theme.gap, (view.room + Theme.gap - texts.height - keepsake.height) / 2)) : Theme.gap + (view.signed ? Math.max(0, Math.min(1.5 * Theme.gap, (view.room - texts.height - keepsake.height - 1.34 * Theme.gap) / 2)) : 0)
            Item {
                id: texts
                y: parts.cardFirst ? keepsake.height + parts.apart : 0
                readonly property var lines: view.read
                readonly property bool halved: pane.width > 1100 * Theme.unit && lines.length > 1 && !view.signed
                readonly property int first: halved ? view.half(lines.map(line => line.text)) : lines.length
                readonly property real half: (width - 2 * Theme.gap) / 2
                width: pane.width
                height: view.paired ? pairs.height : below.height
                Column {
                    id: pairs
                    Repeater {
                        model: view.paired ? view.rows : []
                        Row {
                            id: row
                            required property var modelData
                            required property int index
                            topPadding: view.step(index)
                            // As high as the one that says more.
                            readonly property real tall: Math.max(...Array.from(children, each => (each as Card)?.said ?? 0))
                            spacing: Theme.gap
                            // A plain line between cards and the code has as much air above its letters as below them.
                            transform: Translate {
                                y: row.index > 1 && row.modelData.length === 1 && keepsake.there && !parts.cardFirst
                                    ? Math.round(Math.max(0, parts.apart - row.topPadding - 0.17 * view.headingSize) / 2) : 0
                            }
                            Repeater {
                                model: row.modelData
                                Card {
                                    width: (texts.width - (row.modelData.length - 1) * row.spacing) / row.modelData.length
                                    bare: row.modelData.length === 1
                                    tall: row.tall
                                }
                            }
                        }
                    }
                }
                Row {
                    id: below
                    spacing: 2 * Theme.gap
                    Repeater {
                        model: view.paired ? 0 : texts.halved ? 2 : 1
                        Column {
                            id: part
                            required property int index
                            width: texts.halved ? texts.half : texts.width
                            spacing: (view.signed ? view.apart : view.room < 720 * Theme.unit ? 0.6 : 1) * Theme.gap + view.further
                            Repeater {
                                model: part.index === 0 ? texts.lines.slice(0, texts.first) : texts.lines.slice(texts.first)
                                Point { width: part.width }
                            }
                        }
                    }
                }
            }
            Rectangle {
                id: keepsake
                y: parts.cardFirst ? 0 : texts.height + parts.apart
                width: pane.width
                // On an upright screen its first line stands over all of its width, so that the code has more room.
                readonly property real crown: told.stacked ? first.height + 0.6 * Theme.gap : 0
                readonly property real inner: Math.max(qr.height + 2 * view.rim, told.height)
                height: there ? crown + inner + 2 * view.pad : 0
                // Who is not stored has no code, and may have questions all the same.
                readonly property bool there: view.debrief.code !== "" || view.debrief.questions !== ""
                visible: there
                radius: Theme.radius
                color: Theme.white
                border { color: Theme.amber; width: 4 * Theme.unit }

                Balanced {
                    id: first
                    visible: told.stacked
                    x: Theme.across(view.pad, width, parent.width)
                    y: view.pad
                    width: parent.width - 2 * view.pad
                    text: view.kept
                    font { pixelSize: Theme.body; bold: true }
                    horizontalAlignment: Text.AlignLeft
                }
                // On white even where the theme is dark: a camera needs it.
                Rectangle {
                    id: qr
                    objectName: "qr"
                    visible: view.debrief.code !== ""
                    anchors { left: parent.left; leftMargin: view.pad + view.rim; verticalCenter: parent.verticalCenter; verticalCenterOffset: keepsake.crown / 2 }
                    width: view.square * view.debrief.squares
                    height: width
                    color: "white"
                    Accessible.role: Accessible.Graphic
                    Accessible.name: view.debrief.scanning
                    Rectangle {
                        z: -1
                        anchors { fill: parent; margins: -view.rim }
                        radius: 3 * view.rim
                        color: "white"
                    }
                    Image {
                        anchors.fill: parent
                        source: view.debrief.picture
                        smooth: false
                        cache: false
                        Accessible.ignored: true
                    }
                }
                Column {
                    id: told
                    readonly property bool stacked: view.signed && view.width < view.height
                    // Beside a large code, as large as the lines above the card, where that makes it no higher.
                    readonly property real large: Theme.size(92)
                    readonly property bool grand: view.paired && view.debrief.code !== "" && qr.height >= 280 * Theme.unit && grown <= qr.height + 2 * view.rim
                    readonly property real grown: 1.37 * large + 0.4 * Theme.gap + Math.ceil(1.37 * view.pairedSize)
                        * (view.lines(view.keptMeasures, 1.08 * view.pairedSize, 0.95 * width) + view.notedMeasures.reduce((sum, widths) => sum + view.lines(widths, view.pairedSize, 0.95 * width), 0))
                    readonly property real size: grand ? view.pairedSize : view.noted
                    // Whether the name of the code has a line of its own, so that all of it begins at one edge: on an
                    // upright screen as a heading, and else small over the code, close to it.
                    readonly property bool named: stacked || captioned
                    readonly property bool captioned: grand && grown + 1.37 * (Theme.reading - 0.15 * large) + 0.4 * Theme.gap <= qr.height + 2 * view.rim
                    anchors {
                        left: qr.right; leftMargin: (view.debrief.code !== "" ? 1.5 : 0.25) * Theme.gap
                        right: parent.right; rightMargin: stacked ? view.pad : Theme.gap
                        verticalCenter: parent.verticalCenter; verticalCenterOffset: keepsake.crown / 2
                    }
                    spacing: (view.signed ? 0.2 : 0.3) * Theme.gap
                    Balanced {
                        width: parent.width
                        visible: !told.stacked
                        text: view.kept
                        font { pixelSize: told.grand ? told.size : Theme.body; bold: true }
                        horizontalAlignment: Text.AlignLeft
                    }
                    // The code stands below its name, and beside it where there is no height for that.
                    Item {
                        width: parent.width
                        height: told.named ? code.y + code.height : Math.max(called.height, code.height)
                        visible: view.debrief.code !== ""
                        PlainText {
                            id: called
                            x: Theme.across(0, width, parent.width)
                            y: told.captioned ? 0.4 * Theme.gap : told.stacked ? 0 : Math.max(0, code.height - height) / 2
                            width: (told.named ? 1 : 0.45) * parent.width
                            text: view.words["debrief-code"]
                            font { pixelSize: told.captioned ? Theme.reading : told.size; bold: !told.captioned }
                            horizontalAlignment: Text.AlignLeft
                            wrapMode: Text.Wrap
                            color: told.captioned ? Theme.faintInk : Theme.ink
                        }
                        PlainText {
                            id: code
                            readonly property real from: told.named ? 0 : called.contentWidth + Theme.gap
                            objectName: "code"
                            x: Theme.across(from, width, parent.width)
                            y: told.named ? called.height + (told.captioned ? 0.4 * Theme.gap : 0) : 0
                            // Its letters have much air above them.
                            topPadding: told.captioned ? -0.18 * told.large : 0
                            width: parent.width - from
                            text: view.debrief.code
                            horizontalAlignment: Text.AlignLeft
                            font { pixelSize: told.grand ? told.large : Theme.size(view.signed ? 72 : 64); bold: true; letterSpacing: 4 * Theme.unit }
                            fontSizeMode: Text.HorizontalFit
                            minimumPixelSize: Theme.body
                            color: Theme.sea
                        }
                    }
                    Balanced {
                        width: parent.width
                        visible: text !== ""
                        text: view.debrief.withdrawing
                        font.pixelSize: told.size
                        color: Theme.ink
                    }
                    Balanced {
                        objectName: "returning"
                        width: parent.width
                        visible: text !== ""
                        text: view.debrief.returning
                        font.pixelSize: told.size
                        color: Theme.ink
                    }
                    Balanced {
                        objectName: "questions"
                        width: parent.width
                        visible: text !== ""
                        text: view.debrief.questions
                        font.pixelSize: told.size
                        color: Theme.ink
                    }
                }
            }
        }
    }
}
