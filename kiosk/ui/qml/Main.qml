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
    readonly property bool wide: width >= height
    // A robot stands outside the screen: then the board has the whole width, and what is said stands below it.
    readonly property bool whole: wide && !avatar.present
    // Beside a robot an upright screen has all of its height, but for a line of controls and the sentence above it.
    readonly property bool high: !wide && !avatar.present
    readonly property real sentence: speaks ? 260 * Math.max(1, texts) * Theme.unit : 0
    readonly property bool speaks: speaksOn(kiosk.screen)
    function speaksOn(screen: string): bool {
        return ["attract", "introduction", "practice", "game", "result", "thanks"].includes(screen)
    }
    readonly property real texts: Math.min(1.5, textSize * kiosk.textScale)
    // On a wide screen the helper stands beside every page, and says some of its lines.
    readonly property bool accompanied: wide && avatar.present
    // Whether it then stays in sight beside a question that lies over everything, as the one who asks.
    readonly property bool asking: avatar.present && !avatar.away && !kiosk.paused && !kiosk.waits && (kiosk.asksStillThere || kiosk.asks === "stop")
    // Where its face begins below such a question on an upright screen, and below the word about a pause; 0 beside them.
    readonly property real faceBelow: !wide && avatar.present && !avatar.away ? helper.y + helper.faceTop : 0
    // And where its middle is beside them on a wide screen.
    readonly property real faceBeside: accompanied && !avatar.away ? helper.y + helper.faceMiddle : 0
    // How large a page is on a wide screen. It depends on the page alone, so that one that is filled has its size already.
    function widthOn(screen: string): real {
        return whole || avatar.away && screen === "form" ? width : width * (screen === "attract" ? 0.64 : 0.715)
    }
    function heightOn(screen: string): real {
        return room - (!whole ? 0 : speaksOn(screen) ? 176 * Math.max(1, texts) * Theme.unit : corner.visible ? 84 * Theme.unit : 0)
    }
    readonly property real room: height - (replay === null ? 0 : controls.height) - memory.height

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
        value: root.wide ? Math.min(root.width / 1920, root.room / 1080)
                         : Math.min(root.width / 1080, root.room / 1920)
    }
    Binding { target: Theme; property: "upright"; value: !root.wide }
    Binding { target: Theme; property: "textSize"; value: root.texts }
    Binding { target: Theme; property: "screenKeys"; value: root.screenKeys }
    Binding { target: Theme; property: "mirrored"; value: root.kiosk.mirrored }
    Binding { target: Theme; property: "motion"; value: root.motion }
    Binding { target: Theme; property: "highContrast"; value: root.highContrast }
    Binding { target: Theme; property: "accent"; value: root.accent }
    Binding { target: Theme; property: "background"; value: root.background }

    // A page is made when it is first shown, or before that while nothing else happens; then it stays.
    component Page: Loader {
        id: page
        required property string name
        readonly property bool shown: root.kiosk.screen === name
        // What of it the helper says.
        readonly property string aside: (item as PageFrame)?.aside ?? ""
        // A page that is not seen keeps its size until it is filled: laying out all their texts anew holds up the others.
        readonly property bool follows: shown || status !== Loader.Ready || root.wide && root.kiosk.coming === name
        Binding on width { when: page.follows; value: root.wide ? root.widthOn(page.name) : stage.width; restoreMode: Binding.RestoreNone }
        Binding on height { when: page.follows; value: root.wide ? root.heightOn(page.name) : stage.height; restoreMode: Binding.RestoreNone }
        asynchronous: !shown
        visible: shown && status === Loader.Ready
        focus: visible && root.kiosk.bare
        active: root.prepares
        onShownChanged: if (shown) active = true
    }
    // The same for what a session needs at any time: where nothing is made between frames, it comes with the session.
    component Later: Loader {
        required property bool shown
        readonly property bool wanted: shown || root.preparesParts || root.kiosk.inSession
        asynchronous: root.prepares && !shown
        visible: shown && status === Loader.Ready
        active: false
        onWantedChanged: if (wanted) active = true
    }
    Item {
        id: stage
        x: root.wide && root.boardOnRight ? root.width - width : 0
        y: root.wide || !boardPage.visible ? 0
         : Math.round(root.high ? Math.max(0, (free - height) / 2)
                      : 0.015 * root.room)
        readonly property real free: root.room - corner.height - Theme.gap - root.sentence
        LayoutMirroring.enabled: Theme.mirrored
        LayoutMirroring.childrenInherit: true
        // A form without an onlooker stands in the middle.
        readonly property point middle: Qt.point(x + (boardPage.visible ? boardPage.view.middle : width / 2), root.room / 2)
        readonly property bool unwatched: root.avatar.away && root.kiosk.screen === "form"
        width: root.wide ? root.widthOn(root.kiosk.screen) : root.width
        // On an upright screen the assistant stands below: with its sentence, alone, or not at all. It makes room for
        // large texts, but on a form, where the keys of a number stand in its place.
        height: root.wide ? root.heightOn(root.kiosk.screen)
              : root.high ? (boardPage.visible ? Math.min(free, boardPage.view.wish) : free)
              : unwatched ? root.room - corner.height - Theme.gap : root.room * upright
        // Board and assistant stand close together: the board takes what its cards need, at least half of the screen.
        readonly property real upright: !root.speaks ? (root.texts > 1.15 && root.kiosk.screen !== "form" ? 0.84 : 0.78)
              : attractView.visible ? (root.texts > 1.3 ? 0.76 : Math.max(helper.says ? 0.57 : 0.64, 0.57 + 0.25 * (root.texts - 1)))
              // Its boards keep their distance to the buttons.
              : root.kiosk.screen === "introduction" && root.texts <= 1.15 ? 0.66
              : root.kiosk.screen === "result" && root.texts <= 1.15 ? 0.67
              : !boardPage.visible ? 0.64
              // The helper keeps its size from the practice to the game.
              : Math.max(root.texts <= 1 ? 0.628 : 0.62, Math.min(0.64, boardPage.view.wish / root.room))
        // A screen that has only just come takes no input: a double click belongs to the one before.
        enabled: root.kiosk.takesInput && root.kiosk.bare

        AttractView {
            id: attractView
            // Its words may stand a little lower, beside the room above the helper's ears.
            readonly property real further: !root.wide && root.avatar.present && !helper.says && root.texts <= 1.15 ? 0.045 * root.room : 0
            // As a page, it keeps its size while it is not seen.
            Binding on width { when: attractView.visible; value: root.wide ? root.widthOn("attract") : stage.width; restoreMode: Binding.RestoreNone }
            Binding on height { when: attractView.visible; value: (root.wide ? root.heightOn("attract") : stage.height) + attractView.further; restoreMode: Binding.RestoreNone }
            Binding on accompanied { when: attractView.visible; value: root.accompanied; restoreMode: Binding.RestoreNone }
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
                accompanied: root.accompanied
                focus: true
                about: root.about
                returning: root.returning
                kiosk: root.kiosk
                words: root.words
            }
        }
        Page {
            id: consentPage
            name: "consent"
            sourceComponent: ConsentView {
                accompanied: root.accompanied
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
                accompanied: root.accompanied
                focus: true
                age: root.age
                kiosk: root.kiosk
                words: root.words
            }
        }
        // Keys of a number stand beside this page, and what stands beside a loader is not touched: it is as large as the
        // window.
        Later {
            id: formPage
            shown: root.kiosk.screen === "form"
            property bool keysBeside: false
            property bool lined: false
            x: -stage.x
            y: -stage.y
            width: root.width
            height: root.height
            focus: visible && root.kiosk.bare
            sourceComponent: Item {
                // While the helper is rated it shows its back: on a wide page over the edge of the first card, where the
                // title's line has room for it, and on an upright one beside the controls.
                AvatarBack {
                    id: turnedAway
                    objectName: "turned-away"
                    readonly property real line: stage.x + formView.bare.x
                    readonly property real from: root.wide ? line : steps.visible ? steps.x + steps.width : Theme.gap
                    readonly property real to: root.wide ? Math.min(line + formView.bare.width, steps.x) : corner.x
                    // Whether there is room for its words before it, and how much they take.
                    readonly property real needs: whyTurned.width + 0.5 * Theme.gap
                    readonly property bool tells: whyTurned.height <= height && to - from >= width + needs + 2 * Theme.gap
                    readonly property real least: from + Theme.gap + (tells && !Theme.mirrored ? needs : 0)
                    readonly property real most: to - Theme.gap - width - (tells && Theme.mirrored ? needs : 0)
                    // At one place beside titles of any length, unless they are too long for that.
                    readonly property real wished: root.wide ? (Theme.mirrored ? from + 2.8 * Theme.gap : to - 2.8 * Theme.gap - width)
                        : !tells ? (from + to - width) / 2 : Theme.mirrored ? from + Theme.gap : least
                    height: (root.wide ? 122 : 110) * Theme.unit
                    x: Math.round(Math.max(least, Math.min(most, wished)))
                    y: Math.round((root.wide ? stage.y + formView.bare.height : root.room) - height)
                    visible: root.avatar.present && helper.gone && formView.still && to - from >= width + 2 * Theme.gap
                        && (root.wide ? y > 0 : formView.y + formView.foot + formView.way.height < y)
                }
                // Measured apart: words whose width depends on their own implicit one have a binding loop when the page turns.
                TextMetrics {
                    id: turnedWords
                    text: whyTurned.text
                    font: whyTurned.font
                }
                PlainText {
                    id: whyTurned
                    objectName: "why-turned-away"
                    visible: turnedAway.visible && turnedAway.tells
                    text: root.words["form-turned"]
                    // In two lines on a wide page, beside titles of many words.
                    width: root.wide ? formView.folded([{ text }], "text", font.pixelSize) : Math.ceil(turnedWords.advanceWidth)
                    x: turnedAway.x + (Theme.mirrored ? turnedAway.width + turnedAway.needs - width : -turnedAway.needs)
                    y: root.wide ? turnedAway.y + (turnedAway.height - height) / 2 : corner.y + (corner.height - height) / 2
                    wrapMode: root.wide ? Text.WordWrap : Text.NoWrap
                    horizontalAlignment: Text.AlignRight
                    font.pixelSize: Theme.size(root.wide ? 28 : 30)
                    color: Theme.faintInk
                }
                FormView {
                    id: formView
                    x: stage.x
                    y: stage.y
                    readonly property bool follows: formPage.shown || formPage.status !== Loader.Ready || root.wide && root.kiosk.coming === "form"
                    Binding on width { when: formView.follows; value: root.wide ? root.widthOn("form") : stage.width; restoreMode: Binding.RestoreNone }
                    Binding on height { when: formView.follows; value: root.wide ? root.heightOn("form") : stage.height; restoreMode: Binding.RestoreNone }
                    Binding on accompanied { when: formView.follows; value: root.accompanied && !root.avatar.away; restoreMode: Binding.RestoreNone }
                    focus: true
                    aligned: root.accompanied
                    before: stage.x
                    form: root.form
                    kiosk: root.kiosk
                    words: root.words
                }
                Binding { target: formPage; property: "keysBeside"; value: formView.keysBeside }
                Binding { target: formPage; property: "lined"; value: formView.lined }
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
        Later {
            id: boardPage
            shown: root.kiosk.screen === "game" || root.kiosk.screen === "practice"
            // As a page, it keeps its size while it is not seen: its cards are many.
            readonly property bool follows: !root.wide || shown || status !== Loader.Ready || root.kiosk.coming === "game"
            Binding on width { when: boardPage.follows; value: root.wide ? root.widthOn("game") : stage.width; restoreMode: Binding.RestoreNone }
            Binding on height { when: boardPage.follows; value: root.wide ? root.heightOn("game") : stage.height; restoreMode: Binding.RestoreNone }
            focus: visible && root.kiosk.bare
            readonly property BoardView view: item as BoardView
            sourceComponent: BoardView {
                id: boardView
                focus: true
                board: root.board
                words: root.words
                cardBack: root.cardBack
                cardShadow: root.cardShadow
                onTouchedSomething: helper.notice(helper.mapFromItem(boardView, touched.x, touched.y))
                upright: !root.wide
                resizes: root.avatar.moves
                prepares: root.prepares
                said: helper.says
                lent: Math.max(0, helper.reach - Theme.gap)
                faceAt: root.wide || !root.avatar.present ? 0 : helper.y + helper.faceTop - stage.y
                told: helper.tells
                onWon: if (!root.board.practice) feast.begin()
                // How a practice goes is clear by now.
                onFirstFound: if (root.board.practice && !root.board.speaking) helper.fade()
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
            sourceComponent: DebriefView {
                accompanied: root.accompanied
                focus: true
                debrief: root.debrief
                labName: root.labName
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
    Later {
        anchors.fill: parent
        shown: root.kiosk.paused || root.kiosk.screen === "pause"
        sourceComponent: CalmCard {
            // Beside the assistant, or above it.
            middle: root.whole || !helper.visible ? Qt.point(root.width / 2, root.room / 2)
                  : root.wide ? stage.middle : Qt.point(root.width / 2, 0.36 * root.room)
            speaker: root.faceBelow
            beside: root.faceBeside
            atLeft: root.boardOnRight
            bound: root.boardOnRight ? helper.x + helper.width : helper.x
            least: (roomy ? 480 : large ? 740 : 500) * Theme.unit
            // As the two questions that come at any time.
            broadest: 1214 * Theme.unit
            veil: speaker > 0 || beside > 0 ? 1 : 0.94
            cardBack: root.cardBack
            cardShadow: root.cardShadow
            title: root.words["pause-title"]
            titleSize: Theme.size(roomy ? 88 : 84)
            line: root.kiosk.pauseLine
            lineFirst: root.kiosk.pauseEnds
            lineSize: Theme.size(roomy ? 54 : 50)
        }
    }
    SidePanel {
        id: helper
        // The keys of a number stand in its place.
        z: root.asking ? 1 : root.kiosk.screen === "form" && !root.kiosk.paused ? -1 : 0
        readonly property bool below: !root.wide || root.whole
        x: below ? (root.width - width) / 2 : root.boardOnRight ? Theme.gap : stage.width
        // A whole number: edges that move by fractions do not come back to the last bit.
        readonly property real above: !below && corner.visible ? Math.ceil(corner.height + 0.7 * Theme.gap) : 0
        // On an upright screen a long sentence may reach up to the cards, where an announcement stood before it.
        readonly property real reach: boardPage.visible && !root.wide && root.avatar.present && root.texts <= 1 ? 80 * Theme.unit : 0
        y: below ? stage.y + stage.height - reach : above
        // Beside a robot on a wide screen, what is said ends before the controls.
        // An upright screen's bubble has the edges of its pages, and of the cards.
        width: !below ? root.width - stage.width - Theme.gap : broad ? root.width - (boardPage.visible ? 2 * boardPage.view.edge : 4 * Theme.gap)
             : Math.min(0.76 * root.width, root.width - 2 * (3 * corner.step + 1.7 * Theme.gap))
        height: root.high ? root.sentence : below ? root.room - y : root.room - above
        visible: !root.whole || root.speaks
        avatar: root.avatar
        speaks: root.wide || root.speaks
        thinks: boardPage.visible && root.board.speaking
        rests: root.kiosk.paused
        waits: root.kiosk.asks !== "" || root.kiosk.asksStillThere
        // Large sentences need the room.
        share: root.wide ? (attractView.visible ? 0.6 : 0.52) : root.texts <= 1.15 ? (boardPage.visible ? (root.texts <= 1 ? 0.77 : 0.68) : attractView.visible ? (says ? 0.88 : 0.98) : root.kiosk.screen === "introduction" ? 0.68 : root.kiosk.screen === "result" ? 0.755 : 0.72) : 0.64
        broad: !root.wide
        calls: root.accompanied && attractView.visible
        grows: reach > 0
        lift: boardPage.visible && !root.wide && root.avatar.present ? Math.max(0, y - stage.y - boardPage.view.foot) : 0
        leads: root.asking || !root.speaks
        hushed: root.asking
        readonly property bool done: boardPage.visible && boardPage.view.last.length > 0 && !root.board.practice
        // How a move goes on, and that it made a pair, is said in the practice; in the game a line under the cards says it.
        readonly property bool practises: boardPage.visible && root.board.practice
        readonly property bool second: practises && root.board.oneUp && root.board.open && !boardPage.view.marks
        readonly property bool missed: practises && root.board.missed
        readonly property bool glad: practises && boardPage.view.latest.length > 0 && !root.board.speaking
        readonly property bool tells: (second || missed) && aside !== "" && !says
        readonly property string turn: second ? root.words["practice-second"] : missed ? root.words["practice-turning-back"] : glad ? root.words["practice-pair"] : done ? root.words["game-found"]
            : boardPage.visible && root.board.untouched && root.board.open ? root.words["game-begin"] : ""
        outcome: root.words["practice-no-pair"]
        outcomeOf: root.words["practice-turning-back"]
        cheers: aside !== "" && aside === turn && (glad || done) && !second && !missed
        aside: !root.avatar.present || root.whole || root.kiosk.asks !== "" || root.kiosk.asksStillThere ? "" : !root.wide ? turn : attractView.visible ? root.attract.line
             : formPage.visible ? (root.avatar.away || formPage.keysBeside ? "" : root.words["form-calm"])
             : boardPage.visible ? turn
             : [aboutPage, agePage, consentPage, debriefPage].find(page => page.shown)?.aside ?? ""
        quiet: boardPage.visible && boardPage.view.moves
        marks: boardPage.visible && boardPage.view.marks
        marked: boardPage.visible ? helper.mapFromItem(boardPage, boardPage.view.marked.x, boardPage.view.marked.y) : Qt.point(0, 0)
    }
    // Above the assistant; beside a robot and on an upright screen at the bottom, where a sentence leaves room.
    Corner {
        id: corner
        // The title of a page without an onlooker begins at the left.
        readonly property bool atLeft: root.wide && !root.whole && root.boardOnRight && !stage.unwatched
        kiosk: root.kiosk
        words: root.words
        canRepeat: root.avatar.bubble !== "" && ["practice", "game"].includes(root.kiosk.screen)
        // There is nothing to be done in a pause.
        opacity: root.kiosk.paused ? 0 : 1
        places: !root.wide ? (stage.unwatched || root.high ? 5 : 1) : root.whole && root.speaks ? 3 : 5
        visible: (kiosk.inSession || kiosk.screen === "attract") && root.replay === null
        // Where the game speaks, there is always a place for the button that comes and goes.
        readonly property bool keeps: root.speaks && root.kiosk.inSession
        x: atLeft ? Theme.gap + (keeps ? fullWidth - width : 0) : root.width - width - 0.7 * Theme.gap
        // In a column it is the uppermost one.
        y: root.wide && !root.whole ? 0.7 * Theme.gap : root.room - (keeps && places > 1 ? fullHeight : height) - 0.5 * Theme.gap
    }
    // How far the visit is; quiet, beside the controls or in the other corner.
    Progress {
        id: steps
        steps: root.kiosk.steps
        step: root.kiosk.step
        // Not below a line of another number of parts.
        visible: corner.visible && root.kiosk.step >= 0 && !(formPage.visible && formPage.lined)
        opacity: corner.opacity
        readonly property bool aside: root.wide && !root.whole
        // Beside the place of the button that comes and goes, so that they stay where they are, and clear of it and of what ends a title.
        x: !aside ? Theme.gap : corner.atLeft ? 2.5 * Theme.gap + corner.fullWidth : corner.x + corner.width - corner.fullWidth - 1.5 * Theme.gap - width
        y: aside ? corner.y + (corner.step - corner.spacing - height) / 2 : root.room - height - Theme.gap
    }
    Feast {
        id: feast
        // Who is already asked something is not to be rained on.
        visible: ["game", "result"].includes(root.kiosk.screen)
        anchors { left: parent.left; right: parent.right; top: parent.top }
        height: root.room
    }
    Later {
        anchors.fill: parent
        shown: root.kiosk.asksStillThere
        focus: visible
        enabled: root.kiosk.takesInput
        sourceComponent: CalmCard {
            focus: true
            sign: "M1.5 12 C6 3.5 18 3.5 22.5 12 C18 20.5 6 20.5 1.5 12 Z M12 8.5 A3.5 3.5 0 0 1 12 15.5 A3.5 3.5 0 0 1 12 8.5"
            title: root.words["still-there-title"]
            least: roomy ? Math.min(1180 * Theme.unit, 0.83 * speaker) : speaker > 0 && boardPage.visible ? 730 * Theme.unit : 0
            bound: root.boardOnRight ? helper.x + helper.width : helper.x
            broadest: 1214 * Theme.unit
            veil: root.asking ? 1 : 0.94
            titleSize: roomy ? Theme.size(88) : beside > 0 && Theme.textSize <= 1 ? Theme.size(76) : Theme.figure
            middle: root.asking && root.wide ? stage.middle : Qt.point(root.width / 2, root.room / 2)
            speaker: root.faceBelow
            beside: root.faceBeside
            atLeft: root.boardOnRight
            line: root.words["still-there-line"]
            lineSize: Theme.size(roomy ? 42 : large ? 40 : 36)
            // A replay has a time of its own.
            lasts: root.replay === null ? root.kiosk.answerMs : 0
            second: root.words["still-there-second"]
            choices: [{ name: "still-here", words: root.words["still-there-yes"] }]
            onChosen: root.kiosk.confirm()
        }
    }
    Later {
        anchors.fill: parent
        shown: root.kiosk.asks === "stop" && !root.kiosk.paused && !root.kiosk.waits
        focus: visible
        enabled: root.kiosk.takesInput
        sourceComponent: CalmCard {
            focus: true
            middle: root.asking && root.wide ? stage.middle : Qt.point(root.width / 2, root.room / 2)
            bound: root.boardOnRight ? helper.x + helper.width : helper.x
            broadest: 1214 * Theme.unit
            veil: root.asking ? 1 : 0.94
            least: (roomy ? 1130 : speaker > 0 && boardPage.visible ? 900 : 0) * Theme.unit
            speaker: root.faceBelow
            beside: root.faceBeside
            atLeft: root.boardOnRight
            // A door, and the way out of it.
            sign: "M13 4 H5 V20 H13 M10 12 H20 M16 8 L20 12 L16 16"
            title: root.words["stop-title"]
            line: root.kiosk.stopLine
            titleSize: roomy ? Theme.size(80) : Theme.figure
            lineSize: roomy ? Theme.size(44) : large ? Theme.size(36) : Theme.body
            code: root.kiosk.stopCode
            choices: [{ name: "stop-no", words: root.words["stop-no"] }, { name: "stop-yes", words: root.words["stop-yes"], quiet: true }]
            onChosen: name => name === "stop-yes" ? root.kiosk.stop() : root.kiosk.ask("")
            Keys.onEscapePressed: root.kiosk.ask("")
        }
    }
    Later {
        anchors.fill: parent
        shown: root.kiosk.asks === "language" && !root.kiosk.paused && !root.kiosk.waits
        focus: visible
        enabled: root.kiosk.takesInput
        sourceComponent: CalmCard {
            focus: true
            sign: "M12 3 A9 9 0 0 1 12 21 A9 9 0 0 1 12 3 M3.5 9.5 H20.5 M3.5 14.5 H20.5 M12 3 C7.5 8 7.5 16 12 21 M12 3 C16.5 8 16.5 16 12 21"
            title: root.words["control-language"]
            choices: root.attract.ways.filter(way => root.kiosk.languages.includes(way.language))
                .map(way => ({ name: `language-${way.language}`, words: way.name, quiet: way.language !== root.kiosk.language }))
            onChosen: name => root.kiosk.selectLanguage(name.slice("language-".length))
            Keys.onEscapePressed: root.kiosk.ask("")
        }
    }
    Loader {
        anchors.fill: parent
        active: root.kiosk.asks === "code"
        visible: active && !root.kiosk.paused && !root.kiosk.waits
        focus: visible
        enabled: root.kiosk.takesInput
        sourceComponent: CodeCard {
            focus: true
            returning: root.returning
            words: root.words
            onWentAway: {
                root.kiosk.ask("")
                root.returning.clear()
            }
        }
    }
    Later {
        anchors.fill: parent
        shown: ["welcome", "unknown"].includes(root.kiosk.asks) && !root.kiosk.paused && !root.kiosk.waits
        focus: visible
        enabled: root.kiosk.takesInput
        sourceComponent: CalmCard {
            focus: true
            title: root.words[root.kiosk.asks === "unknown" ? "return-as-new" : "return-welcome"]
            choices: [{ name: "return-on", words: root.words["about-continue"] }]
            onChosen: root.kiosk.ask("")
            Keys.onEscapePressed: root.kiosk.ask("")
        }
    }
    Later {
        anchors.fill: parent
        shown: root.kiosk.waits && root.kiosk.screen !== "pause"
        sourceComponent: CalmCard {
            objectName: "wait"
            sign: "M6 4 H18 M6 20 H18 M7 4 C7 9 12 10 12 12 C12 14 7 15 7 20 M17 4 C17 9 12 10 12 12 C12 14 17 15 17 20"
            title: root.words["wait-title"]
            line: root.words["wait-line"]
        }
    }
    PanelLayer {
        // Over the assistant too, who comes forward for a question.
        z: 2
        anchors.fill: parent
        experimenter: root.experimenter
        holdsRight: corner.atLeft
    }
    // A person who points at something does not work by keyboard. It lies over everything to know, and takes nothing.
    Item {
        z: 2
        anchors.fill: parent
        PointHandler { onActiveChanged: if (active) Theme.byKeyboard = false }
    }
    Loader {
        id: memory
        // Not by anchors: pictures are also taken before the window's content has its size.
        y: root.room
        width: root.width
        height: root.replayMemory === null ? 0 : 176
        active: root.replayMemory !== null
        sourceComponent: Rectangle {
            color: Theme.ink
            MemoryDrawing {
                anchors.fill: parent
                replay: root.replayMemory
            }
        }
    }
    Loader {
        id: controls
        anchors { left: parent.left; right: parent.right; bottom: parent.bottom }
        height: root.replay === null ? 0 : 48
        active: root.replay !== null
        sourceComponent: ReplayBar { replay: root.replay; words: root.words }
    }
}
