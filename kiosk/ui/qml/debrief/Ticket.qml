// What a visitor takes home, as a ticket beside a wide page: the code to scan and in letters, and on its stub what it is
// for. The helper holds it from behind.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: ticket

    required property DebriefScreen debrief
    required property TicketShape page
    required property string labName
    // How large the helper is drawn who holds it.
    required property real helperSize

    height: content.height + 2 * page.pad

    component Line: Balanced {
        width: content.width
        visible: text !== ""
        horizontalAlignment: Text.AlignHCenter
        font.pixelSize: ticket.page.note
    }
    Rectangle {
        id: paper
        anchors.fill: parent
        radius: Theme.radius
        // White even where the theme is dark: a camera needs it around the code.
        color: "white"
        border { color: Theme.highContrast ? Theme.edge : Theme.amber; width: 4 * Theme.unit }
    }
    TicketTear {
        y: content.y + stub.y + stub.height / 2
        width: parent.width
        edge: paper.border.color
        edgeWidth: paper.border.width
    }
    Column {
        id: content
        x: ticket.page.pad
        y: ticket.page.pad
        width: ticket.width - 2 * ticket.page.pad
        spacing: ticket.page.apart
        Line {
            text: ticket.page.codeName
            font { pixelSize: ticket.page.heading; bold: true }
        }
        Item {
            id: place
            z: -1
            width: content.width
            height: ticket.page.side - ticket.page.spare(ticket.page.side)
            Rectangle {
                objectName: "qr"
                // At whole pixels, so that its squares have sharp edges.
                x: Math.round(content.x + (place.width - width) / 2) - content.x
                y: Math.round(content.y + place.y + (place.height - height) / 2) - content.y - place.y
                width: ticket.page.side
                height: width
                color: "white"
                Accessible.role: Accessible.Graphic
                Accessible.name: ticket.debrief.scanning
                Image {
                    anchors.fill: parent
                    source: ticket.debrief.picture
                    smooth: false
                    cache: false
                    Accessible.ignored: true
                }
            }
        }
        PlainText {
            objectName: "code"
            width: content.width
            text: ticket.debrief.code
            horizontalAlignment: Text.AlignHCenter
            topPadding: -0.2 * font.pixelSize
            font { pixelSize: ticket.page.letters; bold: true; letterSpacing: ticket.page.spread }
            color: Theme.sea
        }
        // Where the stub would be torn off.
        Item {
            id: stub
            width: content.width
            height: 0.6 * ticket.page.apart
        }
        Line { text: ticket.debrief.withdrawing }
        Line {
            objectName: "returning"
            text: ticket.debrief.returning
        }
        Line {
            text: ticket.labName
            color: Theme.faintInk
        }
    }
    AvatarGrip {
        width: parent.width
        size: ticket.helperSize
        inset: 52 * Theme.unit
    }
}
