// What the study was about, and the code to withdraw with: to be written down, or photographed.
import QtQuick
import Recollect
import "."
import "debrief"

PageFrame {
    id: view

    required property DebriefScreen debrief
    required property string labName

    // The helper says the last point. It says the last two where the first of them would stand alone between cards and code.
    readonly property bool lastTwoSaid: debrief.lines.length === 5 && debrief.lines[0].sign !== ""
        && sayable(debrief.lines, 2) !== ""
    aside: sayable(debrief.lines, lastTwoSaid ? 2 : 1)

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
        points: view.aside === "" ? view.debrief.lines : view.debrief.lines.slice(0, view.lastTwoSaid ? -2 : -1)
        lastTwoSaid: view.lastTwoSaid
        kept: view.words[view.debrief.code === "" ? "debrief-take-home" : "debrief-take-home-scan"]
            + (view.labName === "" ? "" : " · " + view.labName)
        codeName: view.words["debrief-code"]
        notes: [view.debrief.withdrawing, view.debrief.returning, view.debrief.questions]
        squares: view.debrief.squares
        upright: view.width < view.height
        accompanied: view.accompanied
        column: view.column
        room: view.room
    }
    PointPairs {
        id: pointPairs
        page: shape
    }
    DebriefSizes {
        id: debriefSizes
        page: shape
        pairs: pointPairs
    }
    ScrollPane {
        id: pane
        y: view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        Item {
            id: parts
            // What there is beside both, or less than nothing.
            readonly property real free: view.room - texts.height - card.height
            // Points and card stand further apart than the points, by half of what is free; below cards, as far as from the
            // way on.
            readonly property real apart: Math.max(1, debriefSizes.paired ? Math.min(1.6, free / Theme.gap / 2 + 0.5)
                : debriefSizes.signed ? Math.min(2.5, free / Theme.gap / 2 + 0.33) : 1) * Theme.gap
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
                apart: card.there && !parts.cardFirst ? parts.apart : 0
            }
            TakeHomeCard {
                id: card
                y: parts.cardFirst ? 0 : texts.height + parts.apart
                width: parent.width
                debrief: view.debrief
                page: shape
                pairs: pointPairs
                sizes: debriefSizes
                room: view.room - texts.height - (shape.upright ? 1.1 : 1) * Theme.gap
            }
        }
    }
}
