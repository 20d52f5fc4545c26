// What the game is about: three small boards that play it, one after another, while the assistant says the same.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property IntroductionScreen introduction
    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow

    readonly property int boards: introduction.helped ? 3 : 2
    readonly property bool abreast: width > height
    // Whether pictures in another size are loaded beside other things.
    property bool prepares: false
    // Where the story is, in beats; without motion every board shows its end.
    property int beat: 0
    readonly property bool still: Theme.motion === 0

    title: words["introduction-title"]
    label: words["introduction-continue"]
    onWent: introduction.proceed()
    onVisibleChanged: {
        beat = 0
        way.focus = true
    }
    SequentialAnimation {
        loops: Animation.Infinite
        running: view.visible && !view.still
        PauseAnimation { duration: 1100 }
        ScriptAction { script: view.beat = (view.beat + 1) % 16 }
    }

    // Boards side by side have two cards in a row, so that they fill the page; on a low page, or below each other, three.
    readonly property int across: abreast && room > 560 * Theme.unit ? 2 : 3
    readonly property int down: 6 / across

    // Where a rule has two lines, the first is a heading; each is as large as leaves all rules three lines at most.
    readonly property var rules: ["introduction-turn", "introduction-match", "introduction-help"].slice(0, boards).map(rule => words[rule])
    readonly property bool plain: Theme.textSize > 1.15
    readonly property var letters: plain ? abreast ? [29, 29] : [32, 32]
        : (abreast ? [[40, 38], [38, 36], [37, 35], [36, 34], [35, 33], [34, 32]] : [[46, 42], [44, 40], [42, 38], [40, 36]]).find(sizes => rules.every(rule => lines(rule, sizes) <= 3)) ?? [34, 32]
    readonly property real captionWidth: abreast ? (column - (boards - 1) * Theme.gap) / boards - 40 * Theme.unit : scenes.beside
    WordWidths { id: widths }
    function lines(rule: string, sizes: var): int {
        const at = rule.indexOf("\n"), lead = at < 0 ? rule : rule.slice(0, at), rest = at < 0 ? "" : rule.slice(at + 1)
        return widths.lines(lead, Theme.size(sizes[0]), captionWidth) + (rest === "" ? 0 : widths.plainLines(rest, Theme.size(sizes[1]), captionWidth))
    }

    // Six cards, some of them up or marked, above a sentence or beside it.
    component Scene: Rectangle {
        id: scene
        required property string text
        required property list<int> pictures
        required property list<int> up
        property bool found: false
        property int markRow: -1
        property int markColumn: -1
        // Whether an arrow of a mark may stand above it.
        property bool marked: false
        // Whether it is this board's turn.
        required property bool plays

        readonly property real most: Math.floor(Math.min((width - 2 * numbers - 0.5 * Theme.gap) / view.across,
                (view.room - telling.height - numbers - 0.6 * Theme.gap - pad - floor) / view.down))
        readonly property real cell: view.abreast ? scenes.cell : scenes.small
        // Room for the arrow of a mark, above the cards, clear of the edge.
        readonly property real numbers: scenes.numbers
        readonly property real pad: scenes.pad
        // Below the words, as much as above the cards that have no arrow.
        readonly property real floor: 1.7 * Theme.gap

        width: view.abreast ? (view.column - (view.boards - 1) * Theme.gap) / view.boards : view.column
        height: view.abreast ? scenes.tallest : Math.max(board.height + numbers, telling.height) + 2 * pad
        radius: Theme.radius
        color: Theme.white
        border { color: plays && !view.still ? Theme.sea : Theme.edge; width: 3 * Theme.unit }

        Item {
            id: board
            x: view.abreast ? (scene.width - width) / 2 : Theme.across(scenes.edge, width, scene.width)
            y: view.abreast ? scene.pad + scene.numbers : (scene.height - height + (scene.marked ? scene.numbers : 0)) / 2
            width: view.across * scene.cell
            height: view.down * scene.cell
            Mark {
                anchors.fill: parent
                row: scene.markRow
                column: scene.markColumn
                cell: scene.cell
            }
            Repeater {
                model: 6
                Item {
                    id: place
                    required property int index
                    readonly property bool open: scene.up.includes(index)
                    x: index % view.across * scene.cell
                    y: Math.floor(index / view.across) * scene.cell
                    width: scene.cell
                    height: scene.cell
                    Rectangle {
                        visible: scene.found && place.open
                        anchors.centerIn: parent
                        width: face.width + 10 * Theme.unit
                        height: width
                        radius: width * 0.13
                        color: Theme.leaf
                    }
                    CardFace {
                        id: face
                        anchors.centerIn: parent
                        width: Math.floor(scene.cell * (view.abreast ? 0.84 : 0.9))
                        height: width
                        back: view.cardBack
                        shadow: view.cardShadow
                        picture: view.attract.pictures[scene.pictures[place.index] % view.attract.pictures.length] ?? ""
                        up: place.open
                        rimmed: 3 * Theme.unit
                        rimShown: scene.found ? 0 : 1
                        prepares: view.prepares
                    }
                }
            }
        }
        Column {
            id: telling
            // The part before a line's end, and the part after it.
            readonly property int end: scene.text.includes("\n") ? scene.text.indexOf("\n") : scene.text.length
            x: view.abreast ? (scene.width - width) / 2 : Theme.across(scenes.edge + board.width + scenes.apart, width, scene.width)
            y: view.abreast ? board.y + board.height + 0.6 * Theme.gap : (scene.height - height) / 2
            width: view.captionWidth
            Balanced {
                width: parent.width
                text: scene.text.slice(0, telling.end)
                font { pixelSize: Theme.size(view.letters[0]); bold: true }
                horizontalAlignment: view.abreast ? Text.AlignHCenter : Text.AlignLeft
            }
            Balanced {
                width: parent.width
                visible: text !== ""
                text: scene.text.slice(telling.end + 1)
                least: 0.7
                font.pixelSize: Theme.size(view.letters[1])
                horizontalAlignment: view.abreast ? Text.AlignHCenter : Text.AlignLeft
            }
        }
        readonly property real wish: board.y + board.height + 0.6 * Theme.gap + telling.height + floor
    }

    Grid {
        id: scenes
        y: view.sink(height)
        readonly property real cell: Math.min(turn.most, match.most, view.introduction.helped ? hint.most : Infinity)
        readonly property real tallest: Math.max(turn.wish, match.wish, view.introduction.helped ? hint.wish : 0)
        // Beside a sentence by the width alone, and above one by what is left of the height: no size follows from itself.
        readonly property real small: Math.floor(Math.min((view.column - numbers - 3 * Theme.gap) / 5.6, 190 * Theme.unit,
            ((view.room - (view.plain ? 0 : 0.8) * Theme.gap - (view.boards - 1) * Theme.gap) / view.boards - 2 * pad - numbers) / 2))
        // How far the cards are from a board's edges, and from an arrow's place. Below each other they are high enough.
        readonly property real numbers: (view.abreast ? 34 : 31) * Theme.unit
        readonly property real pad: (view.abreast ? 0.95 : 0.83) * Theme.gap
        readonly property real edge: 0.95 * Theme.gap + numbers
        // Between cards and words beside them: about as much as before the cards, but where large words need the width.
        readonly property real apart: (view.plain ? 1.2 : 2) * Theme.gap
        readonly property real beside: view.column - edge - 3 * small - apart - 0.95 * Theme.gap
        columns: view.abreast ? 3 : 1
        spacing: Theme.gap
        // Two that differ: turned one after the other, and turned back.
        Scene {
            id: turn
            text: view.words["introduction-turn"]
            pictures: [0, 1, 2, 3, 0, 1]
            plays: view.beat < 5
            up: view.still ? [0, 5] : view.beat === 1 ? [0] : view.beat === 2 || view.beat === 3 ? [0, 5] : []
        }
        // Two alike: they stay.
        Scene {
            id: match
            text: view.words["introduction-match"]
            // Not below each other, where their frames would touch.
            readonly property int partner: view.across === 2 ? 4 : 5
            pictures: view.across === 2 ? [1, 2, 3, 0, 2, 3] : [1, 2, 3, 0, 3, 2]
            plays: view.beat >= 5 && view.beat < 9
            found: view.still || view.beat >= 7
            up: view.still || view.beat >= 7 ? [1, partner] : view.beat === 6 ? [1] : []
        }
        // What a hint marks: a column, a row, a card.
        Scene {
            id: hint
            visible: view.introduction.helped
            marked: view.introduction.points
            text: view.words["introduction-help"]
            // The partner of the card that is up, in another row and column than that.
            readonly property int partner: view.across === 2 ? 3 : 2
            pictures: view.across === 2 ? [3, 0, 2, 4, 4, 1] : [3, 0, 4, 2, 4, 1]
            plays: view.beat >= 9
            markColumn: view.introduction.points && (view.still || view.beat === 10 || view.beat === 11 || view.beat === 14) ? partner % view.across : -1
            markRow: view.introduction.points && !view.still && (view.beat === 12 || view.beat === 13 || view.beat === 14) ? Math.floor(partner / view.across) : -1
            up: view.still || view.beat === 9 || view.beat > 9 && view.beat < 15 ? [4] : view.beat === 15 ? [4, partner] : []
            found: view.beat === 15
        }
    }
}
