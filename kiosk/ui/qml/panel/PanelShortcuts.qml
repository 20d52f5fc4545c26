// The shortcuts of the study file, for those who do not know them by heart.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: shortcuts

    // Its title, and rows of keys and words.
    required property var shown

    title: shown.title
    visible: shown.rows.length > 0

    Grid {
        id: table
        width: parent.width
        columns: 2
        columnSpacing: 12 * Theme.unit
        rowSpacing: 6 * Theme.unit
        Repeater {
            model: shortcuts.shown.rows
            delegate: Row {
                id: row
                required property var modelData
                width: (table.width - table.columnSpacing) / 2
                spacing: 8 * Theme.unit
                PlainText {
                    id: keys
                    width: Math.min(Math.max(implicitWidth, 1.2 * Theme.denser), row.width * 0.5)
                    text: row.modelData.keys
                    font { pixelSize: Theme.denser; bold: true }
                    color: Theme.ink
                    wrapMode: Text.Wrap
                }
                PlainText {
                    width: row.width - keys.width - row.spacing
                    text: row.modelData.words
                    font.pixelSize: Theme.denser
                    color: Theme.faintInk
                    wrapMode: Text.Wrap
                }
            }
        }
    }
}
