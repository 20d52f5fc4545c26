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
    property bool centred: false        // whether its lines and the speaker's name stand in the middle
    property bool parts: false          // whether it is a goodbye, as large as fits
    property bool cheers: false         // whether the sentence is a cheer: large and bold
    property bool triumphs: false       // whether that is about the last pair: as large as fits
    property string outcome: ""         // what stands above one sentence, as large as a cheer
    property string outcomeOf: ""       // which sentence that is
    property string advice: ""          // the end of the sentence that says what to do: read first, above the rest
    property string speaker: ""         // whose words they are; empty where no speaker has a name

    // Between the bubble and the face; without a face only the edge of the window has to be kept clear of.
    readonly property real tail: (hasSpeaker ? 34 : 12) * Theme.unit
    readonly property bool tells: outcome !== "" && whole === outcomeOf
    readonly property real cheer: Theme.size(grows ? 64 : 52)
    // In one line, or where that would be no larger than another cheer, in as many as it has words.
    readonly property real triumph: {
        const most = wide => Math.floor(highest.font.pixelSize * Math.min(1, 0.98 * words.width / Math.max(1, wide)))
        const line = most(highest.advanceWidth(whole))
        return line >= cheer ? line : Math.max(line, most(Math.max(...whole.split(" ").map(word => highest.advanceWidth(word)))))
    }
    // What to do is looked for while a card is sought: it is larger than the rest, and in a wide bubble as large as a
    // few words, where it fits into one line.
    readonly property real basis: Theme.size(grows ? 36 : 34)
    readonly property real louder: grows && heading.advanceWidth <= words.width ? heading.font.pixelSize / basis : 1.3
    // A few words in a wide bubble are large, too.
    readonly property bool short: grows && !calls && !cheered && !tells && end === "" && whole !== "" && briefly.advanceWidth <= words.width
    readonly property real tag: speaker === "" ? 0 : name.height - 0.3 * Theme.gap
    // What calls stands in one line or two even ones, in as large letters as fit, and its bubble is only as wide as that:
    // it keeps away from the edge of the window.
    readonly property var called: calls ? call(whole, Math.min(width, 560 * Theme.unit * Theme.textSize) - 2 * Theme.gap) : null
    function call(text: string, room: real): var {
        const parts = text.split(" ")
        const found = [64, 60, 56, 53, 50].map(letters => {
            const size = Theme.size(letters), wide = parts => 1.015 * wordWidths.plain(parts.join(" "), size) + 2
            const line = wide(parts)
            return {size: size, wide: line <= room ? line
                : Math.min(...parts.map((_, at) => Math.max(wide(parts.slice(0, at)), wide(parts.slice(at)))))}
        }).find(tried => tried.wide <= room)
        return found ?? {size: Theme.size(50), wide: room}
    }
    // A goodbye stands in one line, or has a line for each of its sentences, in as large letters as fit.
    readonly property var farewell: parts && end === "" ? part(whole, 0.98 * words.width) : null
    function part(text: string, room: real): var {
        const lines = text.replace(/([.!?…。！？]) /g, "$1\n").split("\n")
        const fits = (texts, size) => texts.every(each => wordWidths.plain(each, size) <= room)
        const size = [48, 44, 40, 36].map(Theme.size).find(size => fits(lines, size))
        return size === undefined || fits([text], size) ? {size: size ?? Theme.size(36), text} : {size, text: lines.join("\n")}
    }
    WordWidths {
        id: wordWidths
    }
    // How far its words keep from its edges. Very many need all of its width, and are read from one edge.
    readonly property bool many: plain.advanceWidth > 3 * (width - 120 * Theme.unit)
    readonly property real inset: grows && !many ? 60 * Theme.unit : Theme.gap
    readonly property bool few: short || cheered || tells || (end !== "" && end === whole)
    readonly property real pad: (grows && few && !triumphed ? 34 : 24) * Theme.unit
    // How much of its height is free above it.
    readonly property real free: sentence === "" ? height : box.y
    readonly property real room: height - tail - tag - told.high - (hasSpeaker && !tells ? 1 : 0) * Theme.gap - 2 * pad

    LayoutMirroring.enabled: Theme.mirrored
    LayoutMirroring.childrenInherit: true
    opacity: sentence === "" && !thinks ? 0 : 1
    Behavior on opacity { NumberAnimation { duration: Theme.motion } }

    // The last sentence stays in the bubble while it fades, and no longer. A cheer stays one.
    property bool cheered: false
    property bool triumphed: false
    onCheersChanged: if (sentence !== "") rejoice()
    onTriumphsChanged: if (sentence !== "") rejoice()
    function rejoice() {
        cheered = cheers
        triumphed = triumphs
    }
    onSentenceChanged: {
        if (sentence === "")
            return
        rejoice()
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

    // Keeps together what is looked for: a number and the word before it, and the short words before these where they
    // fit into a line. Of several sentences, each begins a line if not all fit into one. What is measured depends on the
    // font, which is named for that reason alone.
    readonly property string numbered: end.replace(/ (?=\d)/g, "\u00a0")
    readonly property string kept: keep(numbered, words.width, letters.font)
    function keep(numbered: string, room: real, _font: font): string {
        if (letters.advanceWidth(numbered) <= room)
            return numbered
        const lines = numbered.replace(/([.!?]) /g, "$1\n")
        const short = /(^|[ \n\u00a0])([^\s\d]{1,3}) (?=(?:[^\s\d]{1,3}\s)?[^\s\d]+\u00a0\d)/g
        const bound = lines.replace(short, "$1$2\u00a0").replace(short, "$1$2\u00a0")
        return bound.split(/[ \n]/).every(part => letters.advanceWidth(part) <= room) ? bound : lines
    }

    // Both parts as large as they are usually, and how much of their height there is room for.
    readonly property real share: Math.max(0, (room - ending.apart) / Math.max(1, usual.high + usualEnd.high))
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
        font.pixelSize: bubble.triumphed ? bubble.triumph : bubble.cheered ? bubble.cheer : bubble.short ? briefly.font.pixelSize : bubble.end !== "" ? bubble.basis
            : bubble.called !== null ? bubble.called.size : bubble.farewell !== null ? bubble.farewell.size : Theme.size(bubble.grows ? (large.high <= bubble.room ? 38 : 34) : 36)
        font.bold: bubble.cheered
    }
    Measure {
        id: usualEnd
        text: bubble.kept
        font: letters.font
    }
    FontMetrics {
        id: letters
        font { pixelSize: Math.round(bubble.louder * bubble.basis); bold: true }
    }
    TextMetrics {
        id: plain
        text: bubble.whole
        font.pixelSize: bubble.basis
    }
    TextMetrics {
        id: heading
        text: bubble.end
        font { pixelSize: Theme.size(52); bold: true }
    }
    FontMetrics {
        id: highest
        font { pixelSize: Theme.size(80); bold: true }
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
    Rectangle {
        id: box
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: bubble.tail }
        width: bubble.called === null ? bubble.width : bubble.called.wide + 2 * Theme.gap
        height: words.high + ending.high + bubble.tag + told.high + 2 * bubble.pad
        radius: Theme.radius
        color: Theme.white
        border.color: Theme.sea
        border.width: 4 * Theme.unit

        PlainText {
            id: told
            readonly property real high: visible ? height : 0
            visible: bubble.tells
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: bubble.inset; topMargin: bubble.pad + bubble.tag }
            text: visible ? bubble.outcome : ""
            font { pixelSize: bubble.cheer; bold: true }
            color: Theme.sea
            horizontalAlignment: words.horizontalAlignment
            wrapMode: Text.Wrap
            Accessible.role: Accessible.AlertMessage
        }
        // Where to look or what to do, found at a glance. It is said last, and stands first.
        Balanced {
            id: ending
            readonly property real apart: bubble.end !== "" && words.text !== "" ? 0.4 * Theme.gap : 0
            readonly property real high: text === "" ? 0 : height + apart
            visible: text !== ""
            least: 0.75
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: bubble.inset; topMargin: bubble.pad + bubble.tag + told.high }
            text: bubble.share < 1 ? bubble.numbered : bubble.kept
            font { pixelSize: Math.round(bubble.louder * words.font.pixelSize); bold: true }
            color: Theme.sea
            horizontalAlignment: words.horizontalAlignment
            lineHeight: words.lineHeight
            Accessible.ignored: true
        }
        Balanced {
            id: words
            readonly property real high: text === "" && bubble.end !== "" ? 0 : height
            text: bubble.farewell !== null ? bubble.farewell.text : bubble.end === "" ? bubble.whole : bubble.whole.slice(0, -bubble.end.length).trim()
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: bubble.inset; topMargin: bubble.pad + bubble.tag + told.high + ending.high }
            // What would not fit above the face is set smaller: half the size takes a quarter of the room.
            font.pixelSize: bubble.share >= 1 ? usual.font.pixelSize
                : Math.max(Theme.size(0), Math.floor(usual.font.pixelSize * Math.max(bubble.share, 0.95 * Math.sqrt(bubble.share))))
            font.bold: bubble.cheered
            color: bubble.cheered ? Theme.sea : Theme.ink
            horizontalAlignment: bubble.centred && !bubble.many ? Text.AlignHCenter : LayoutMirroring.enabled ? Text.AlignLeft : undefined
            lineHeight: 1.12
            // Said once, as a whole, in the order in which it is spoken.
            Accessible.role: Accessible.AlertMessage
            Accessible.name: bubble.whole
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
            anchors { left: parent.left; right: parent.right; top: parent.top; margins: bubble.inset; topMargin: 0.6 * bubble.pad }
            horizontalAlignment: words.horizontalAlignment
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
