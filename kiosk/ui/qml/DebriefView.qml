// What the study was about, and the code to withdraw with: to be written down, or photographed.
import QtQuick
import Recollect
import "."
import "debrief"

PageFrame {
    id: view

    required property DebriefScreen debrief
    required property string labName
    required property ResultScreen result
    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow
    // Where a ticket may stand that the helper looks over, as the page sees it: empty where it is not beside the page. How
    // large the helper is drawn there, and how high above the lower edge of that place the ticket begins; 0 without one.
    property rect slot
    property real helperSize: 1
    readonly property real edge: pointPairs.ticketed ? ticket.height : 0

    readonly property string said: sayable(debrief.lines)
    aside: pointPairs.ticketed ? "" : said

    title: debrief.title
    label: words["debrief-continue"]
    onWent: debrief.proceed()
    onVisibleChanged: way.focus = true
    Keys.onPressed: event => pane.turn(event)

    WordWidths {
        id: wordWidths
    }
    DebriefShape {
        id: shape
        widths: wordWidths
        all: view.debrief.lines
        fewer: view.said === "" ? view.debrief.lines : view.debrief.lines.slice(0, -1)
        points: pointPairs.ticketed ? shape.all : shape.fewer
        half: view.half(points.map(point => point.text))
        kept: view.words["debrief-take-home"]
        codeName: view.words["debrief-code"]
        notes: [view.debrief.withdrawing, view.debrief.returning, view.debrief.questions, view.labName]
        squares: view.debrief.squares
        coded: view.debrief.code !== ""
        upright: view.width < view.height
        column: view.column
        room: view.room
        wayWidth: view.way.wish
        wayHeight: view.way.height
    }
    TicketShape {
        id: ticketShape
        widths: wordWidths
        slot: view.slot
        codeName: shape.codeName
        code: view.debrief.code
        notes: shape.notes
        squares: shape.squares
    }
    PointPairs {
        id: pointPairs
        page: shape
        ticket: ticketShape
        taken: texts.taken + (footed ? 0 : card.height)
        room: pane.room
    }
    DebriefSizes {
        id: debriefSizes
        page: shape
        pairs: pointPairs
    }
    ScrollPane {
        id: pane
        // Parts that are as far apart as each other are as far from the title as from the way on.
        y: debriefSizes.paired ? Math.max(0, Math.min(2.5 * Theme.gap, (room - parts.height) / 2)) : view.sink(height)
        width: parent?.width ?? 0
        room: view.room + (pointPairs.footed ? view.way.height - card.height : 0)
        more: view.words["scroll-more"]
        Item {
            id: parts
            // What there is beside both, or less than nothing.
            readonly property real free: view.room - texts.height - card.height
            // Points and card stand further apart than the points, by half of what is free.
            readonly property real apart: debriefSizes.paired ? Theme.gap + Math.max(0, Math.min(pointPairs.further, free - Theme.gap))
                : Math.max(1, !debriefSizes.signed ? 1 : Math.min(2.5, free / Theme.gap / 2 + 0.33)) * Theme.gap
            // What is taken home is seen without scrolling.
            readonly property bool cardFirst: below && free < apart
            // Whether the card is below the points, and not at the foot of the page.
            readonly property bool below: card.there && !pointPairs.footed
            width: pane.width
            height: texts.height + (below ? apart + card.height : 0)
            DebriefPoints {
                id: texts
                y: parts.cardFirst ? card.height + parts.apart : 0
                width: parent.width
                frame: view
                page: shape
                pairs: pointPairs
                sizes: debriefSizes
                // One that the visitor found, if any.
                picture: view.result.pictures[0] ?? view.attract.pictures[0] ?? ""
                cardBack: view.cardBack
                cardShadow: view.cardShadow
            }
            TakeHomeCard {
                id: card
                parent: pointPairs.footed ? foot : parts
                y: pointPairs.footed || parts.cardFirst ? 0 : texts.height + parts.apart
                width: pointPairs.footed ? shape.footWidth : parts.width
                debrief: view.debrief
                page: shape
                sizes: debriefSizes
                labName: view.labName
                room: view.room - texts.height - (shape.upright ? 1.1 : 1) * Theme.gap
            }
        }
    }
    Ticket {
        id: ticket
        parent: view
        visible: pointPairs.ticketed
        x: view.slot.x
        y: Math.round(view.slot.y + view.slot.height - height)
        width: view.slot.width
        debrief: view.debrief
        page: ticketShape
        labName: view.labName
        helperSize: view.helperSize
    }
    // Beside the way on, both on one line.
    Item {
        id: foot
        x: Theme.across(0, shape.footWidth, parent?.width ?? 0)
        y: view.room + Theme.gap + view.way.height - card.height
    }
}
