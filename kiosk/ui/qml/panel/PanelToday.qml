// The first page: the day in numbers, how everything is, who has come, and what can be done at once.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect

Column {
    id: today

    required property PanelScreen panel
    required property bool wide
    required property real space
    readonly property var words: panel.words

    spacing: space

    Grid {
        id: tiles
        // All are as high as the one that needs most.
        readonly property real highest: {
            let most = 0
            for (let i = 0; i < numbers.count; i++)
                most = Math.max(most, numbers.itemAt(i)?.implicitHeight ?? 0)
            return most
        }
        readonly property real each: (today.width - (columns - 1) * spacing) / columns

        width: parent.width
        columns: today.wide ? 4 : 2
        spacing: today.space
        Repeater {
            id: numbers
            model: today.panel.today.tiles
            delegate: PanelTile {
                required property var modelData
                objectName: "today-" + modelData.name
                width: tiles.each
                height: tiles.highest
                title: modelData.title
                value: modelData.value
                line: modelData.line
            }
        }
    }
    Item {
        width: parent.width
        readonly property real low: shortcuts.visible ? shortcuts.y + shortcuts.height : 0
        height: today.wide ? Math.max(left.height, middle.height, right.height, low)
                           : Math.max(left.height, right.height, low) + today.space + middle.height

        Column {
            id: left
            // Whole pixels: a card at a fraction of one would lose its right edge.
            width: Math.floor(today.wide ? parent.width * 0.31 : (parent.width - today.space) * 0.5)
            spacing: today.space
            PanelAlarms { id: alarms; width: parent.width; panel: today.panel }
            PanelSection {
                width: parent.width
                // On an upright screen it ends with the shortcuts beside it.
                least: today.wide ? 0 : (shortcuts.visible ? shortcuts.y + shortcuts.height : right.height) - alarms.height - today.space
                title: today.words["console-health"]
                Repeater {
                    model: today.panel.health.lines
                    delegate: PanelLine {
                        required property var modelData
                        line: modelData
                        width: parent.width
                        action: modelData.part === "voice" ? today.words["console-test-voice"] : ""
                        ready: !today.panel.choices.underWay && !today.panel.choices.muted
                        onAsked: today.panel.wish("test_voice", "")
                    }
                }
            }
        }
        Column {
            id: middle
            x: today.wide ? left.width + today.space : 0
            y: today.wide ? 0 : parent.height - height
            width: today.wide ? Math.floor(parent.width * 0.42) : parent.width
            spacing: today.space
            PanelCounts {
                width: parent.width
                words: today.words
                records: today.panel.records
                named: today.panel.choices.named
                onAsked: today.panel.wish("names", "")
            }
            PanelSessions { width: parent.width; words: today.words; records: today.panel.records }
        }
        Column {
            id: right
            x: parent.width - width
            width: today.wide ? parent.width - left.width - middle.width - 2 * today.space
                              : Math.floor((parent.width - today.space) * 0.5)
            spacing: today.space
            PanelActions { width: parent.width; panel: today.panel }
            PanelResume { width: parent.width; panel: today.panel }
        }
        // Below the shortest column, so that all of it is seen at once.
        PanelShortcuts {
            id: shortcuts
            readonly property Item column: !today.wide || right.height < Math.min(left.height, middle.height) ? right
                : left.height < middle.height ? left : middle
            x: column.x
            y: column.height + today.space
            width: column.width
            shown: today.panel.shortcuts
        }
    }
}
