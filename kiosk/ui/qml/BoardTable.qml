// The numbers of the rows and columns.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: table

    required property BoardLayout boardLayout
    required property int markRow
    required property int markColumn

    x: boardLayout.tableX
    y: boardLayout.tableY
    width: boardLayout.tableWidth
    height: boardLayout.tableHeight

    component Number: PlainText {
        property bool marked: false
        font { pixelSize: table.boardLayout.numberSize; bold: true }
        // In a band of amber it is as dark as all other words.
        color: !marked ? Theme.faintInk : table.markRow >= 0 && table.markColumn >= 0 ? Theme.deepAmber : Theme.ink
        // Every card's name tells its row and column.
        Accessible.ignored: true
    }

    Repeater {
        model: table.boardLayout.columns
        Number {
            required property int index
            x: index * table.boardLayout.cell
            y: -table.boardLayout.near - baselineOffset
            width: table.boardLayout.cell
            text: index + 1
            marked: table.markColumn === index
            horizontalAlignment: Text.AlignHCenter
        }
    }
    Repeater {
        model: table.boardLayout.rows
        Number {
            required property int index
            x: -table.boardLayout.gutter
            y: index * table.boardLayout.cell
            width: table.boardLayout.gutter + table.boardLayout.margin * table.boardLayout.cell
            height: table.boardLayout.cell
            text: index + 1
            marked: table.markRow === index
            horizontalAlignment: Text.AlignHCenter
            verticalAlignment: Text.AlignVCenter
        }
    }
}
