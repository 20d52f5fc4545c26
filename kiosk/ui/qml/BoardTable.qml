// The numbers of the rows and columns.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: table

    required property BoardLayout boardLayout
    required property int markRow
    required property int markColumn
    readonly property bool upright: boardLayout.upright

    x: boardLayout.tableX
    y: boardLayout.tableY
    width: boardLayout.tableWidth
    height: boardLayout.tableHeight

    component Number: PlainText {
        property bool marked: false
        font { pixelSize: table.upright ? Theme.size(36) : Theme.body; bold: true }
        color: marked ? Theme.deepAmber : Theme.faintInk
        // Every card's name tells its row and column.
        Accessible.ignored: true
    }

    Repeater {
        model: table.boardLayout.columns
        Number {
            required property int index
            x: index * table.boardLayout.cell
            // Above a mark's arrow, also in large letters.
            y: Math.min(-table.boardLayout.numbers, -42 * Theme.unit - baselineOffset)
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
            // Large letters begin nearer to the edge, clear of a mark's arrow.
            x: -(table.upright ? table.boardLayout.gutter + 24 * Math.max(0, Theme.textSize - 1) * Theme.unit : table.boardLayout.numbers)
            y: index * table.boardLayout.cell
            width: table.boardLayout.numbers - (table.upright ? 0 : 30 * Theme.unit)
            height: table.boardLayout.cell
            text: index + 1
            marked: table.markRow === index
            horizontalAlignment: table.upright ? Text.AlignLeft : Text.AlignHCenter
            verticalAlignment: Text.AlignVCenter
        }
    }
}
