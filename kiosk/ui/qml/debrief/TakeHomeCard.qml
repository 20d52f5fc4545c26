// The card to take home: the code to withdraw with as a picture to be scanned and in letters, or just whom to ask.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: card

    required property DebriefScreen debrief
    required property DebriefShape page
    required property DebriefSizes sizes
    required property string labName
    // How much height the points leave it.
    required property real room

    readonly property bool footed: sizes.pairs.footed
    readonly property bool coded: debrief.code !== ""
    // A visitor who is not stored has no code, and may have questions all the same. A ticket beside the page says all of it.
    readonly property bool there: (coded || debrief.questions !== "") && !sizes.pairs.ticketed
    readonly property real pad: sizes.pad
    readonly property real rim: page.rim
    // As much of the height as the text leaves, so that a page that fits does not scroll.
    readonly property real side: sizes.paired ? sizes.mostCode : Math.max(sizes.leastCode, Math.min(sizes.mostCode, room - 2 * pad - 2 * rim))
    readonly property real pictureHeight: picture.height + 2 * rim

    visible: there
    height: there ? Math.max(pictureHeight, told.height) + 2 * pad : 0
    radius: Theme.radius
    // Below two cards it is a ticket on an upright page and a quiet strip on a wide one, and beside the way on a card as
    // they are.
    readonly property bool torn: sizes.paired && page.upright && coded
    color: torn ? "white" : sizes.paired && !footed ? Theme.shelf : Theme.white
    border {
        color: torn && !Theme.highContrast ? Theme.amber : Theme.edge
        width: torn ? 4 * Theme.unit : sizes.paired && !footed && !Theme.highContrast ? 0 : 3 * Theme.unit
    }

    component Note: Balanced {
        width: told.width
        visible: text !== ""
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: card.sizes.note
    }

    TicketTear {
        visible: card.torn
        x: Theme.across(card.pad + 2 * card.rim + picture.width + 0.5 * (card.page.besideCode - card.rim), 0, card.width)
        height: card.height
        down: true
        edge: card.border.color
        edgeWidth: card.border.width
    }
    // On white even where the theme is dark: a camera needs it.
    Rectangle {
        id: picture
        objectName: "qr"
        visible: card.coded
        anchors {
            left: parent.left; leftMargin: card.pad + card.rim
            verticalCenter: parent.verticalCenter
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
        anchors {
            left: picture.right; leftMargin: card.coded ? card.page.besideCode : 0.25 * Theme.gap
            right: parent.right; rightMargin: card.footed ? card.pad : Theme.gap
            verticalCenter: parent.verticalCenter
        }
        spacing: 0.2 * Theme.gap
        Note {
            text: card.sizes.paired && card.coded ? "" : card.page.kept
            font { pixelSize: card.sizes.heading; bold: true }
        }
        // What the code is called stands small over it, close to it.
        Column {
            visible: card.coded
            PlainText {
                width: told.width
                text: card.page.codeName
                // In one line, if that makes it only a little smaller.
                font {
                    pixelSize: [1, 0.95, 0.9].map(share => share * card.sizes.caption)
                        .find(size => card.page.widths.bold(text, size) <= 0.97 * told.width) ?? card.sizes.caption
                    bold: card.sizes.paired
                }
                horizontalAlignment: Text.AlignLeft
                wrapMode: Text.Wrap
                color: card.sizes.paired ? Theme.ink : Theme.faintInk
            }
            PlainText {
                objectName: "code"
                width: told.width
                // Its letters have much air above them, and some below.
                topPadding: -(card.sizes.paired ? 0.1 : card.page.codeAir) * font.pixelSize
                bottomPadding: card.sizes.paired ? -0.15 * Theme.gap : 0
                text: card.debrief.code
                horizontalAlignment: Text.AlignLeft
                font { pixelSize: card.sizes.letters; bold: true; letterSpacing: 4 * Theme.unit }
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
        Note {
            text: card.labName
            color: Theme.faintInk
        }
    }
}
