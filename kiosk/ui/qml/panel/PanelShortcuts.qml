// The shortcuts of the study file, and how the panel is worked by keyboard.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: shortcuts

    // Its title, and rows of keys and words.
    required property var shown
    // How to go around in the panel, and when it closes.
    required property string keys

    // All keys are as wide as the widest, so that the words stand below each other.
    readonly property real named: widest(shown.rows, letters.font)
    // What is measured depends on the font, which is named for that reason alone.
    function widest(rows: var, _font: font): real {
        return Math.ceil(Math.max(0, ...rows.map(row => letters.advanceWidth(row.keys)))) + 2 * Theme.unit
    }
    FontMetrics {
        id: letters
        font { pixelSize: shortcuts.size; bold: true }
    }

    title: shown.title
    visible: title !== ""

    Grid {
        id: table
        visible: shortcuts.shown.rows.length > 0
        width: parent.width
        columns: 2
        columnSpacing: Theme.gap
        rowSpacing: 10 * Theme.unit
        Repeater {
            model: shortcuts.shown.rows
            delegate: Row {
                id: row
                required property var modelData
                width: (table.width - table.columnSpacing) / 2
                spacing: 14 * Theme.unit
                PlainText {
                    id: keys
                    width: Math.min(shortcuts.named, row.width * 0.5)
                    text: row.modelData.keys
                    font { pixelSize: shortcuts.size; bold: true }
                    color: Theme.ink
                    wrapMode: Text.Wrap
                }
                PlainText {
                    width: row.width - keys.width - row.spacing
                    text: row.modelData.words
                    font.pixelSize: shortcuts.size
                    color: Theme.faintInk
                    wrapMode: Text.Wrap
                }
            }
        }
    }
    PlainText {
        width: parent.width
        text: shortcuts.keys
        font.pixelSize: shortcuts.size
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
}
