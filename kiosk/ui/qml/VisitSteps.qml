// What is studied, the steps of a visit as cards that lead from one to the next, and what all of it takes.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: visit

    // Each line has a heading and a text; the last is null where the helper says it.
    required property var lead
    required property var steps
    required property var last
    required property bool upright
    required property real room
    required property WordWidths widths
    required property url picture
    required property url cardBack
    required property url cardShadow
    // Whether all of it has room in letters that are easy to read.
    readonly property bool fits: found !== undefined

    function headingOf(text: string): string {
        return text.slice(0, text.indexOf("\n"))
    }
    function bodyOf(text: string): string {
        return text.slice(text.indexOf("\n") + 1).replace(/(\d) /g, "$1\u00a0")
    }

    // How large headings and texts of the cards are, and their drawings: the first that has room. Large drawings are better
    // than larger letters, and so are headings of one line and texts of few.
    readonly property var found: steps.length === 0 ? undefined : chosen()
    function chosen(): var {
        const held = trials().filter(trial => trial.page <= room - foot)
        return [[1, 3, 176], [2, 3, 176], [2, 4, 176], [1, 9, 0], [2, 9, 0]].map(([head, body, side]) => held.find(trial =>
            trial.side >= side * Theme.unit && trial.headLines <= head && trial.bodyLines <= body)).find(trial => trial !== undefined)
    }
    // Each with the lines of the card that has most, and how high such a card and all of the page are.
    function trials(): var {
        const all = []
        // Large letters of a small size are as easy to read as small letters of a large one.
        const smaller = Theme.textSize > 1 ? upright ? [[42, 35], [40, 34]] : [[34, 31], [33, 30]] : []
        for (const [head, body] of [...(upright ? [[50, 42], [48, 40], [46, 38], [44, 36]] : [[44, 38], [42, 37], [40, 36], [38, 34], [36, 33]]), ...smaller]) {
            let words = null
            for (const side of upright ? [208, 190, 170, 150, 132] : [260, 240, 220, 200, 188, 176, 160, 140, 120]) {
                // Beside no drawing, words have the same lines whatever its size.
                words = upright || words === null ? wordsAt(Theme.size(head), Theme.size(body), wordsWidth(side * Theme.unit)) : words
                const card = cardTall(side * Theme.unit, words.tall)
                all.push({head: Theme.size(head), body: Theme.size(body), side: side * Theme.unit, headLines: words.headLines, bodyLines: words.bodyLines, card: card, page: least(card)})
            }
        }
        return all
    }
    readonly property real head: found?.head ?? 0
    readonly property real body: found?.body ?? 0
    readonly property real side: found?.side ?? 0
    readonly property real leading: 1

    // The cards end where those of other pages do.
    readonly property real foot: (upright ? 44 : 15.6) * Theme.unit
    readonly property real between: 34 * Theme.unit
    readonly property real gutter: (upright ? 30 : 32) * Theme.unit
    readonly property real pad: (upright || last !== null ? 26 : 28) * Theme.unit
    readonly property real lastSide: (lastInLine ? 72 : 88) * Theme.unit
    // Whether what all of it takes has room in one line.
    readonly property bool lastInLine: last !== null && widths.bold(headingOf(last.text), lastHead) + widths.slack * widths.plain(bodyOf(last.text), lastBody)
        + 72 * Theme.unit + 2.2 * Theme.gap <= width
    readonly property real lastHead: Theme.size(upright ? 46 : 40)
    readonly property real lastBody: Theme.size(upright ? 38 : 34)
    readonly property real lastTall: last === null ? 0 : between + lastSide + (lastInLine ? 0 : Math.max(0, high(widths.lines(headingOf(last.text), lastHead, lastWidth), lastHead)
        + high(widths.plainLines(bodyOf(last.text), lastBody, lastWidth), lastBody) - lastSide))
    readonly property real lastWidth: width - lastSide - Theme.gap
    readonly property real cardWidth: upright ? width : (width - (steps.length - 1) * gutter) / Math.max(1, steps.length)

    // How high a text of so many lines is.
    function high(lines: int, size: real): real {
        return lines * leading * widths.leading * size
    }
    // In one line on a wide page, if that makes it only a little smaller.
    readonly property real leadSize: upright ? Theme.size(44) : [42, 40, 38, 36].map(Theme.size).find(size => widths.plainLines(bodyOf(lead.text), size, width) === 1) ?? Theme.size(40)
    readonly property real leadTall: high(1, Theme.size(36)) + high(widths.plainLines(bodyOf(lead.text), leadSize, width), leadSize)
    function wordsWidth(side: real): real {
        return cardWidth - (upright ? side + 1.5 * Theme.gap + 2 * pad : 44 * Theme.unit)
    }
    function wordsAt(head: real, body: real, wide: real): var {
        const heads = steps.map(step => widths.lines(headingOf(step.text), head, wide))
        const bodies = steps.map(step => widths.plainLines(bodyOf(step.text), body, 0.98 * wide))
        const tall = steps.map((_, at) => high(heads[at], head) + high(bodies[at], body))
        return {headLines: Math.max(...heads), bodyLines: Math.max(...bodies), tall: Math.max(...tall)}
    }
    function cardTall(side: real, words: real): real {
        return 2 * pad + (upright ? Math.max(side, words) : side + Theme.gap + words)
    }
    function least(card: real): real {
        const rows = upright ? steps.length : 1
        return leadTall + between + rows * card + (rows - 1) * gutter + lastTall
    }
    // Cards take what the page has left, up to a third of their height.
    readonly property real tall: {
        if (!found)
            return 0
        const rows = upright ? steps.length : 1
        return Math.floor(found.card + Math.max(0, Math.min(0.33 * found.card, (room - foot - found.page) / rows)))
    }

    Column {
        width: parent.width
        spacing: visit.between

        Item {
            id: told
            readonly property string text: visit.lead.text
            width: parent.width
            height: visit.leadTall
            Column {
                width: parent.width
                Balanced {
                    width: parent.width
                    visible: visit.lead.text !== ""
                    text: visit.headingOf(told.text)
                    horizontalAlignment: Text.AlignLeft
                    font { pixelSize: Theme.size(36); bold: true }
                    lineHeight: visit.leading
                    color: Theme.sea
                }
                Balanced {
                    width: parent.width
                    text: visit.bodyOf(told.text)
                    horizontalAlignment: Text.AlignLeft
                    font.pixelSize: visit.leadSize
                    lineHeight: visit.leading
                }
            }
        }
        Grid {
            id: cards
            width: parent.width
            columns: visit.upright ? 1 : Math.max(1, visit.steps.length)
            spacing: visit.gutter
            Repeater {
                // By number: a list that is made anew with the same steps would have all cards made anew.
                model: visit.steps.length
                Rectangle {
                    id: card
                    required property int index
                    readonly property string text: visit.steps[index]?.text ?? ""
                    objectName: "step"
                    width: visit.cardWidth
                    height: visit.tall
                    radius: Theme.radius
                    color: Theme.white
                    border { color: Theme.edge; width: 3 * Theme.unit }
                    // What is above and below the content of a card that is higher than that.
                    readonly property real spare: height - (visit.found?.card ?? height)
                    StepDrawing {
                        id: drawing
                        x: visit.upright ? Theme.across(visit.pad, width, card.width) : (card.width - width) / 2
                        y: visit.upright ? (card.height - height) / 2 : visit.pad + 0.45 * card.spare
                        width: visit.side
                        sign: visit.steps[card.index]?.sign ?? ""
                        picture: visit.picture
                        back: visit.cardBack
                        shadow: visit.cardShadow
                    }
                    Column {
                        x: visit.upright ? Theme.across(visit.pad + visit.side + 1.5 * Theme.gap, width, card.width) : (card.width - width) / 2
                        y: visit.upright ? (card.height - height) / 2 : drawing.y + visit.side + Theme.gap
                        width: visit.wordsWidth(visit.side)
                        Balanced {
                            width: parent.width
                            text: visit.headingOf(card.text)
                            horizontalAlignment: visit.upright ? Text.AlignLeft : Text.AlignHCenter
                            font { pixelSize: visit.head; bold: true }
                            lineHeight: visit.leading
                        }
                        Balanced {
                            width: parent.width
                            text: visit.bodyOf(card.text)
                            horizontalAlignment: visit.upright ? Text.AlignLeft : Text.AlignHCenter
                            font.pixelSize: visit.body
                            lineHeight: visit.leading
                        }
                    }
                    // Where the next card follows.
                    Rectangle {
                        objectName: "path"
                        visible: card.index + 1 < visit.steps.length
                        x: visit.upright ? Theme.across(visit.pad + (visit.side - width) / 2, width, card.width)
                            : Theme.across(card.width + (visit.gutter - width) / 2, width, card.width)
                        y: visit.upright ? card.height + (visit.gutter - height) / 2 : drawing.y + (visit.side - height) / 2
                        width: 60 * Theme.unit
                        height: width
                        radius: width / 2
                        color: Theme.white
                        border { color: Theme.edge; width: 3 * Theme.unit }
                        Drawing {
                            anchors.centerIn: parent
                            scale: parent.width / 36
                            rotation: visit.upright ? 90 : Theme.mirrored ? 180 : 0
                            path: "M9.5 6 L15.5 12 L9.5 18"
                            ink: Theme.sea
                            thick: 2.4
                        }
                    }
                    z: visit.steps.length - index
                }
            }
        }
        Item {
            id: ending
            readonly property string text: visit.last?.text ?? ""
            visible: visit.lastInLine
            width: parent.width
            height: visit.lastSide
            Sign {
                id: sign
                x: Theme.across(0, width, ending.width)
                width: visit.lastSide
                color: Theme.sunny
                sign: visit.last?.sign ?? ""
            }
            PlainText {
                id: heading
                x: Theme.across(sign.width + Theme.gap, width, ending.width)
                anchors.verticalCenter: parent.verticalCenter
                text: visit.headingOf(ending.text)
                font { pixelSize: visit.lastHead; bold: true }
            }
            PlainText {
                x: Theme.across(sign.width + 1.9 * Theme.gap + heading.width, width, ending.width)
                anchors.baseline: heading.baseline
                text: visit.bodyOf(ending.text)
                font.pixelSize: visit.lastBody
            }
        }
        SignedLine {
            visible: visit.last !== null && !visit.lastInLine
            width: parent.width
            text: visit.last?.text ?? ""
            sign: visit.last?.sign ?? ""
            size: visit.lastBody
            leadSize: visit.lastHead
            badge: visit.lastSide
            ground: Theme.sunny
            leading: visit.leading
        }
    }
}
