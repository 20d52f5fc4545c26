// Options to choose one or several from. It shows the choice that it is given.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Flow {
    id: list

    required property string item
    required property string label
    required property var options
    required property var chosen        // the ids of what is chosen
    required property bool several
    required property PlainQuestions questions
    // How wide they are, row by row, and how many lines each row has.
    required property var arranged
    // How much higher each row is where there is height for that.
    property real grown: 0
    // Whether those of one line are as high as those of two, and how much higher than that makes the list.
    property bool even: false
    readonly property real uneven: rows * highest - (least - (rows - 1) * spacing)
    readonly property real highest: Math.max(...arranged.map(row => rowHeight(row.lines)))
    readonly property real size: questions.optionSize
    // The width and the lines of each.
    readonly property var tiles: {
        const all = []
        for (const row of arranged)
            for (const width of row.widths)
                all.push({width, lines: row.lines})
        return all
    }
    readonly property int rows: arranged.length
    // How high they are without what is added.
    readonly property real least: arranged.reduce((sum, row) => sum + rowHeight(row.lines), (rows - 1) * spacing)
    signal picked(string option)

    // How high options of so many lines are.
    function rowHeight(lines: int): real {
        return Math.ceil(lines > 1 ? Math.max(questions.optionHeight, questions.textHeight(lines, size)) : questions.optionHeight)
    }

    spacing: questions.gutter

    Repeater {
        id: buttons
        model: list.options
        Choosable {
            id: option
            required property int index
            required property var modelData
            readonly property var tile: list.tiles[index] ?? {width: list.width, lines: 1}

            function go(to: int) {
                const other = buttons.itemAt(to) as Choosable
                if (other)
                    other.forceActiveFocus(Qt.TabFocusReason)
            }
            objectName: `option-${list.item}-${modelData.id}`
            on: list.chosen.includes(modelData.id)
            focusPolicy: list.several || on || (list.chosen.length === 0 && index === 0) ? Qt.StrongFocus : Qt.ClickFocus
            focus: index === 0
            height: Math.max(implicitHeight, list.even ? list.highest : list.rowHeight(tile.lines), list.questions.optionHeight + list.grown)
            width: tile.width
            words: modelData.text
            font.pixelSize: list.size
            leftPadding: list.questions.beforeRing
            rightPadding: list.questions.afterWords
            verticalPadding: 3 * Theme.unit
            spacing: list.questions.afterRing
            scale: down ? 0.97 : 1
            Accessible.role: list.several ? Accessible.CheckBox : Accessible.RadioButton
            Accessible.name: `${list.label} ${words}`
            onClicked: list.picked(modelData.id)
            Keys.onLeftPressed: go(index - Theme.ahead)
            Keys.onRightPressed: go(index + Theme.ahead)

            contentItem: Row {
                spacing: option.spacing
                // Round where there is one answer, square where there may be more.
                Rectangle {
                    id: mark
                    anchors.verticalCenter: parent.verticalCenter
                    width: list.questions.ring
                    height: width
                    radius: list.several ? 0.2 * width : width / 2
                    color: Theme.white
                    border { color: option.on ? Theme.white : Theme.sea; width: 3 * Theme.unit }
                    Rectangle {
                        anchors.centerIn: parent
                        width: 0.53 * mark.width
                        height: width
                        radius: list.several ? 0.17 * width : width / 2
                        color: Theme.sea
                        visible: option.on
                    }
                }
                Text {
                    textFormat: Text.PlainText
                    anchors.verticalCenter: parent.verticalCenter
                    width: Math.min(implicitWidth, option.tile.width - mark.width - option.spacing - option.leftPadding - option.rightPadding)
                    text: option.words
                    font: option.font
                    wrapMode: Text.Wrap
                    color: option.on ? Theme.white : Theme.ink
                }
            }
            background: Rectangle {
                radius: Theme.radius
                // As the points of a scale: pale until it is chosen. The pointer over it changes the edge alone.
                color: option.on ? Theme.sea : Theme.touchable
                border { color: Theme.sea; width: (option.hovered ? 4 : 2) * Theme.unit }
                FocusRing {
                    around: option
                    reach: 7 * Theme.unit
                    radius: Theme.radius + reach
                }
            }
        }
    }
}
