// A card at its place on the board: it turns, shakes its head at a tap that does not count, and shows that it is found.
import QtQuick
import QtQuick.Shapes
import Recollect
import "."

Item {
    id: place

    required property BoardScreen board
    required property BoardLayout boardLayout
    required property BoardState boardState
    required property url cardBack
    required property url cardShadow
    // The size that its picture is drawn for, and whether it is loaded in the time between frames.
    required property real drawn
    required property bool prepares
    // Whether it is the one that a key would turn over.
    required property bool current
    // What the board tells of this card.
    required property int index
    required property url picture
    required property bool up
    required property bool found
    required property string label

    readonly property int row: Math.floor(index / boardLayout.columns)
    readonly property int column: index % boardLayout.columns
    readonly property bool marked: (boardState.markRow === row || boardState.markRow < 0)
                                   && (boardState.markColumn === column || boardState.markColumn < 0)
                                   && boardState.markRow + boardState.markColumn > -2
    // A tap would change nothing: two cards are open, a sentence is said, or this one is up.
    readonly property bool refuses: !boardState.open || up
    readonly property bool missed: up && !found && boardState.missed
    // How far a found card has come forward, and how far it has come to rest for good.
    property real forward: 0
    property bool settles: false
    property real rest: found && (settles || !coming.running) ? 1 : 0
    // How far the joy about the last pair lifts it; the wave is over one diagonal after another.
    readonly property real cheer: boardState.wave === 0 || boardState.wave === 1 ? 0
        : Math.max(0, 1 - Math.abs(boardState.wave * (boardLayout.rows + boardLayout.columns + 1) - row - column - 1) / 1.6)
    Behavior on rest { NumberAnimation { duration: Theme.motion } }
    // The last pair stays forward, larger than its neighbours, in a frame of light. The others step back from it: their
    // frames get thin, and their pictures large.
    readonly property bool closes: boardState.last.includes(index)
    // It laps no neighbour; side by side, the two share the line between them.
    readonly property real largest: boardLayout.within(boardLayout.cell - 12 * Theme.unit, 1.08)
    property real proud: closes && (settles || !coming.running) ? 1 : 0
    // A pair that was just found keeps its size in its frame until the next move, or a hint: the mark alone is strong then.
    property real fresh: boardState.latest.includes(index) && !boardState.marks && (settles || !coming.running) ? 1 : 0
    Behavior on fresh { NumberAnimation { duration: Theme.motion } }
    readonly property real apart: boardState.ended * (1 - proud)
    // How large a found card is, and the frame behind it.
    readonly property real beside: boardLayout.within(boardLayout.cell - 28 * Theme.unit, 1)
    readonly property real rested: mix(mix(mix(0.88, boardLayout.within(boardLayout.framed - 2 * boardLayout.ring, 1.01), fresh), beside, apart), largest, proud)
    readonly property real frame: mix(mix(0.88 * boardLayout.card + 14 * Theme.unit, boardLayout.framed, fresh), beside * boardLayout.card + 10 * Theme.unit, apart)
    function mix(from: real, to: real, share: real): real {
        return from + (to - from) * share
    }
    Behavior on proud { NumberAnimation { duration: Theme.motion } }

    readonly property real turning: face.turn
    readonly property bool turns: turning > 0 && turning < 1
    onTurnsChanged: boardState.turning += turns ? 1 : -1

    objectName: "card-" + index
    width: boardLayout.cell
    height: boardLayout.cell
    // The view would set 0 to 1 itself. A hint's mark lies at 1.5.
    z: proud > 0 ? 4 : coming.running || fresh > 0 ? 3 : up || marked ? 2 : 1
    Accessible.role: Accessible.Button
    Accessible.name: label
    Accessible.onPressAction: board.tap(index)

    // Answers at once that it was touched: what does not count makes the card shake its head.
    function answer() {
        boardState.touched(index)
        if (!refuses)
            return
        board.refuse()
        if (Theme.motion > 0)
            refusal.restart()
    }
    onFoundChanged: {
        settles = false
        if (found && Theme.motion > 0)
            coming.restart()
    }
    // The face looks at a card that has just turned.
    onUpChanged: {
        if (!up)
            return
        boardState.latest = []
        boardState.touched(index)
    }
    onMissedChanged: if (missed && Theme.motion > 0) sigh.restart()

    // In a marked row or column an open card lies apart from those that a hint means.
    Rectangle {
        objectName: "mat-" + place.index
        visible: place.marked && place.up && !place.found
        anchors.centerIn: parent
        width: place.boardLayout.card + Math.min(16 * Theme.unit, place.boardLayout.cell - place.boardLayout.card)
        height: width
        radius: width * 0.13
        color: Theme.white
    }
    // A frame of light around the last pair.
    Rectangle {
        objectName: "last-" + place.index
        visible: place.proud > 0
        anchors.centerIn: parent
        width: (place.largest * place.boardLayout.card + 24 * Theme.unit) * (1 + 0.09 * place.cheer)
        height: width
        opacity: place.proud
        radius: width * 0.12
        color: Theme.amber
    }
    Rectangle {
        objectName: "found-" + place.index
        visible: place.rest > 0
        anchors.centerIn: parent
        // By its size: corners that are drawn larger by a scale look ragged.
        width: place.frame * (1 + 0.09 * place.cheer)
        height: width
        opacity: place.rest * (1 - place.proud)
        radius: width * 0.12
        color: Theme.leaf
    }
    Rectangle {
        visible: place.forward > 0
        anchors.centerIn: face
        width: face.width * face.scale * 1.04
        height: width
        radius: width * 0.13
        color: Theme.leaf
        opacity: place.forward
    }
    CardFace {
        id: face
        property real shift: 0
        anchors { centerIn: parent; horizontalCenterOffset: shift }
        width: Math.floor(parent.width * place.boardLayout.share)
        height: width
        back: place.cardBack
        shadow: place.cardShadow
        drawn: place.drawn
        picture: place.picture
        up: place.up
        shade: 1 - place.rest
        // A pair has its green frame instead, as soon as it has come forward.
        rimmed: 7 * Theme.unit
        rimShown: place.missed && place.turning === 1 ? 0 : !place.found ? 1 : coming.running && !place.settles ? Math.max(0, 1 - place.forward) : 0
        prepares: place.prepares
        // Closed cards step back while a tap would not count, unless they are meant.
        opacity: place.boardState.speaking && !place.up && !place.marked ? Theme.held : 1
        Behavior on opacity { NumberAnimation { duration: Theme.motion } }
        scale: (tap.pressed ? 0.95 : 1)
            * (1 + 0.07 * lift)
            * place.mix(1, place.rested, place.rest)
            * (1 + 0.16 * place.forward)
            * (1 + 0.09 * place.cheer)
    }
    // These two are no pair; in a while they close again. A line with gaps is not taken for that of a card that is chosen.
    Loader {
        objectName: "missed-" + place.index
        active: place.missed && place.turning === 1
        visible: active
        anchors { centerIn: face; horizontalCenterOffset: face.shift }
        width: 0.962 * face.width
        height: width
        scale: face.scale
        rotation: face.rotation
        sourceComponent: Shape {
            id: gaps
            ShapePath {
                fillColor: "transparent"
                strokeColor: Theme.faintInk
                strokeWidth: 8 * Theme.unit
                strokeStyle: ShapePath.DashLine
                dashPattern: [2.4, 1.8]
                capStyle: ShapePath.FlatCap
                PathRectangle { width: gaps.width; height: gaps.height; radius: 0.12 * gaps.width }
            }
        }
    }
    SequentialAnimation {
        id: coming
        PauseAnimation { duration: Theme.motion * 1.5 }
        NumberAnimation { target: place; property: "forward"; to: 1; duration: Theme.motion; easing.type: Easing.OutBack }
        PauseAnimation { duration: Theme.motion }
        // Its frame stays while it goes back.
        PropertyAction { target: place; property: "settles"; value: true }
        NumberAnimation { target: place; property: "forward"; to: 0; duration: Theme.motion; easing.type: Easing.InOutQuad }
    }
    SequentialAnimation {
        id: sigh
        PauseAnimation { duration: Theme.motion * 1.6 }
        NumberAnimation { target: face; property: "rotation"; to: -3; duration: Theme.motion; easing.type: Easing.InOutSine }
        NumberAnimation { target: face; property: "rotation"; to: 3; duration: Theme.motion; easing.type: Easing.InOutSine }
        NumberAnimation { target: face; property: "rotation"; to: 0; duration: Theme.motion; easing.type: Easing.InOutSine }
    }
    SequentialAnimation {
        id: refusal
        // Seen in the very next frame.
        PropertyAction { target: face; property: "shift"; value: place.width * 0.05 }
        NumberAnimation { target: face; property: "shift"; to: -place.width * 0.04; duration: Theme.motion > 0 ? 90 : 0; easing.type: Easing.InOutSine }
        NumberAnimation { target: face; property: "shift"; to: place.width * 0.02; duration: Theme.motion > 0 ? 80 : 0; easing.type: Easing.InOutSine }
        NumberAnimation { target: face; property: "shift"; to: 0; duration: Theme.motion > 0 ? 70 : 0; easing.type: Easing.InOutSine }
    }
    // Where nothing moves, this alone answers a tap that does not count.
    Rectangle {
        objectName: "refusal-" + place.index
        visible: tap.pressed && place.refuses
        anchors.centerIn: face
        width: face.width * face.scale + 10 * Theme.unit
        height: width
        radius: width * 0.13
        color: "transparent"
        border { color: Theme.deepAmber; width: 5 * Theme.unit }
    }
    Rectangle {
        anchors.fill: parent
        anchors.margins: parent.width * (0.97 - place.boardLayout.share) / 2
        radius: Theme.radius * 1.4
        color: "transparent"
        border { color: Theme.ink; width: 5 * Theme.unit }
        visible: place.current && Theme.byKeyboard
    }
    TapHandler {
        id: tap
        gesturePolicy: TapHandler.ReleaseWithinBounds
        // However long the press, it is a tap: in seconds, longer than any visitor has.
        longPressThreshold: 3600
        onPressedChanged: if (pressed) place.answer()
        onTapped: place.board.tap(place.index)
    }
    HoverHandler {
        cursorShape: !place.boardState.open ? Qt.WaitCursor : place.up ? Qt.ArrowCursor : Qt.PointingHandCursor
    }
}
