// The end: a hand of cards, a word of thanks, and a way out for those who do not want to wait.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property ThanksScreen thanks
    required property AttractScreen attract
    required property KioskScreen kiosk
    required property var words
    required property url cardBack
    required property url cardShadow

    readonly property int count: Math.min(5, attract.pictures.length)
    // What the words and the button leave, with room for the cards' slant.
    readonly property real slot: Math.max(0, Math.min(230 * Theme.unit, (width - 4 * Theme.gap) / (0.75 * count + 0.8),
        (height - title.height - line.height - go.height - 8 * Theme.gap) / 1.35))
    // The hand opens as the screen comes.
    property real open: visible ? 1 : 0
    Behavior on open { enabled: view.visible; NumberAnimation { duration: 3 * Theme.motion; easing.type: Easing.OutBack } }

    Column {
        anchors.centerIn: parent
        spacing: 1.2 * Theme.gap

        Item {
            anchors.horizontalCenter: parent.horizontalCenter
            visible: view.slot >= 60 * Theme.unit
            width: (0.75 * (view.count - 1) + 1) * view.slot
            height: 1.3 * view.slot
            Repeater {
                model: view.count
                CardFace {
                    required property int index
                    readonly property real place: index - (view.count - 1) / 2
                    x: (parent?.width ?? 0) / 2 - width / 2 + place * 0.75 * view.slot * view.open
                    y: 0.05 * view.slot + 0.04 * view.slot * place * place * view.open
                    width: Math.floor(view.slot)
                    height: width
                    rotation: 7 * place * view.open
                    back: view.cardBack
                    shadow: view.cardShadow
                    picture: view.attract.pictures[index] ?? ""
                    up: true
                }
            }
        }
        Line {
            id: title
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.words["thanks-title"]
            font { pixelSize: Theme.size(92); bold: true }
        }
        Line {
            id: line
            anchors.horizontalCenter: parent.horizontalCenter
            room: Math.min(1100 * Theme.unit, view.width - 4 * Theme.gap)
            bottomPadding: 0.6 * Theme.gap
            text: view.words["thanks-line"]
            font.pixelSize: Theme.heading
            color: Theme.faintInk
        }
        WayOn {
            id: go
            anchors.horizontalCenter: parent.horizontalCenter
            width: Math.min(1100 * Theme.unit, view.width - 4 * Theme.gap)
            kiosk: view.kiosk
            words: view.words
            centred: true
            label: view.words["thanks-continue"]
            focus: true
            onWent: view.thanks.proceed()
        }
    }
}
