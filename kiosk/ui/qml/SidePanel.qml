// The assistant's place beside every screen: its face, and above it what it says.
import QtQuick
import Recollect
import "."

Item {
    id: panel

    required property AvatarScreen avatar
    // Whether it says anything here; where it does not, the face has all of the height.
    property bool speaks: true

    // Whether it is about to say something.
    property bool thinks: false
    // How much of the height the face has, where it speaks.
    property real share: 0.52
    // Whether what it says stands in the middle, below the cards; beside a page, lines begin at one edge.
    property bool centred: false
    // Whether it rests, with its eyes shut and in silence.
    property bool rests: false
    // Whether a question lies over everything: it listens then, and is neither glad nor sad.
    property bool waits: false
    // What is to be read in its bubble: while it says nothing, or where it leads, whatever it said last.
    property string aside: ""
    property bool leads: false
    // What of it says what to do.
    property string asideAdvice: ""
    // Whether that is a cheer.
    property bool cheers: false
    // Whether it is about the last pair.
    property bool triumphs: false
    // What came of a move, to be read above one of these sentences.
    property string outcome: ""
    property string outcomeOf: ""
    // Whether a card above it says everything, instead of its bubble.
    property bool hushed: false
    // Where its ears begin, in this item.
    readonly property real faceTop: face.y + 0.1 * face.height
    // Whether its bubble has room for large words.
    property bool grows: false
    // Whether it says goodbye.
    property bool parts: false
    // How far its bubble may reach out of it, at the top.
    property real lift: 0
    // How far above its lower edge something begins that the face looks over; 0 where there is nothing.
    property real edge: 0
    // How much of the face's height is behind that: all below the eyes.
    readonly property real hidden: 0.42
    // Whether it speaks to those who pass.
    property bool calls: false
    // Whether it is out of sight.
    readonly property bool gone: face.gone === 1
    readonly property real faceMiddle: face.y + 0.56 * face.height
    // A sentence that was read long ago, and is not shown any more.
    property string stale: ""

    // What a hint marks, in this item: the face looks there and points at it.
    property bool marks: false
    property point marked
    // Whether something else moves that needs every frame; the face then does not breathe.
    property bool quiet: false
    // Where the visitor's pointer was last seen, in the window and in this item.
    property var seen: null
    property point pointer
    // What the visitor has just touched, in this item; for a moment the face looks there.
    property point noticed
    readonly property bool looks: marks || notices || follows
    readonly property point lookedAt: marks ? marked : notices ? noticed : pointer
    readonly property bool follows: following.running
    readonly property bool notices: attention.running

    // How much height is free above the bubble.
    readonly property alias free: bubble.free

    // Whether a sentence is to be read.
    readonly property string said: speaks && !rests && avatar.bubble !== stale ? avatar.bubble : ""
    readonly property bool says: said !== ""

    // Takes away what stands in the bubble; the next sentence is shown again.
    function fade() {
        stale = avatar.bubble
    }
    function notice(place: point) {
        noticed = place
        attention.restart()
    }
    // The next visitor must not meet a face that still looks where the last one touched.
    function stopNoticing() {
        attention.stop()
        following.stop()
    }
    // Where it first appears, and where it is pressed or let go, the pointer has not been moved.
    function follow(place: point) {
        const moved = seen !== null && (seen.x !== place.x || seen.y !== place.y)
        seen = Qt.point(place.x, place.y)
        if (!moved)
            return
        pointer = mapFromItem(null, place.x, place.y)
        following.restart()
    }
    function towards(place: real, middle: real): real {
        return Math.max(-1, Math.min(1, (place - middle) / (500 * Theme.unit)))
    }

    // How wide the face is in a place of this size.
    function faceWidth(wide: real, tall: real, share: real): real {
        return Math.min(wide - 40 * Theme.unit, tall * share * 400 / 440)
    }

    PauseAnimation { id: attention; duration: 1200 }
    PauseAnimation { id: following; duration: 2500 }
    Connections {
        target: panel.avatar
        function onSaid() {
            if (panel.avatar.bubble !== panel.stale)
                panel.stale = ""
        }
        function onGestured(name) {
            if (name === "wave")
                face.wave()
            else
                face.nod()
        }
    }

    Bubble {
        id: bubble
        // Not from edge to edge: the difference of two edges that have moved and come back lacks the last bit.
        width: parent.width
        anchors { top: parent.top; topMargin: -panel.lift; bottom: panel.avatar.present ? face.top : parent.bottom; bottomMargin: !panel.avatar.present ? 4 * Theme.unit : panel.leads && face.mood === "listening" ? -0.04 * face.height : -0.14 * face.height }
        sentence: panel.rests || panel.hushed ? "" : panel.said === "" || (panel.leads && panel.aside !== "") ? panel.aside : panel.said
        thinks: panel.speaks && !panel.rests && !panel.hushed && panel.thinks && sentence === ""
        hasSpeaker: panel.avatar.present
        speaker: panel.avatar.name
        calls: panel.calls
        grows: panel.grows
        parts: panel.parts
        centred: panel.centred
        advice: sentence === panel.said ? panel.avatar.advice : panel.asideAdvice
        outcome: panel.outcome
        outcomeOf: panel.outcomeOf
        cheers: panel.cheers && sentence === panel.aside
        triumphs: cheers && panel.triumphs
    }
    Avatar {
        id: face
        objectName: "face"
        // How far it has gone out of sight, through the lower edge.
        property real gone: panel.avatar.away ? 1 : 0
        Behavior on gone { NumberAnimation { duration: 3 * Theme.motion; easing.type: Easing.InOutQuad } }
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: (panel.edge > 0 ? panel.edge - panel.hidden * height : 0) - 1.05 * height * gone }
        width: panel.faceWidth(parent.width, parent.height, panel.speaks ? panel.share : 0.94)
        height: width * 440 / 400
        mood: panel.rests ? "idle" : panel.waits ? "listening" : panel.avatar.mood
        // Without motion it speaks with its mouth shut: the bubble stands there meanwhile.
        mouth: Theme.motion === 0 ? 0 : panel.avatar.mouth
        mouthShape: panel.avatar.mouthShape
        gazeX: panel.looks ? panel.towards(panel.lookedAt.x, face.x + face.width / 2) : panel.avatar.gazeX
        gazeY: panel.looks ? panel.towards(panel.lookedAt.y, face.y + face.height / 2) : panel.avatar.gazeY
        points: panel.marks
        aim: Qt.point(panel.marked.x - face.x, panel.marked.y - face.y)
        breathes: !panel.quiet
        blinking: panel.avatar.blinking || panel.rests
        motion: Theme.motion * 1.5
        visible: panel.avatar.present && gone < 1
    }
}
