// The end: a word of thanks, and pictures that the visitor found: in two full rows on a wide page, and in a fan below the
// thanks on an upright one.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property ThanksScreen thanks
    required property ResultScreen result
    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow

    // Who found no pair sees some of the cards.
    readonly property list<url> pictures: result.pictures.length > 0 ? result.pictures : attract.pictures
    readonly property bool upright: width < height
    // Two rows of them, or one where there are few: as many as fill the width with pictures as large as the height allows.
    // Both are full, but the lower one of a fan.
    readonly property real largest: Math.max(1, Math.min(312 * Theme.unit, free / 2.3))
    readonly property int most: Math.max(3, Math.ceil((column / largest - 1.06) / overlap) + 1)
    readonly property int lines: pictures.length < 4 ? 1 : 2
    readonly property int first: lines === 1 ? pictures.length : upright ? Math.min(3, Math.ceil(pictures.length / 2)) : Math.min(most, Math.floor(pictures.length / 2))
    readonly property int second: lines === 1 ? 0 : upright ? Math.min(pictures.length - first, Math.max(2, first - 1)) : first
    // None covers another: what makes an animal may be at its edge.
    readonly property real overlap: 1.05
    readonly property real free: room + Theme.gap - parting.height
    // How much each card is turned more than the one before it, in degrees, and how much lower the outer ones of a row are,
    // as a share of their size.
    readonly property real tilt: upright ? 6 : 2
    readonly property real arch: upright ? 0.035 : 0.01
    // With room for the cards' slant.
    readonly property real slot: Math.max(0, Math.min(312 * Theme.unit, column / (overlap * (first - 1) + 1.06), free / (lines > 1 ? 2.3 : 1.2)))
    // The first and the last card of full rows reach the edges of the page with the outermost point of their round corners,
    // where little is missing.
    readonly property real slant: tilt * (first - 1) / 2 * Math.PI / 180
    readonly property real slanted: Math.cos(slant) + Math.sin(slant)
    readonly property real reach: 0.481 * slanted - 0.115 * (slanted - 1)
    readonly property real wish: first > 1 ? (column - 2 * reach * slot) / (first - 1) : 0
    readonly property real pitch: wish < 1.2 * overlap * slot ? wish : overlap * slot
    // Rows are as far apart as columns, where there is the height.
    readonly property real drop: Math.max(1.07 * slot, Math.min(pitch, free - 1.2 * slot))
    readonly property real spread: (lines > 1 ? drop : 0) + 1.08 * slot
    // On an upright page the thanks stand in the middle, close above the cards, and both in the middle of the height: letters
    // have air above them.
    readonly property real apart: 1.2 * Theme.gap
    readonly property real begun: upright ? Math.max(0, (free - spread - apart) / 2 - 30 * Theme.unit) : 0
    // The rows open as the screen comes.
    property real open: visible ? 1 : 0
    Behavior on open { enabled: view.visible; NumberAnimation { duration: 3 * Theme.motion; easing.type: Easing.OutBack } }

    label: words["thanks-continue"]
    onWent: thanks.proceed()
    onVisibleChanged: way.focus = true

    WordWidths {
        id: widths
    }
    // Larger than the title of another page, and on a wide page at the same place.
    PlainText {
        id: parting
        objectName: "page-title"
        y: view.begun
        width: parent?.width ?? 0
        text: view.words["thanks-title"]
        horizontalAlignment: view.upright ? Text.AlignHCenter : Text.AlignLeft
        font {
            pixelSize: view.upright && widths.bold(text, Theme.size(120)) < 0.95 * view.column ? Theme.size(120) : Theme.highTitle
            bold: true
        }
        wrapMode: Text.Wrap
    }
    Item {
        anchors.horizontalCenter: parent?.horizontalCenter
        // On a wide page in the middle between the letters of the title and the way on.
        y: parting.height + (view.upright ? view.begun + view.apart : (view.free - height) / 2)
        visible: view.slot >= 60 * Theme.unit
        width: view.pitch * (view.first - 1) + view.slot
        height: view.spread
        Repeater {
            // None is made anew where the page has room for more or fewer of them.
            model: view.pictures.length
            CardFace {
                required property int index
                visible: index < view.first + view.second
                prepares: true
                readonly property bool below: index >= view.first
                readonly property real place: below ? index - view.first - (view.second - 1) / 2 : index - (view.first - 1) / 2
                x: (parent?.width ?? 0) / 2 - width / 2 + place * view.pitch * view.open
                y: 0.02 * view.slot + view.arch * view.slot * place * place * view.open + (below ? view.drop : 0)
                width: Math.floor(view.slot)
                height: width
                rotation: (below && !view.upright ? -view.tilt : view.tilt) * place * view.open
                back: view.cardBack
                shadow: view.cardShadow
                picture: visible ? view.pictures[index] : ""
                up: true
            }
        }
    }
}
