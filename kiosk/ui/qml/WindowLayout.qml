// Where the page, the helper, the controls and the steps of a visit stand in the window, on every screen.
import QtQuick
import Recollect
import "."

QtObject {
    id: layout

    // The window, and how much of its height a replay leaves.
    required property real width
    required property real height
    required property real room
    required property bool boardOnRight
    required property KioskScreen kiosk
    required property AvatarScreen avatar
    // What is placed, for what it measures of itself. There is a board only while it is shown.
    required property BoardView board
    required property SidePanel helper
    required property Corner corner
    required property Progress steps

    readonly property bool wide: width >= height
    // A robot stands outside the screen: then the board has the whole width, and what is said stands below it.
    readonly property bool whole: wide && !avatar.present
    // Beside a robot an upright screen has all of its height, but for a line of controls and the sentence above it.
    readonly property bool high: !wide && !avatar.present
    // On a wide screen the helper stands beside every page, and says some of its lines.
    readonly property bool accompanied: wide && avatar.present
    // A form without an onlooker stands in the middle.
    readonly property bool unwatched: avatar.away && kiosk.screen === "form"
    // Whether the helper stays in sight beside a question that lies over everything, as the one who asks.
    readonly property bool asking: avatar.present && !avatar.away && !kiosk.paused && !kiosk.waits && (kiosk.asksStillThere || kiosk.asks === "stop")
    readonly property bool speaks: speaksOn(kiosk.screen)
    readonly property real sentence: speaks ? 260 * Math.max(1, Theme.textSize) * Theme.unit : 0

    function speaksOn(screen: string): bool {
        return ["attract", "introduction", "practice", "game", "result", "thanks"].includes(screen)
    }

    // The page.
    // On a wide screen its size depends on the page alone, so that one that is filled has its size already.
    function widthOn(screen: string): real {
        return !wide || whole || avatar.away && screen === "form" ? width : width * (screen === "attract" ? 0.64 : 0.715)
    }
    function heightOn(screen: string): real {
        return !wide ? uprightHeight
             : room - (!whole ? 0 : speaksOn(screen) ? 176 * Math.max(1, Theme.textSize) * Theme.unit : corner.visible ? 84 * Theme.unit : 0)
    }
    readonly property real free: room - corner.height - Theme.gap - sentence
    // On an upright screen the assistant stands below: with its sentence, alone, or not at all. It makes room for
    // large texts, but on a form, where the keys of a number stand in its place.
    readonly property real uprightHeight: high ? (board !== null ? Math.min(free, board.boardLayout.wish) : free)
        : unwatched ? room - uprightFoot : room * uprightShare
    // What stands below a form without an onlooker: the controls, and the helper's back, unless large texts need its height.
    readonly property real uprightFoot: Math.max(corner.height + Theme.gap, Theme.textSize <= 1 ? 144 * Theme.unit : 0)
    // Board and assistant stand close together: the board takes what its cards need, at least half of the screen.
    readonly property real uprightShare: !speaks ? (Theme.textSize > 1.15 && kiosk.screen !== "form" ? 0.84 : 0.78)
        : kiosk.screen === "attract" ? (Theme.textSize > 1.3 ? 0.76 : Math.max(helper.says ? 0.57 : 0.64, 0.57 + 0.25 * (Theme.textSize - 1)))
        // Its boards keep their distance to the buttons.
        : kiosk.screen === "introduction" && Theme.textSize <= 1.15 ? 0.66
        : kiosk.screen === "result" && Theme.textSize <= 1.15 ? 0.67
        : board === null ? 0.64
        // The helper keeps its size from the practice to the game.
        : Math.max(Theme.textSize <= 1 ? 0.628 : 0.62, Math.min(0.64, board.boardLayout.wish / room))
    readonly property real pageWidth: widthOn(kiosk.screen)
    readonly property real pageHeight: heightOn(kiosk.screen)
    readonly property real pageX: wide && boardOnRight ? width - pageWidth : 0
    readonly property real pageY: wide || board === null ? 0 : Math.round(high ? Math.max(0, (free - pageHeight) / 2) : 0.015 * room)
    readonly property point pageMiddle: Qt.point(pageX + (board !== null ? board.boardLayout.middle : pageWidth / 2), room / 2)
    // The words of the start screen may stand a little lower, beside the room above the helper's ears.
    readonly property real attractLower: !wide && avatar.present && !helper.says && Theme.textSize <= 1.15 ? 0.045 * room : 0

    // The helper, with its bubble.
    readonly property bool helperBelow: !wide || whole
    // A whole number: edges that move by fractions do not come back to the last bit.
    readonly property real helperAbove: !helperBelow && corner.visible ? Math.ceil(corner.height + 0.7 * Theme.gap) : 0
    // On an upright screen a long sentence may reach up to the cards, where an announcement stood before it.
    readonly property real helperReach: board !== null && !wide && avatar.present && Theme.textSize <= 1 ? 80 * Theme.unit : 0
    // How far its bubble may reach out of it, up to what stands below the cards.
    readonly property real helperLift: board !== null && !wide && avatar.present ? Math.max(0, helperY - pageY - board.foot) : 0
    readonly property real helperX: helperBelow ? (width - helperWidth) / 2 : boardOnRight ? Theme.gap : pageWidth
    readonly property real helperY: helperBelow ? pageY + pageHeight - helperReach : helperAbove
    // An upright screen's bubble has the edges of its pages, and of the cards. Beside a robot on a wide screen, what is
    // said ends before the controls.
    readonly property real helperWidth: !helperBelow ? width - pageWidth - Theme.gap
        : !wide ? width - (board !== null ? 2 * board.boardLayout.edge : 4 * Theme.gap)
        : Math.min(0.76 * width, width - 2 * (3 * corner.step + 1.7 * Theme.gap))
    readonly property real helperHeight: high ? sentence : helperBelow ? room - helperY : room - helperAbove
    // How much of that is its face, where it speaks: large sentences need the room.
    readonly property real faceShare: wide ? (kiosk.screen === "attract" ? 0.6 : 0.52)
        : Theme.textSize > 1.15 ? 0.64
        : board !== null ? (Theme.textSize <= 1 ? 0.77 : 0.68)
        : kiosk.screen === "attract" ? (helper.says ? 0.88 : 0.98)
        : kiosk.screen === "introduction" ? 0.68 : kiosk.screen === "result" ? 0.755 : 0.72

    // The place of what the helper looks over beside the debriefing, as that page sees it: it begins where the eyes are at
    // least in sight, and ends with the way on.
    readonly property real ticketWidth: width - widthOn("debrief") - Theme.gap
    readonly property real ticketFace: helper.faceWidth(ticketWidth, room - helperAbove, 0.52) * 440 / 400
    readonly property real ticketY: helperAbove + 0.46 * ticketFace
    readonly property rect ticket: !accompanied ? Qt.rect(0, 0, 0, 0)
        : Qt.rect(Math.round(boardOnRight ? Theme.gap - (width - widthOn("debrief")) : widthOn("debrief")), ticketY,
            Math.round(ticketWidth), room - 40 * Theme.unit - ticketY)

    // The face, as the cards that lie over a page see it: where it begins below them, or where its middle is beside
    // them, and the edge of the helper's place. 0 where it is not there.
    readonly property real faceBelow: !wide && avatar.present && !avatar.away ? helperY + helper.faceTop : 0
    readonly property real faceBeside: accompanied && !avatar.away ? helperY + helper.faceMiddle : 0
    readonly property real helperEdge: boardOnRight ? helperX + helperWidth : helperX

    // The controls: above the helper; beside a robot and on an upright screen at the bottom, where a sentence leaves room.
    // The title of a page without an onlooker begins at the left.
    readonly property bool cornerAtLeft: wide && !whole && boardOnRight && !unwatched
    readonly property int cornerPlaces: !wide ? (unwatched || high ? 5 : 1) : whole && speaks ? 3 : 5
    // Where the game speaks, there is always a place for the button that comes and goes.
    readonly property bool cornerKeeps: speaks && kiosk.inSession
    readonly property real cornerX: cornerAtLeft ? Theme.gap + (cornerKeeps ? corner.fullWidth - corner.width : 0)
        : width - corner.width - 0.7 * Theme.gap
    // In a column it is the uppermost one.
    readonly property real cornerY: accompanied ? 0.7 * Theme.gap
        : room - (cornerKeeps && cornerPlaces > 1 ? corner.fullHeight : corner.height) - 0.5 * Theme.gap

    // The steps: beside the controls, or in the other corner. Beside the place of the button that comes and goes they
    // stay where they are, clear of it and of what ends a title.
    readonly property real stepsX: !accompanied ? Theme.gap : cornerAtLeft ? 2.5 * Theme.gap + corner.fullWidth
        : cornerX + corner.width - corner.fullWidth - 1.5 * Theme.gap - steps.width
    readonly property real stepsY: accompanied ? cornerY + (corner.step - corner.spacing - steps.height) / 2
        : room - steps.height - Theme.gap
}
