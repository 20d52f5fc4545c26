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

    aside: sayable(debrief.lines)

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
        points: view.aside === "" ? view.debrief.lines : view.debrief.lines.slice(0, -1)
        half: view.half(points.map(point => point.text))
        kept: view.words["debrief-take-home"]
        codeName: view.words["debrief-code"]
        notes: [view.debrief.withdrawing, view.debrief.returning, view.debrief.questions, view.labName]
        squares: view.debrief.squares
        coded: view.debrief.code !== ""
        upright: view.width < view.height
        column: view.column
        room: view.room
    }
    PointPairs {
        id: pointPairs
        page: shape
        taken: texts.taken + card.height
    }
    DebriefSizes {
        id: debriefSizes
        page: shape
        pairs: pointPairs
    }
    ScrollPane {
        id: pane
        // Parts that are as far apart as each other are as far from the title as from the way on.
        y: debriefSizes.paired ? Math.max(0, Math.min(2.5 * Theme.gap, (view.room - parts.height) / 2)) : view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        Item {
            id: parts
            // What there is beside both, or less than nothing.
            readonly property real free: view.room - texts.height - card.height
            // Points and card stand further apart than the points, by half of what is free.
            readonly property real apart: debriefSizes.paired ? Theme.gap + Math.max(0, Math.min(pointPairs.further, free - Theme.gap))
                : Math.max(1, !debriefSizes.signed ? 1 : Math.min(2.5, free / Theme.gap / 2 + 0.33)) * Theme.gap
            // What is taken home is seen without scrolling.
            readonly property bool cardFirst: card.there && free < apart
            width: pane.width
            height: texts.height + (card.there ? apart + card.height : 0)
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
                y: parts.cardFirst ? 0 : texts.height + parts.apart
                width: parent.width
                debrief: view.debrief
                page: shape
                sizes: debriefSizes
                labName: view.labName
                room: view.room - texts.height - (shape.upright ? 1.1 : 1) * Theme.gap
            }
        }
    }
}
