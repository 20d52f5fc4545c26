// What the visitor achieved: three numbers, large.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property ResultScreen result
    required property var words

    component Figure: Column {
        id: figure
        property string value
        property string label
        readonly property real most: (view.width - 12 * Theme.gap) / 3
        width: Math.max(240 * Theme.unit, implicitWidth + 2 * Theme.gap)
        PlainText {
            anchors.horizontalCenter: parent.horizontalCenter
            text: figure.value
            font { pixelSize: Theme.figure; bold: true }
            color: Theme.sea
            Accessible.ignored: true
        }
        PlainText {
            anchors.horizontalCenter: parent.horizontalCenter
            width: Math.min(implicitWidth, figure.most)
            text: figure.label
            horizontalAlignment: Text.AlignHCenter
            wrapMode: Text.Wrap
            font.pixelSize: Theme.body
            color: Theme.faintInk
            Accessible.role: Accessible.StaticText
            Accessible.name: text + ": " + figure.value
        }
    }

    Column {
        anchors.centerIn: parent
        spacing: 3 * Theme.gap

        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.words["result-title"]
            font { pixelSize: Theme.title; bold: true }
        }
        Rectangle {
            anchors.horizontalCenter: parent.horizontalCenter
            width: figures.width + 4 * Theme.gap
            height: figures.height + 4 * Theme.gap
            radius: Theme.radius
            color: Theme.white
            border.color: Theme.edge
            border.width: 3 * Theme.unit
            Row {
                id: figures
                anchors.centerIn: parent
                Figure { value: view.result.pairs; label: view.words["result-pairs-label"] }
                Figure { value: view.result.moves; label: view.words["result-moves-label"] }
                Figure { value: view.result.time; label: view.words["result-time-label"] }
            }
        }
        BigButton {
            objectName: "continue"
            most: view.width - 4 * Theme.gap
            anchors.horizontalCenter: parent.horizontalCenter
            words: view.words["result-continue"]
            focus: true
            onClicked: view.result.proceed()
        }
    }
}
