// Who has come, by condition, against what was planned.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: counts

    required property var words
    required property var records
    required property bool named
    signal asked()

    readonly property real first: width * (named ? 0.16 : 0.1)
    readonly property real between: 0.6 * Theme.gap
    // As wide as each other, so that the numbers stand at even steps.
    readonly property real other: (width - 1.6 * Theme.gap - first - (shown + 1) * between) / (shown + 1)
    // Past a list is only what there is one for.
    readonly property int shown: columns.filter(told).length

    // The heads are about as large as the numbers, where the longest of their words fits its column.
    readonly property real headSize: Math.max(Theme.denser, Math.min(0.93 * size, 97 * other
        / Math.max(...[heading, ...columns.filter(told).map(column => words["console-counts-" + column])].join(" ").split(" ").map(word => letters.advanceWidth(word)))))
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    readonly property list<string> columns: ["dropped", "overridden", "beyond", "withdrawn"]

    function told(column: string): bool {
        return records.listed || column !== "beyond"
    }

    // Without a list there is no quota: its sessions are counted as soon as they begin.
    readonly property string heading: words[records.listed ? "console-counts-done" : "console-counts-begun"]

    aside: names.visible ? names.width : 0
    crown: names.visible ? names.height : 0
    title: words[records.listed ? "console-counts" : "console-counts-unlisted"]

    Row {
        spacing: counts.between
        PlainText { width: counts.first; text: " "; font.pixelSize: counts.size }
        PanelCell { anchors.bottom: parent.bottom; width: counts.other; words: counts.heading; heading: true; number: !counts.records.listed; headSize: counts.headSize }
        Repeater {
            model: counts.columns
            delegate: PanelCell {
                required property string modelData
                anchors.bottom: parent?.bottom
                visible: counts.told(modelData)
                width: counts.other
                words: counts.words["console-counts-" + modelData]
                heading: true
                number: true
                headSize: counts.headSize
            }
        }
    }
    Repeater {
        model: counts.records.cells
        delegate: Row {
            id: cell
            required property var modelData
            spacing: counts.between
            PlainText {
                width: counts.first
                text: cell.modelData.name
                font { pixelSize: counts.size; bold: true }
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            Item {
                width: counts.other
                height: done.height
                Rectangle {
                    visible: cell.modelData.listed
                    anchors { left: parent.left; verticalCenter: parent.verticalCenter }
                    width: parent.width * 0.5
                    height: 12 * Theme.unit
                    radius: height / 2
                    color: Theme.sand
                    Rectangle {
                        width: parent.width * cell.modelData.share
                        height: parent.height
                        radius: height / 2
                        color: Theme.sea
                    }
                }
                PlainText {
                    id: done
                    x: cell.modelData.listed ? parent.width * 0.56 : parent.width - width
                    text: cell.modelData.done
                    Accessible.name: `${text} ${counts.heading}`
                    font { pixelSize: counts.size; bold: true }
                    color: Theme.ink
                }
            }
            Repeater {
                model: cell.modelData.counts
                delegate: PanelCell {
                    required property int index
                    required property string modelData
                    visible: counts.told(counts.columns[index])
                    width: counts.other
                    words: modelData
                    column: counts.words["console-counts-" + counts.columns[index]]
                    number: true
                    strong: modelData !== "0"
                    size: counts.size
                }
            }
        }
    }
    // Visitors may read along, so the conditions are named only on request.
    PanelButton {
        id: names
        parent: counts
        anchors { top: parent.top; right: parent.right; margins: 0.8 * Theme.gap }
        objectName: "names"
        width: Math.min(Math.ceil(implicitWidth), Math.floor(0.6 * counts.width))
        visible: counts.records.cells.length > 0
        words: counts.named ? counts.words["console-names-hide"] : counts.words["console-names-show"]
        onClicked: counts.asked()
    }
    Balanced {
        width: parent.width
        text: counts.records.visits
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: Math.max(Theme.denser, 0.94 * counts.size)
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
}
