// The card to take home: the code to withdraw with as a picture to be scanned and in letters, or just whom to ask.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: card

    required property DebriefScreen debrief
    required property DebriefShape page
    required property PointPairs pairs
    required property DebriefSizes sizes
    // How much height the points leave it.
    required property real room

    readonly property bool coded: debrief.code !== ""
    // A visitor who is not stored has no code, and may have questions all the same.
    readonly property bool there: coded || debrief.questions !== ""
    readonly property real pad: sizes.pad
    readonly property real rim: page.rim
    readonly property real crown: sizes.crowned ? heading.height + 0.6 * Theme.gap : 0
    // As much of the height as the text leaves, so that a page that fits does not scroll.
    readonly property real side: Math.max((page.upright ? 290 : 230) * Theme.unit,
        Math.min(sizes.mostCode, room - crown - 2 * pad - 2 * rim))
    readonly property real pictureHeight: picture.height + 2 * rim

    visible: there
    height: there ? crown + Math.max(pictureHeight, told.height) + 2 * pad : 0
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.amber; width: 4 * Theme.unit }

    component Heading: Balanced {
        text: card.page.kept
        font { pixelSize: Theme.body; bold: true }
        horizontalAlignment: Text.AlignLeft
    }
    component Note: Balanced {
        width: told.width
        visible: text !== ""
        font.pixelSize: told.size
    }

    Heading {
        id: heading
        visible: card.sizes.crowned
        x: Theme.across(card.pad, width, parent.width)
        y: card.pad
        width: parent.width - 2 * card.pad
    }
    // On white even where the theme is dark: a camera needs it.
    Rectangle {
        id: picture
        objectName: "qr"
        visible: card.coded
        anchors {
            left: parent.left; leftMargin: card.pad + card.rim
            verticalCenter: parent.verticalCenter; verticalCenterOffset: card.crown / 2
        }
        width: card.page.codeSide(card.side)
        height: width
        color: "white"
        Accessible.role: Accessible.Graphic
        Accessible.name: card.debrief.scanning
        Rectangle {
            z: -1
            anchors { fill: parent; margins: -card.rim }
            radius: 3 * card.rim
            color: "white"
        }
        Image {
            anchors.fill: parent
            source: card.debrief.picture
            smooth: false
            cache: false
            Accessible.ignored: true
        }
    }
    Column {
        id: told
        // Beside a large code, as large as the points above the card, where that makes it no higher.
        readonly property bool grand: card.sizes.paired && card.coded && picture.height >= 280 * Theme.unit
            && grown <= card.pictureHeight
        readonly property real size: grand ? card.pairs.size : card.sizes.note
        readonly property real largeCode: Theme.size(92)
        // How high it is about then.
        readonly property real grown: {
            const size = card.pairs.size, room = 0.95 * width
            const lines = card.page.cardLines([card.page.kept], 1.08 * size, room) + card.page.cardLines(card.page.notes, size, room)
            return 1.37 * largeCode + 0.4 * Theme.gap + lines * card.page.lineHeight(size)
        }
        // Whether the name of the code has a line of its own, so that all of it begins at one edge: on an upright page as a
        // heading, and else small over the code, close to it.
        readonly property bool named: card.sizes.crowned || captioned
        readonly property bool captioned: grand
            && grown + 1.37 * (Theme.reading - 0.15 * largeCode) + 0.4 * Theme.gap <= card.pictureHeight
        anchors {
            left: picture.right; leftMargin: (card.coded ? 1.5 : 0.25) * Theme.gap
            right: parent.right; rightMargin: card.sizes.crowned ? card.pad : Theme.gap
            verticalCenter: parent.verticalCenter; verticalCenterOffset: card.crown / 2
        }
        spacing: (card.sizes.signed ? 0.2 : 0.3) * Theme.gap
        Heading {
            visible: !card.sizes.crowned
            width: told.width
            font.pixelSize: told.grand ? told.size : Theme.body
        }
        // The code stands below its name, and beside it where there is no height for that.
        Item {
            visible: card.coded
            width: told.width
            height: told.named ? code.y + code.height : Math.max(named.height, code.height)
            PlainText {
                id: named
                x: Theme.across(0, width, parent.width)
                y: told.captioned ? 0.4 * Theme.gap : told.named ? 0 : Math.max(0, code.height - height) / 2
                width: (told.named ? 1 : 0.45) * parent.width
                text: card.page.codeName
                font { pixelSize: told.captioned ? Theme.reading : told.size; bold: !told.captioned }
                horizontalAlignment: Text.AlignLeft
                wrapMode: Text.Wrap
                color: told.captioned ? Theme.faintInk : Theme.ink
            }
            PlainText {
                id: code
                objectName: "code"
                readonly property real from: told.named ? 0 : named.contentWidth + Theme.gap
                x: Theme.across(from, width, parent.width)
                y: told.named ? named.y + named.height : 0
                width: parent.width - from
                // Its letters have much air above them.
                topPadding: told.captioned ? -0.18 * told.largeCode : 0
                text: card.debrief.code
                horizontalAlignment: Text.AlignLeft
                font {
                    pixelSize: told.grand ? told.largeCode : Theme.size(card.sizes.signed ? 72 : 64)
                    bold: true
                    letterSpacing: 4 * Theme.unit
                }
                fontSizeMode: Text.HorizontalFit
                minimumPixelSize: Theme.body
                color: Theme.sea
            }
        }
        Note { text: card.debrief.withdrawing }
        Note {
            objectName: "returning"
            text: card.debrief.returning
        }
        Note {
            objectName: "questions"
            text: card.debrief.questions
        }
    }
}
