// The end: a word of thanks, and a hand of the pictures that the visitor found.
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
    readonly property int count: Math.min(5, pictures.length)
    // None covers another: what makes an animal may be at its edge.
    readonly property real overlap: 1.1
    // In two rows where they are larger so.
    readonly property int lines: count > 3 && (width < height || free / 2.7 > column / (overlap * (count - 1) + 1.25)) ? 2 : 1
    readonly property real free: room - parting.height - parting.space
    readonly property int first: Math.ceil(count / lines)
    // With room for the cards' slant.
    readonly property real slot: Math.max(0, Math.min(300 * Theme.unit, column / (overlap * (first - 1) + 1.25),
        free / (lines > 1 ? (width > height ? 2.7 : 2.5) : 1.5)))
    readonly property real spread: (lines > 1 ? 2.35 : 1.3) * slot
    // The hand opens as the screen comes.
    property real open: visible ? 1 : 0
    Behavior on open { enabled: view.visible; NumberAnimation { duration: 3 * Theme.motion; easing.type: Easing.OutBack } }

    label: words["thanks-continue"]
    onWent: thanks.proceed()
    onVisibleChanged: way.focus = true

    // Large and in the middle, above the hand.
    PlainText {
        id: parting
        objectName: "page-title"
        readonly property real space: 2.5 * Theme.gap
        y: Math.max(0, (view.room - height - space - view.spread) / 2.4)
        width: parent?.width ?? 0
        text: view.words["thanks-title"]
        horizontalAlignment: Text.AlignHCenter
        font { pixelSize: Theme.size(90); bold: true }
        wrapMode: Text.Wrap
    }
    Item {
        anchors.horizontalCenter: parent?.horizontalCenter
        y: parting.y + parting.height + parting.space
        visible: view.slot >= 60 * Theme.unit
        width: (view.overlap * (view.first - 1) + 1) * view.slot
        height: view.spread
        Repeater {
            model: view.count
            CardFace {
                required property int index
                readonly property bool below: index >= view.first
                readonly property real place: below ? index - view.first - (view.count - view.first - 1) / 2 : index - (view.first - 1) / 2
                x: (parent?.width ?? 0) / 2 - width / 2 + place * view.overlap * view.slot * view.open
                y: 0.05 * view.slot + 0.04 * view.slot * place * place * view.open + (below ? 1.16 * view.slot : 0)
                width: Math.floor(view.slot)
                height: width
                rotation: 5 * place * view.open
                back: view.cardBack
                shadow: view.cardShadow
                picture: view.pictures[index] ?? ""
                up: true
            }
        }
    }
}
