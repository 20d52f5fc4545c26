// Points between two ends, as numbers or as pictures. Nothing is chosen beforehand.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: scale

    required property string item
    required property string label
    required property int points
    required property list<string> pictures
    required property string leftEnd
    required property string rightEnd
    required property int value         // the chosen point, 0 for none
    required property bool alone        // whether the page belongs to it
    required property bool dense
    signal chosen(int point)

    readonly property bool pictured: pictures.length > 0
    readonly property real wish: (alone ? 132 : dense ? 58 : 76) * Theme.unit * (pictured ? 1.25 : 1)
    readonly property real size: Math.min(wish, width / (points * 1.45))
    readonly property real gap: size * (pictured ? 0.25 : alone ? 0.25 : 0.42)
    readonly property real span: points * size + (points - 1) * gap
    // The ends stand beside the points, where there is room for that, and else below them.
    readonly property real beside: (width - span) / 2 - Theme.gap
    readonly property bool below: alone || beside < 210 * Theme.unit * Theme.textSize

    readonly property real words: Math.max(lowest.height, highest.height)

    height: below ? row.height + words + 0.5 * Theme.gap : Math.max(row.height, words)

    PlainText {
        id: lowest
        x: Theme.across(scale.below ? scale.width / 2 - Theme.gap - width : 0, width, scale.width)
        y: scale.below ? row.height + 0.5 * Theme.gap : (scale.height - height) / 2
        // Below a few points there would be room for a few letters only: the ends then reach beyond the points.
        width: scale.below ? Math.max(scale.span / 2, Math.min(scale.width / 2, 280 * Theme.unit * Theme.textSize)) - Theme.gap : scale.beside
        text: scale.leftEnd
        horizontalAlignment: scale.below ? Text.AlignLeft : Text.AlignRight
        font.pixelSize: Theme.small
        wrapMode: Text.Wrap
        color: Theme.faintInk
    }
    PlainText {
        id: highest
        x: Theme.across(scale.below ? scale.width / 2 + Theme.gap : scale.width - width, width, scale.width)
        y: scale.below ? lowest.y : (scale.height - height) / 2
        width: lowest.width
        text: scale.rightEnd
        horizontalAlignment: scale.below ? Text.AlignRight : Text.AlignLeft
        font.pixelSize: Theme.small
        wrapMode: Text.Wrap
        color: Theme.faintInk
    }
    Row {
        id: row
        anchors.horizontalCenter: parent.horizontalCenter
        y: scale.below ? 0 : (scale.height - height) / 2
        spacing: scale.gap
        Repeater {
            id: buttons
            model: scale.points
            Choosable {
                id: point
                required property int index
                readonly property int number: index + 1

                // The keyboard stops once at a scale, at its answer or its first point; arrows go on from there.
                function go(to: int) {
                    const other = buttons.itemAt(to) as Choosable
                    if (other)
                        other.forceActiveFocus(Qt.TabFocusReason)
                }
                objectName: `answer-${scale.item}-${number}`
                on: scale.value === number
                focusPolicy: on || (scale.value === 0 && index === 0) ? Qt.StrongFocus : Qt.ClickFocus
                focus: index === 0
                width: scale.size
                height: scale.size
                scale: down ? 0.94 : 1
                Accessible.role: Accessible.RadioButton
                Accessible.name: `${scale.label} ${number}` + (index === 0 ? ` ${scale.leftEnd}` : number === scale.points ? ` ${scale.rightEnd}` : "")
                onClicked: scale.chosen(number)
                Keys.onLeftPressed: go(index - Theme.ahead)
                Keys.onRightPressed: go(index + Theme.ahead)

                contentItem: Item {
                    Text {
                        textFormat: Text.PlainText
                        anchors.centerIn: parent
                        visible: !scale.pictured
                        text: point.number
                        font { pixelSize: Math.min(scale.alone ? Theme.heading : Theme.body, (scale.alone ? 0.55 : 0.5) * scale.size); bold: true }
                        color: point.on ? Theme.white : Theme.ink
                    }
                    Image {
                        anchors.centerIn: parent
                        visible: scale.pictured
                        width: 0.8 * scale.size
                        height: width
                        source: Qt.resolvedUrl(scale.pictures[point.index] ?? "")
                        sourceSize: Qt.size(width, height)
                    }
                }
                background: Rectangle {
                    radius: scale.pictured ? Theme.radius : width / 2
                    // Only what is chosen is filled; the pointer over it changes the edge alone.
                    color: point.on ? (scale.pictured ? Theme.sand : Theme.sea) : Theme.white
                    border.color: Theme.sea
                    border.width: (point.on && scale.pictured ? 8 : point.hovered ? 5 : 3) * Theme.unit
                    FocusRing {
                        around: point
                        reach: 8 * Theme.unit
                        radius: scale.pictured ? Theme.radius + reach : height / 2
                    }
                }
            }
        }
    }
}
