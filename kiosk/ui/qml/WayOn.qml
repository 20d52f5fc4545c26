// The way on at the bottom right of a page, another one beside it where there are two, and at the left the way back,
// where there is one.
import QtQuick
import Recollect
import "."

FocusScope {
    id: ways

    required property KioskScreen kiosk
    required property var words
    // What the way on says; with no words there is none but the page's own buttons.
    property string label: ""
    property bool quiet: false
    property bool waits: false
    // Why it waits, for those who cannot see it.
    property string reason: ""
    // The same in short, within it on an upright page.
    property string note: ""
    // Whether the ways on take what the way back leaves of the width, with gaps as wide between all of them.
    property bool fills: false
    // What the other way on says, such as a no; and what the two are called.
    property string other: ""
    // Whether both are alike: as large, and with the same look, so that the page favours neither.
    property bool even: false
    // What follows from each, in smaller letters below its words.
    property string follows: ""
    property string otherFollows: ""
    // What the first of these lines says later, if it changes: letters that fit both keep their size.
    property string later: ""
    // How many boxes are to be ticked before the first of them, and how many of these are: drawn before its line.
    property int boxes: 0
    property int ticked: 0
    readonly property var lines: [follows, otherFollows, later]
    readonly property bool lined: follows !== "" && otherFollows !== ""
    // The same letters for both, as large as leaves each in one line.
    readonly property real lineRoom: (halved ? half : level ? share : pile) - 2.2 * Theme.gap
    readonly property real lineSize: {
        const most = Theme.size(32)
        return Math.max(24 * Theme.unit, Math.min(most, most * 0.97 * lineRoom / Math.max(1, ...lines.map(text => widths.plain(text, most)))))
    }
    // On how many lines they stand where even small ones are too long for that.
    readonly property int lineCount: Math.max(...lines.map(text => widths.plainLines(text, lineSize, lineRoom)))
    property string name: "continue"
    property string otherName: ""
    // Two that are alike stand beside each other with the largest letters that leave each in one line on a wide page, and in
    // two on an upright one. Words that are too long for that have two lines on a wide page as well.
    readonly property var tried: fills ? [[Theme.onWays, 2], [Theme.onBack, 2]] : [[Theme.onWays, 1], [Theme.onBack, 1], [(10 + 24 * Theme.textSize) * Theme.unit, 1], [Theme.onBack, 2]]
    readonly property var abreast: even && goes && refuses ? tried.find(([size, most]) => fitBeside(size, most)) : undefined
    readonly property real letters: !even || !refuses ? Theme.onWays : abreast?.[0] ?? (fills ? Theme.onWays : Theme.body)
    // What is beside the words of two that are alike.
    readonly property real padding: 48 * Theme.unit
    // How high a way on is with its words in one line.
    readonly property real tall: Math.max(112 * Theme.unit, 52 * Theme.unit + 1.36 * Theme.body)
    readonly property alias button: go
    // How much room there is between the way back and the way on.
    readonly property real freeRoom: beside ? width - go.width - (returns ? back.width : 0) : 0
    // Which of the three there are. Whether they are seen depends on the page as well.
    readonly property bool goes: label !== ""
    readonly property bool refuses: other !== ""
    readonly property bool returns: kiosk.goesBack
    // How wide the way back is, where there is one.
    readonly property alias backWish: back.wish
    signal went()
    signal turnedDown()

    readonly property real wish: (goes ? go.wish : 0) + (refuses ? no.wish + Theme.gap : 0)
        + (returns ? back.wish + Theme.gap : 0)
    // Two equal ones share the width of an upright page. The way back then stands below them, where other pages have it.
    readonly property bool halved: fills && abreast !== undefined
    readonly property real half: Math.floor((width - 32 * Theme.unit) / 2)
    // On a wide page they stand beside the way back, and well apart from it.
    readonly property bool level: !fills && abreast !== undefined
    // Where their words are too long for that, one stands above the other.
    readonly property bool beside: even && goes && refuses ? level : wish <= width
    readonly property real share: abreast?.[1] === 2 ? spread(letters) : lined ? Math.min(spread(letters), Math.max(510 * Theme.unit, named))
        : Math.max(go.least, named)
    // How wide the words of either need them.
    readonly property real named: Math.ceil(Math.max(widths.bold(label, letters), widths.bold(other, letters))) + 2 + 2 * padding
    readonly property real each: halved ? half : spread(letters)
    // Large texts set both one above the other on a wide page as well, and there too they are as wide as each other.
    readonly property bool stacked: even && !fills && !beside && goes && refuses
    readonly property real pile: Math.min(width - (returns ? back.width + Theme.gap : 0), Math.max(go.wish, no.wish))
    readonly property real step: Math.round((halved ? (Theme.textSize <= 1 ? 1.9 : 1.2) : fills && Theme.textSize <= 1.15 ? 1.1 : 0.5) * Theme.gap)
    // How far they reach above their place.
    readonly property real over: Math.max(0, -go.y)
    // As high without a way on, so that the way back stands at the same place.
    readonly property real tallest: level ? (lined ? tall : Math.round(go.implicitHeight)) : !goes && !returns ? 0 : Math.max(goes ? go.height : Math.round(go.implicitHeight), returns ? back.height : 0)

    // Where there are too many for one row: whether the way back stands beside the way on, and leaves the other one as much
    // width if both are alike.
    readonly property bool paired: refuses && !halved && back.wish + Theme.gap + Math.max(go.wish, even && fills ? no.wish : 0) <= width
    readonly property real rest: paired && returns ? width - back.width - Theme.gap : width
    readonly property real second: refuses && !beside && !halved ? no.height + step : 0
    // How far the way back stands above the lower edge beside a way on of one line.
    readonly property real lower: halved ? (tall - back.height) / 2 : 0

    height: beside ? tallest : (goes ? go.height : 0) + second + (returns && !paired ? back.height + step + lower : 0)

    // How wide each of two equal ones can be beside the way back on a wide page, with letters of this size.
    function spread(size: real): real {
        const returning = returns ? Math.ceil(widths.bold(words["control-back"], Math.min(size, Theme.onBack))) + 2 + 2 * back.leftPadding + 2 * Theme.gap : 0
        return Math.floor((width - returning - Theme.gap) / 2)
    }
    // Whether two equal ones have room beside each other, in so many lines at most.
    function fitBeside(size: real, most: int): bool {
        const room = (fills ? half : spread(size)) - 2 * padding
        return [label, other].every(text => (most === 1 ? widths.bold(text, size) + 2 <= room : widths.lines(text, size, room) <= most) && text.split(" ").every(word => widths.bold(word, size) <= room))
    }

    // The next visitor begins at the way on, whichever button the last one used.
    onVisibleChanged: go.focus = true

    WordWidths {
        id: widths
    }
    // What is beside the words of one of them there: two lines are about as long as each other.
    function aside(text: string): real {
        const words = text.split(" "), room = each - 2 * padding
        if (widths.bold(text, letters) <= room)
            return padding
        const longer = words.map((_, at) => Math.max(widths.bold(words.slice(0, at).join(" "), letters), widths.bold(words.slice(at).join(" "), letters)))
        return Math.max(padding, (each - 1.02 * Math.min(...longer)) / 2 - 2)
    }

    BigButton {
        id: go
        letters: ways.letters
        least: 320 * Theme.unit
        tall: ways.tall
        horizontalPadding: ways.abreast ? ways.aside(words) : ways.even ? ways.padding : 56 * Theme.unit
        objectName: ways.name
        visible: ways.goes
        most: ways.width
        width: ways.level ? ways.share : ways.halved ? ways.half : ways.stacked ? ways.pile
             : !ways.fills || ways.beside && ways.refuses ? Math.min(wish, most)
             : ways.beside && ways.returns ? ways.width - back.width - Theme.gap : ways.rest
        x: Theme.across(ways.width - width, width, ways.width)
        // Where the other one has two lines, both grow up and down, and the row stays where it is.
        y: ways.level ? (ways.tallest - height) / 2 : ways.second
        // Whole pixels: two that are alike are as high as each other.
        height: Math.round(ways.even && ways.refuses ? Math.max(implicitHeight, no.implicitHeight) : implicitHeight)
        corner: ways.abreast ? no.topPadding + no.font.pixelSize : Infinity
        quiet: ways.quiet
        under: ways.lined ? ways.follows : ""
        underSize: ways.lineSize
        underLines: ways.lineCount
        boxes: ways.boxes
        ticked: ways.ticked
        verticalPadding: ways.lined ? no.verticalPadding : (tall - Math.ceil(line)) / 2
        waits: ways.waits
        note: ways.note
        Accessible.description: ways.reason
        words: ways.label
        focus: true
        onClicked: ways.went()
    }
    BigButton {
        id: no
        letters: ways.even ? ways.letters : Theme.onBack
        tall: ways.tall
        objectName: ways.otherName
        visible: ways.refuses
        most: ways.width
        width: ways.level ? ways.share : ways.halved ? ways.half : ways.stacked ? ways.pile
             : !ways.fills || !ways.returns && !ways.even ? Math.min(wish, most)
             : ways.beside ? ways.width - go.width - back.width - 2 * Theme.gap : ways.even ? ways.rest : ways.width
        x: Theme.across(ways.halved ? 0 : ways.width - width - (ways.beside ? go.width + Theme.gap : 0), width, ways.width)
        y: ways.level ? go.y : 0
        height: ways.even ? go.height : implicitHeight
        quiet: !ways.even
        under: ways.lined ? ways.otherFollows : ""
        underSize: ways.lineSize
        underLines: ways.lineCount
        Accessible.description: ways.otherFollows
        horizontalPadding: ways.abreast ? ways.aside(words) : ways.even ? ways.padding : 44 * Theme.unit
        // Two lines need less air above and below them.
        verticalPadding: ways.lined ? (ways.halved ? 16 : 9) * Theme.unit : ways.abreast && ways.aside(words) > ways.padding ? (ways.halved ? 14 : 10) * Theme.unit : (tall - Math.ceil(line)) / 2
        words: ways.other
        onClicked: ways.turnedDown()
    }
    BigButton {
        id: back
        // Not larger than the two beside it.
        letters: ways.level ? Math.min(Theme.onBack, ways.letters) : Theme.onBack
        tall: Math.max(88 * Theme.unit, 36 * Theme.unit + 1.36 * Theme.body)
        objectName: "back"
        visible: ways.returns
        most: ways.width
        x: Theme.across(0, width, ways.width)
        y: ways.beside ? (ways.tallest - height) / 2 : ways.paired ? go.y + (go.height - height) / 2 : ways.height - height - ways.lower
        quiet: true
        words: ways.words["control-back"]
        horizontalPadding: (ways.even && !ways.fills ? 28 : 40) * Theme.unit
        onClicked: ways.kiosk.goBack()
    }
}
