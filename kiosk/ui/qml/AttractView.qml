// What draws people in: a fan of cards that turn one after another, a title, and one button for each language.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow

    readonly property real cardSize: Math.min(width / 7.4, height / 6)
    readonly property bool several: attract.ways.length > 1

    // The next visitor begins as if the last one had never been: at the first language, and with no ring.
    onVisibleChanged: {
        if (visible && ways.count > 0)
            (ways.itemAt(0) as Way).focus = true
        Theme.byKeyboard = Theme.byKeyboard && !visible
    }

    component Way: FocusScope {
        id: way
        required property int index
        required property var modelData
        focus: index === 0
        width: start.width
        height: start.height + (name.visible ? name.height + 0.4 * Theme.gap : 0)
        BigButton {
            id: start
            objectName: "start-" + way.modelData.language
            most: view.width - 4 * Theme.gap
            words: way.modelData.start
            font.pixelSize: Theme.heading
            focus: true
            Accessible.description: way.modelData.name
            Keys.onLeftPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)
            Keys.onRightPressed: nextItemInFocusChain().forceActiveFocus(Qt.TabFocusReason)
            onClicked: view.attract.start(way.modelData.language)
        }
        PlainText {
            id: name
            anchors { horizontalCenter: start.horizontalCenter; top: start.bottom; topMargin: 0.4 * Theme.gap }
            visible: view.several
            text: way.modelData.name
            font.pixelSize: Theme.small
            color: Theme.faintInk
        }
    }

    Line {
        objectName: "trial"
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: 0.5 * Theme.gap }
        visible: text !== ""
        room: view.width - 2 * Theme.gap
        text: view.attract.trial
        font.pixelSize: Theme.small
        color: Theme.faintInk
    }
    Column {
        anchors.centerIn: parent
        spacing: 2 * Theme.gap

        Grid {
            anchors.horizontalCenter: parent.horizontalCenter
            columns: 6
            spacing: view.cardSize * 0.12
            Repeater {
                model: view.attract.pictures
                CardFace {
                    required property int index
                    required property string modelData
                    width: view.cardSize
                    height: view.cardSize
                    back: view.cardBack
                    shadow: view.cardShadow
                    picture: modelData
                    up: view.attract.shown === index
                }
            }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            topPadding: Theme.gap
            text: view.attract.title
            font { pixelSize: Theme.title; bold: true }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.attract.line
            font.pixelSize: Theme.body
            color: Theme.faintInk
        }
        Grid {
            id: starts
            anchors.horizontalCenter: parent.horizontalCenter
            // All in one row; or where that is too narrow, one above the other.
            readonly property real wish: {
                let sum = 0
                for (let i = 0; i < ways.count; i++)
                    sum += (ways.itemAt(i)?.width ?? 0) + columnSpacing
                return sum
            }
            columns: wish <= view.width - 2 * Theme.gap ? ways.count : 1
            columnSpacing: 1.5 * Theme.gap
            rowSpacing: 0.7 * Theme.gap
            horizontalItemAlignment: Grid.AlignHCenter
            Repeater {
                id: ways
                model: view.attract.ways
                Way {}
            }
        }
    }
}
