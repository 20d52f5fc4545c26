// A calm word over everything: a title, a line, and perhaps something to choose.
pragma ComponentBehavior: Bound
import QtQuick
import "."

FocusScope {
    id: calm

    required property string title
    property string line: ""
    property real titleSize: Theme.figure
    property real lineSize: Theme.body
    // Whether the line is what matters most, and is then as large as a title.
    property bool lineFirst: false
    // What stands below that line; empty for none.
    property string more: ""
    // What is to be taken along, and what to do with it; empty for none.
    property string code: ""
    property string codeNote: ""
    // The lines of a drawing above the title, on a square of 24; empty for none.
    property string sign: ""
    // Where the face of the one who asks is, at which the card then stands; null where there is none.
    property WindowLayout windowLayout: null
    // Where that face begins below the card, which then is what it says; 0 where there is none.
    readonly property real speaker: windowLayout?.faceBelow ?? 0
    // Where its middle is beside the card; 0 where it is not.
    readonly property real beside: windowLayout?.faceBeside ?? 0
    readonly property bool atLeft: windowLayout?.boardOnRight ?? false
    // The edge of its place, which the card reaches.
    readonly property real bound: windowLayout?.helperEdge ?? 0
    // Where the middle of the card is at no face.
    property point middle: Qt.point(width / 2, (windowLayout?.room ?? height) / 2)
    readonly property bool large: speaker > 0 || beside > 0 && Theme.textSize <= 1.15
    // Whether there is so much height above a face that words and drawing can be larger.
    readonly property bool roomy: speaker > 0.65 * height && Theme.textSize <= 1
    readonly property real tail: speaker > 0 ? 34 * Theme.unit : 0
    // How high it is at least, and how wide where a face is beside it, or where none is.
    property real least: 0
    readonly property real broadest: 1214 * Theme.unit
    readonly property real broad: (Theme.textSize > 1.15 ? 1120 : 900) * Theme.unit
    // How much of what is below is covered; a card that covers most of it hides the remains as well.
    readonly property real veil: speaker > 0 || beside > 0 ? 1 : 0.94
    // What lies there face down instead of a drawing; empty for none.
    property url cardBack: ""
    property url cardShadow: ""
    readonly property bool lies: String(cardBack) !== ""
    WordWidths { id: widths }
    // The largest of these letters with which a title is in one line, or else the smallest.
    function largestInOneLine(title: string, sizes: var): real {
        return widths.largestInOneLine(title, sizes.map(Theme.size), 0.99 * content.width)
    }
    // Whether they lie on the page above the card, and not on it.
    readonly property bool spread: lies && roomy && card.y > 600 * Theme.unit
    // What there is to choose: the name of each, its words, and whether it is quiet. The first has the keyboard.
    property var choices: []
    signal chosen(string name)
    // How long it stays, in ms, or 0 where that is not known. The seconds that are left, with their unit, then stand below
    // the line, and there is no drawing; the last one has a word of its own.
    property int lasts: 0
    property string second: ""
    property string seconds: ""

    onVisibleChanged: if (visible) buttons.take()

    // A card that is not turned meanwhile, at its place in a row of so many.
    component Lying: Item {
        id: lying
        required property int index
        property int many: 3
        required property real slot
        readonly property real place: index - (many - 1) / 2
        width: Math.round(slot)
        height: 1.08 * width
        CardFace {
            y: 0.08 * lying.place * lying.place * width
            width: lying.width
            height: width
            rotation: 6 * lying.place
            back: calm.cardBack
            shadow: calm.cardShadow
            picture: ""
            up: false
        }
    }

    // Whatever lies below cannot be reached, and steps back.
    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        opacity: calm.veil
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }

    Column {
        anchors.horizontalCenter: parent.horizontalCenter
        // Closer to the card than to the edge.
        y: 0.68 * (card.y - height)
        visible: calm.spread
        spacing: 1.5 * Theme.gap
        Repeater {
            model: calm.spread ? [3, 2] : []
            Row {
                id: row
                required property int modelData
                anchors.horizontalCenter: parent?.horizontalCenter
                spacing: 1.5 * Theme.gap
                Repeater {
                    model: row.modelData
                    Lying {
                        many: row.modelData
                        slot: Math.min(230 * Theme.unit, 0.3 * card.y)
                    }
                }
            }
        }
    }
    Rectangle {
        id: card
        objectName: "calm-card"
        x: Math.round(calm.beside === 0 ? calm.middle.x - width / 2 : calm.atLeft ? calm.bound - 6 * Theme.unit : calm.bound + 6 * Theme.unit - width)
        y: Math.round(calm.speaker > 0 ? Math.max(2 * Theme.gap, calm.speaker - height - calm.tail - 0.5 * Theme.gap)
           : Math.max(Math.min(Theme.gap, (parent.height - height) / 2), Math.min(calm.middle.y - height / 2, parent.height - height - Theme.gap)))
        // As wide as an upright page and what the helper says below it.
        width: calm.speaker > 0 ? parent.width - 4 * Theme.gap : calm.beside > 0 ? calm.broadest : Math.min(parent.width - 4 * Theme.gap, calm.broad)
        height: Math.max(calm.least, content.height + 5 * Theme.gap)
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }
        Column {
            id: content
            anchors.centerIn: parent
            width: parent.width - 4 * Theme.gap
            spacing: (calm.roomy || calm.large && calm.beside > 0 ? (calm.code === "" || !calm.roomy ? 2 : 2.4) : calm.large && buttons.alone ? 2 : 1.5) * Theme.gap
            Rectangle {
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.sign !== "" && calm.lasts === 0
                width: (calm.roomy ? 140 : 96) * Theme.unit
                height: width
                radius: width / 2
                color: Theme.sand
                Drawing {
                    anchors.centerIn: parent
                    scale: parent.width / 43
                    path: calm.sign
                    ink: Theme.ink
                    thick: 2.2
                }
            }
            Balanced {
                width: parent.width
                text: calm.title
                font { pixelSize: calm.lineFirst ? calm.lineSize : calm.titleSize; bold: true }
                color: Theme.ink
                Accessible.role: Accessible.AlertMessage
                Accessible.name: text
                horizontalAlignment: Text.AlignHCenter
            }
            Balanced {
                width: parent.width
                visible: text !== ""
                text: calm.line
                font { pixelSize: calm.lineFirst ? calm.titleSize : calm.lineSize; bold: calm.lineFirst }
                color: calm.lineFirst ? Theme.sea : Theme.ink
                horizontalAlignment: Text.AlignHCenter
            }
            Row {
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.lies && !calm.spread
                topPadding: (calm.large ? 1 : 0.5) * Theme.gap
                bottomPadding: topPadding
                spacing: (calm.large ? 1.8 : 1.2) * Theme.gap
                Repeater {
                    model: calm.lies && !calm.spread ? 3 : 0
                    Lying { slot: (calm.large ? 240 : 120) * Theme.unit }
                }
            }
            Balanced {
                width: parent.width
                visible: text !== ""
                text: calm.more
                font { pixelSize: calm.lineSize; bold: calm.lies }
                color: Theme.ink
                horizontalAlignment: Text.AlignHCenter
            }
            Item {
                visible: calm.lasts > 0
                width: parent.width
                // With the ring around it.
                height: count.height + 28 * Theme.unit
                CalmCount {
                    id: count
                    anchors.centerIn: parent
                    width: (calm.roomy ? 320 : calm.large ? 240 : 190) * Theme.unit
                    // Smaller than the question.
                    most: 0.93 * calm.titleSize
                    lasts: calm.lasts
                    second: calm.second
                    seconds: calm.seconds
                }
            }
            // Before the answers: it is read before one of them takes it away.
            CalmCode {
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.code !== ""
                width: parent.width
                code: calm.code
                note: calm.codeNote
                aside: calm.beside > 0 && calm.large
                large: calm.large
                roomy: calm.roomy
            }
            CalmChoices {
                id: buttons
                anchors.horizontalCenter: parent.horizontalCenter
                most: content.width
                choices: calm.choices
                large: calm.large
                roomy: calm.roomy
                onChosen: name => calm.chosen(name)
            }
        }
    }
    SpeechTail {
        visible: calm.beside > 0
        rotation: calm.atLeft ? 90 : -90
        x: calm.atLeft ? card.x - 14 * Theme.unit - width / 2 : card.x + card.width + 14 * Theme.unit - width / 2
        y: Math.max(card.y + 80 * Theme.unit, Math.min(calm.beside, card.y + card.height - 80 * Theme.unit)) - height / 2
    }
    SpeechTail {
        visible: calm.tail > 0
        anchors { top: card.bottom; topMargin: -5 * Theme.unit; horizontalCenter: card.horizontalCenter }
    }
}
