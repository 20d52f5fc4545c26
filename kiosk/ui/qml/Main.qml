// The one window: a screen on the left, the assistant on the right, and at times a calm word over both.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Window
import Recollect
import "."
import "panel"

Window {
    id: root

    required property KioskScreen kiosk
    required property AttractScreen attract
    required property AboutScreen about
    required property ConsentScreen consent
    required property AgeScreen age
    required property FormScreen form
    required property IntroductionScreen introduction
    required property BoardScreen board
    required property ResultScreen result
    required property DebriefScreen debrief
    required property ThanksScreen thanks
    required property ReturnScreen returning
    required property AvatarScreen avatar
    required property ExperimenterScreen experimenter
    required property url cardBack
    required property url cardShadow
    required property real textSize
    required property int motion
    // A replay drives the screens from a bar below them; a kiosk has none.
    property ReplayControls replay: null
    // The same, where a replay shows what is remembered.
    property ReplayControls replayMemory: null
    required property bool highContrast
    required property bool boardOnRight
    required property color accent
    required property color background
    required property string labName
    required property url labLogo
    required property string screenKeys

    // Whether pages are made before they are shown, in the time between frames.
    property bool prepares: false
    // Whether the parts of a session are: after the pages, when their loaders know that they need not hurry.
    property bool preparesParts: false
    // Taken over once, as Python hands over all texts each time.
    readonly property var words: kiosk.words
    readonly property real texts: Math.min(1.5, textSize * kiosk.textScale)
    // How much of the height a replay leaves.
    readonly property real room: height - foot.height

    width: 1920
    height: 1080
    color: Theme.paper
    title: "Recollect"

    // An engine that is used again knows what the last person worked with.
    Component.onCompleted: Theme.byKeyboard = false
    // A visitor cannot close it: only what the experimenter does sets leaving.
    onClosing: close => close.accepted = kiosk.leaving

    Connections {
        target: root.kiosk
        function onAsked_again() { helper.stale = "" }
    }
    Connections {
        target: Theme
        function onClicked() { root.kiosk.press() }
    }
    Binding {
        target: Theme
        property: "unit"
        value: layout.wide ? Math.min(root.width / 1920, root.room / 1080)
                         : Math.min(root.width / 1080, root.room / 1920)
    }
    Binding { target: Theme; property: "upright"; value: !layout.wide }
    Binding { target: Theme; property: "textSize"; value: root.texts }
    Binding { target: Theme; property: "screenKeys"; value: root.screenKeys }
    Binding { target: Theme; property: "mirrored"; value: root.kiosk.mirrored }
    Binding { target: Theme; property: "motion"; value: root.motion }
    Binding { target: Theme; property: "highContrast"; value: root.highContrast }
    Binding { target: Theme; property: "accent"; value: root.accent }
    Binding { target: Theme; property: "background"; value: root.background }

    WindowLayout {
        id: layout
        width: root.width
        height: root.height
        room: root.room
        boardOnRight: root.boardOnRight
        kiosk: root.kiosk
        avatar: root.avatar
        board: boardPage.view
        helper: helper
        corner: corner
        steps: steps
    }

    component Page: PageLoader {
        kiosk: root.kiosk
        windowLayout: layout
        prepares: root.prepares
    }
    // Whether the parts of a session are made by now.
    readonly property bool needsParts: preparesParts || kiosk.inSession
    component Part: PartLoader {
        needed: root.needsParts
        prepares: root.prepares
    }
    Item {
        id: stage
        x: layout.pageX
        y: layout.pageY
        width: layout.pageWidth
        height: layout.pageHeight
        LayoutMirroring.enabled: Theme.mirrored
        LayoutMirroring.childrenInherit: true
        // A screen that has only just come takes no input: a double click belongs to the one before.
        enabled: root.kiosk.takesInput && root.kiosk.bare

        AttractView {
            id: attractView
            // As a page, it keeps its size while it is not seen.
            Binding on width { when: attractView.visible; value: layout.widthOn("attract"); restoreMode: Binding.RestoreNone }
            Binding on height { when: attractView.visible; value: layout.heightOn("attract") + layout.attractLower; restoreMode: Binding.RestoreNone }
            Binding on accompanied { when: attractView.visible; value: layout.accompanied; restoreMode: Binding.RestoreNone }
            visible: root.kiosk.screen === "attract"
            focus: visible && root.kiosk.bare
            attract: root.attract
            cardBack: root.cardBack
            cardShadow: root.cardShadow
            labName: root.labName
            labLogo: root.labLogo
            onVisibleChanged: if (visible) helper.stopNoticing()
            onLooked: place => helper.notice(helper.mapFromItem(attractView, place.x, place.y))
        }
        Page {
            id: aboutPage
            name: "about"
            sourceComponent: AboutView {
                Binding on accompanied { when: aboutPage.follows; value: layout.accompanied; restoreMode: Binding.RestoreNone }
                focus: true
                about: root.about
                attract: root.attract
                cardBack: root.cardBack
                cardShadow: root.cardShadow
                returning: root.returning
                kiosk: root.kiosk
                words: root.words
            }
        }
        Page {
            id: consentPage
            name: "consent"
            sourceComponent: ConsentView {
                Binding on accompanied { when: consentPage.follows; value: layout.accompanied; restoreMode: Binding.RestoreNone }
                focus: true
                consent: root.consent
                kiosk: root.kiosk
                words: root.words
            }
        }
        Page {
            id: agePage
            name: "age"
            sourceComponent: AgeView {
                Binding on accompanied { when: agePage.follows; value: layout.accompanied; restoreMode: Binding.RestoreNone }
                focus: true
                age: root.age
                kiosk: root.kiosk
                words: root.words
            }
        }
        // Keys of a number stand beside this page, and what stands beside a loader is not touched: it is as large as the
        // window.
        Part {
            id: formPage
            shown: root.kiosk.screen === "form"
            readonly property FormPage page: visible ? item as FormPage : null
            x: -stage.x
            y: -stage.y
            width: root.width
            height: root.height
            focus: visible && root.kiosk.bare
            sourceComponent: FormPage {
                kiosk: root.kiosk
                avatar: root.avatar
                form: root.form
                words: root.words
                windowLayout: layout
                follows: formPage.shown || formPage.status !== Loader.Ready || layout.wide && root.kiosk.coming === "form"
                helperGone: helper.gone
            }
        }
        Page {
            name: "introduction"
            sourceComponent: IntroductionView {
                focus: true
                prepares: root.prepares
                introduction: root.introduction
                kiosk: root.kiosk
                attract: root.attract
                words: root.words
                cardBack: root.cardBack
                cardShadow: root.cardShadow
            }
        }
        Part {
            id: boardPage
            shown: root.kiosk.screen === "game" || root.kiosk.screen === "practice"
            // As a page, it keeps its size while it is not seen: its cards are many.
            readonly property bool follows: !layout.wide || shown || status !== Loader.Ready || root.kiosk.coming === "game"
            Binding on width { when: boardPage.follows; value: layout.widthOn("game"); restoreMode: Binding.RestoreNone }
            Binding on height { when: boardPage.follows; value: layout.heightOn("game"); restoreMode: Binding.RestoreNone }
            focus: visible && root.kiosk.bare
            // Only while it is shown.
            readonly property BoardView view: visible ? item as BoardView : null
            sourceComponent: BoardView {
                id: boardView
                focus: true
                board: root.board
                words: root.words
                cardBack: root.cardBack
                cardShadow: root.cardShadow
                onTouchedSomething: helper.notice(helper.mapFromItem(boardView, touched.x, touched.y))
                upright: !layout.wide
                resizes: root.avatar.moves
                prepares: root.prepares
                said: helper.says
                lent: Math.max(0, layout.helperReach - Theme.gap)
                Binding on spoken { when: boardPage.follows; value: !layout.accompanied ? 0 : root.boardOnRight ? -1 : 1; restoreMode: Binding.RestoreNone }
                faceAt: layout.wide || !root.avatar.present ? 0 : helper.y + helper.faceTop - stage.y
                told: prompt.tells
                onWon: if (!root.board.practice) feast.begin()
                // The sentence that begins a practice may still be spoken, but it is time to read how the move goes on.
                onFirstTurned: if (root.board.practice && !root.board.speaking) helper.fade()
                onVisibleChanged: if (!visible) helper.stopNoticing()
            }
        }
        Page {
            name: "result"
            sourceComponent: ResultView {
                focus: true
                result: root.result
                kiosk: root.kiosk
                words: root.words
                prepares: root.prepares
            }
        }
        Page {
            id: debriefPage
            name: "debrief"
            // How high above the window's lower edge the ticket begins that the helper looks over; 0 without one.
            readonly property real edge: {
                const view = item as DebriefView
                return visible && view !== null && view.edge > 0 ? root.room - view.slot.y - view.slot.height + view.edge : 0
            }
            sourceComponent: DebriefView {
                Binding on accompanied { when: debriefPage.follows; value: layout.accompanied; restoreMode: Binding.RestoreNone }
                Binding on slot { when: debriefPage.follows; value: layout.ticket; restoreMode: Binding.RestoreNone }
                Binding on helperSize { when: debriefPage.follows; value: layout.ticketFace / 440; restoreMode: Binding.RestoreNone }
                focus: true
                debrief: root.debrief
                labName: root.labName
                result: root.result
                attract: root.attract
                cardBack: root.cardBack
                cardShadow: root.cardShadow
                kiosk: root.kiosk
                words: root.words
            }
        }
        Page {
            name: "thanks"
            sourceComponent: ThanksView {
                focus: true
                thanks: root.thanks
                result: root.result
                attract: root.attract
                kiosk: root.kiosk
                words: root.words
                cardBack: root.cardBack
                cardShadow: root.cardShadow
            }
        }
    }
    // Where the mouse is; a finger is only seen where it touches.
    HoverHandler {
        acceptedDevices: PointerDevice.Mouse | PointerDevice.TouchPad
        onPointChanged: helper.follow(point.position)
    }
    // Under the assistant, who rests meanwhile.
    Part {
        anchors.fill: parent
        shown: root.kiosk.paused || root.kiosk.screen === "pause"
        sourceComponent: CalmCard {
            windowLayout: layout
            // Beside the assistant, or above it.
            middle: layout.whole ? Qt.point(root.width / 2, root.room / 2)
                  : layout.wide ? layout.pageMiddle : Qt.point(root.width / 2, 0.36 * root.room)
            least: (roomy ? 480 : large ? 896 : 500) * Theme.unit
            cardBack: root.cardBack
            cardShadow: root.cardShadow
            title: root.words["pause-title"]
            titleSize: roomy ? Theme.size(96) : large ? largestInOneLine(title, [104, 100, 96, 92, 88, 84]) : Theme.size(84)
            line: root.kiosk.pauseLine
            more: root.kiosk.pauseMore
            lineFirst: root.kiosk.pauseEnds
            lineSize: Theme.size(large ? 46 : 42)
        }
    }
    Prompt {
        id: prompt
        board: root.board
        view: boardPage.view
        words: root.words
        // On a wide screen alone the helper stands beside the pages.
        line: !layout.wide ? ""
            : attractView.visible ? root.attract.line
            : formPage.visible ? (root.avatar.away || (formPage.page?.keysBeside ?? false) ? "" : root.words["form-calm"])
            : [aboutPage, agePage, consentPage, debriefPage].find(page => page.shown)?.aside ?? ""
        hushed: !root.avatar.present || root.kiosk.asks !== "" || root.kiosk.asksStillThere
        says: helper.says
    }
    SidePanel {
        id: helper
        // The keys of a number stand in its place.
        z: layout.asking ? 1 : (root.kiosk.screen === "form" || edge > 0) && !root.kiosk.paused ? -1 : 0
        x: layout.helperX
        y: layout.helperY
        width: layout.helperWidth
        height: layout.helperHeight
        visible: !layout.whole || layout.speaks
        avatar: root.avatar
        speaks: layout.wide || layout.speaks
        thinks: boardPage.visible && root.board.speaking
        rests: root.kiosk.paused
        waits: root.kiosk.asks !== "" || root.kiosk.asksStillThere
        share: layout.faceShare
        centred: layout.helperBelow && (boardPage.visible || parts)
        parts: root.kiosk.screen === "thanks"
        calls: layout.accompanied && attractView.visible
        grows: layout.helperReach > 0
        lift: layout.helperLift
        leads: layout.asking || !layout.speaks
        hushed: layout.asking || edge > 0
        // A question that it asks finds it where it usually is, and so does a pause.
        edge: layout.asking || root.kiosk.paused ? 0 : debriefPage.edge
        outcome: root.words["practice-no-pair"]
        outcomeOf: root.words["practice-turning-back"]
        aside: prompt.text
        asideAdvice: prompt.advice
        cheers: prompt.cheers
        triumphs: prompt.triumphs
        quiet: boardPage.view?.moves ?? false
        marks: boardPage.view?.marks ?? false
        marked: boardPage.view !== null ? helper.mapFromItem(boardPage, boardPage.view.marked.x, boardPage.view.marked.y) : Qt.point(0, 0)
    }
    Corner {
        id: corner
        x: layout.cornerX
        y: layout.cornerY
        kiosk: root.kiosk
        words: root.words
        canRepeat: root.avatar.bubble !== "" && ["practice", "game"].includes(root.kiosk.screen)
        // There is nothing to be done in a pause.
        opacity: root.kiosk.paused ? 0 : 1
        places: layout.cornerPlaces
        visible: (kiosk.inSession || kiosk.screen === "attract") && root.replay === null
    }
    // How far the visit is.
    Progress {
        id: steps
        steps: root.kiosk.steps
        step: root.kiosk.step
        // Not below a line of another number of parts.
        visible: corner.visible && root.kiosk.step >= 0 && !(formPage.page?.lined ?? false)
        opacity: corner.opacity
        x: layout.stepsX
        y: layout.stepsY
    }
    Feast {
        id: feast
        // Who is already asked something is not to be rained on.
        visible: ["game", "result"].includes(root.kiosk.screen)
        anchors { left: parent.left; right: parent.right; top: parent.top }
        height: root.room
    }
    Overlays {
        anchors.fill: parent
        kiosk: root.kiosk
        attract: root.attract
        returning: root.returning
        words: root.words
        windowLayout: layout
        needed: root.needsParts
        prepares: root.prepares
        timed: root.replay === null
    }
    PanelLayer {
        // Over the assistant too, who comes forward for a question.
        z: 2
        anchors.fill: parent
        experimenter: root.experimenter
        holdsRight: layout.cornerAtLeft
    }
    // A person who points at something does not work by keyboard. It lies over everything to know, and takes nothing.
    Item {
        z: 2
        anchors.fill: parent
        PointHandler { onActiveChanged: if (active) Theme.byKeyboard = false }
    }
    ReplayFoot {
        id: foot
        y: root.room
        width: root.width
        replay: root.replay
        memory: root.replayMemory
        words: root.words
    }
}
