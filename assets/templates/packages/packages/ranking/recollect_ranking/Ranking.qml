// Options to be put in an order: what is tapped first comes first, and a tap on one that has a place takes it back.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic

Column {
    id: list

    required property var item      // id, text and what view() returns
    required property var answer    // the ids in their order, or null
    required property var theme     // sizes and colours
    required property bool alone    // whether nothing else is on the page
    signal answered(var value)      // the ids in their order; null takes the answer back

    property var order: answer ?? []

    function tap(option: string) {
        const at = order.indexOf(option)
        const before = answer
        order = at < 0 ? [...order, option] : order.slice(0, at)
        if (order.length === item.options.length)
            answered(order)
        else if (before !== null)
            answered(null)
    }
    onAnswerChanged: if (answer !== null) order = answer

    spacing: 0.5 * theme.gap

    Repeater {
        model: list.item.options
        AbstractButton {
            id: option
            required property var modelData
            readonly property int place: list.order.indexOf(modelData.id) + 1

            objectName: `rank-${list.item.id}-${modelData.id}`
            width: list.width
            height: label.height + 2 * 14 * list.theme.unit
            focusPolicy: Qt.StrongFocus
            Accessible.role: Accessible.Button
            Accessible.name: place > 0 ? `${modelData.text}: ${place}` : modelData.text
            onClicked: list.tap(modelData.id)

            background: Rectangle {
                radius: list.theme.radius
                color: option.place > 0 ? list.theme.sand : list.theme.white
                border { color: list.theme.sea; width: (option.activeFocus ? 6 : 3) * list.theme.unit }
            }
            Text {
                id: label
                anchors { left: parent.left; right: parent.right; verticalCenter: parent.verticalCenter; margins: 20 * list.theme.unit }
                textFormat: Text.PlainText
                text: option.place > 0 ? `${option.place}  ${option.modelData.text}` : option.modelData.text
                font.pixelSize: list.theme.body
                wrapMode: Text.Wrap
                color: list.theme.ink
            }
        }
    }
}
