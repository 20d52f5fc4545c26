// What the assistant says, to be read: as long as the sentence stands, so does the bubble.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: bubble

    required property string sentence
    required property bool hasSpeaker   // whether there is a face below it to point at
    property bool thinks: false         // whether it is still looking for words
    property bool calls: false          // whether it is to be read from far away
    property bool grows: false          // whether it has room for large words
    property bool cheers: false         // whether the sentence is a cheer: large, bold and in the middle
    property string outcome: ""         // what stands above one sentence, as large as a cheer
    property string outcomeOf: ""       // which sentence that is
    property string advice: ""          // the end of the sentence that says what to do, on a line of its own
    property string speaker: ""         // whose words they are; empty where no speaker has a name

    // Between the bubble and the face; without a face only the edge of the window has to be kept clear of.
    readonly property real tail: (hasSpeaker ? 34 : 12) * Theme.unit
    readonly property bool tells: outcome !== "" && whole === outcomeOf
    readonly property real cheer: Theme.size(grows ? 64 : 52)
    // How much larger the part that is set apart is: it is looked for while a card is sought.
    readonly property real louder: 1.2
    // A few words in a wide bubble are large, too.
    readonly property bool short: grows && !calls && !cheered && !tells && end === "" && whole !== "" && briefly.advanceWidth <= words.width
    readonly property real tag: speaker === "" ? 0 : name.height - 0.3 * Theme.gap
    // How much of its height is free above it.
    readonly property real free: sentence === "" ? height : box.y
    readonly property real room: height - tail - tag - told.high - (hasSpeaker && !tells ? 3 : 2) * Theme.gap

    LayoutMirroring.enabled: Theme.mirrored
    LayoutMirroring.childrenInherit: true
    opacity: sentence === "" && !thinks ? 0 : 1
    Behavior on opacity { NumberAnimation { duration: Theme.motion } }

    // The last sentence stays in the bubble while it fades, and no longer. A cheer stays one.
    property bool cheered: false
    onCheersChanged: if (sentence !== "") cheered = cheers
    onSentenceChanged: {
        if (sentence === "")
            return
        cheered = cheers
        show()
    }
    onAdviceChanged: if (sentence !== "") show()
    onThinksChanged: if (thinks) show()
    onOpacityChanged: if (opacity === 0) whole = end = ""

    // What stands in it, and which part of that is set apart.
    property string whole: ""
    property string end: ""
    function show() {
        end = sentence.endsWith(advice) ? advice : ""
        whole = sentence
    }

    // Both parts as large as they are usually.
    component Measure: Text {
        readonly property real high: text === "" ? 0 : height
        visible: false
        width: words.width
        textFormat: Text.PlainText
        lineHeight: words.lineHeight
        wrapMode: Text.Wrap
    }
    Measure {
        id: usual
        text: words.text
        font.pixelSize: bubble.cheered ? bubble.cheer : bubble.short ? briefly.font.pixelSize : Theme.size(bubble.calls ? 50 : bubble.grows ? (large.high + largeEnd.high <= bubble.room - ending.apart ? 38 : 34) : 36)
        font.bold: bubble.cheered
    }
    Measure {
        id: usualEnd
        text: ending.text
        font { pixelSize: Math.round(bubble.louder * usual.font.pixelSize); bold: true }
    }
    TextMetrics {
        id: briefly
        text: bubble.whole
        font.pixelSize: Theme.size(52)
    }
    // The same in large words, where there is room for them.
    Measure {
        id: large
        text: bubble.grows ? words.text : ""
        font.pixelSize: Theme.size(38)
    }
    Measure {
        id: largeEnd
        text: bubble.grows ? ending.text : ""
        font { pixelSize: Math.round(bubble.louder * Theme.size(38)); bold: true }
    }
    Rectangle {
        id: box
        anchors { left: parent.left; right: parent.right; bottom: parent.bottom; bottomMargin: bubble.tail }
        height: words.high + ending.high + bubble.tag + told.high + 2 * Theme.gap
        radius: Theme.radius
        color: Theme.white
        border.color: Theme.sea
        border.width: 4 * Theme.unit

        PlainText {
            id: told
            readonly property real high: visible ? height : 0
            visible: bubble.tells
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: Theme.gap; topMargin: Theme.gap + bubble.tag }
            text: visible ? bubble.outcome : ""
            font { pixelSize: bubble.cheer; bold: true }
            color: Theme.sea
            horizontalAlignment: Text.AlignHCenter
            wrapMode: Text.Wrap
            Accessible.role: Accessible.AlertMessage
        }
        Balanced {
            id: words
            readonly property real high: text === "" && bubble.end !== "" ? 0 : height
            text: bubble.end === "" ? bubble.whole : bubble.whole.slice(0, -bubble.end.length).trim()
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: Theme.gap; topMargin: Theme.gap + bubble.tag + told.high }
            // What would not fit above the face is set smaller: half the size takes a quarter of the room.
            font.pixelSize: {
                const share = Math.max(0, (bubble.room - ending.apart) / Math.max(1, usual.high + usualEnd.high))
                return share >= 1 ? usual.font.pixelSize : Math.max(Theme.size(0), Math.floor(usual.font.pixelSize * Math.max(share, 0.95 * Math.sqrt(share))))
            }
            font.bold: bubble.cheered
            color: bubble.cheered ? Theme.sea : Theme.ink
            horizontalAlignment: bubble.cheered || bubble.tells || bubble.short ? Text.AlignHCenter : LayoutMirroring.enabled ? Text.AlignLeft : undefined
            lineHeight: 1.12
            // Said once, as a whole.
            Accessible.role: Accessible.AlertMessage
            Accessible.name: bubble.whole
        }
        // Where to look, found at a glance.
        Balanced {
            id: ending
            readonly property real apart: text !== "" && words.text !== "" ? 0.4 * Theme.gap : 0
            readonly property real high: text === "" ? 0 : height + apart
            visible: text !== ""
            anchors { left: words.left; right: words.right; top: words.top; topMargin: words.high + apart }
            // A number stays with the word before it.
            text: bubble.end.replace(/ (?=\d)/g, "\u00a0")
            font { pixelSize: Math.round(bubble.louder * words.font.pixelSize); bold: true }
            color: Theme.sea
            horizontalAlignment: words.horizontalAlignment
            lineHeight: words.lineHeight
            Accessible.ignored: true
        }
        // Words are on their way.
        Row {
            anchors { left: words.left; verticalCenter: words.verticalCenter }
            visible: bubble.whole === ""
            spacing: 10 * Theme.unit
            Repeater {
                model: 3
                Rectangle {
                    id: dot
                    required property int index
                    width: 14 * Theme.unit
                    height: width
                    radius: width / 2
                    color: Theme.sea
                    SequentialAnimation on opacity {
                        running: bubble.thinks && Theme.motion > 0
                        loops: Animation.Infinite
                        PauseAnimation { duration: dot.index * Theme.motion / 2 }
                        NumberAnimation { from: 1; to: 0.3; duration: Theme.motion }
                        NumberAnimation { from: 0.3; to: 1; duration: Theme.motion }
                        PauseAnimation { duration: (2 - dot.index) * Theme.motion / 2 }
                    }
                }
            }
        }
        PlainText {
            id: name
            anchors { left: parent.left; top: parent.top; leftMargin: Theme.gap; topMargin: 0.6 * Theme.gap }
            visible: bubble.speaker !== ""
            text: bubble.speaker
            font { pixelSize: Theme.small; bold: true }
            color: Theme.sea
        }
    }
    SpeechTail {
        visible: bubble.hasSpeaker
        anchors { top: box.bottom; topMargin: -5 * Theme.unit; horizontalCenter: parent.horizontalCenter }
    }
}
