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

    // Where its columns begin, if they share that with the list of sessions; and how large what stands in them is written.
    property list<real> grid: []
    property real figure: size
    // Not where a word is longer than its column, nor where there are more columns.
    readonly property bool gridded: grid.length === 5 && told.length === 3 && !records.listed
        && records.cells.every(cell => letters.advanceWidth(cell.name) * 1.08 * figure / 100 <= grid[1] - between)
        && [heading, ...told.map(column => headOf(column))].every((head, at) => own(head) <= gridRoom(at + 1))
    function gridRoom(at: int): real {
        return (at === 4 ? room : grid[at + 1]) - grid[at] - (at === 4 ? 0 : 8 * Theme.unit)
    }

    // What its last sentence takes beside one line.
    readonly property real further: visits.height - visits.height / Math.max(1, visits.lineCount)

    readonly property real between: 0.75 * Theme.gap
    readonly property real room: width - 2 * inset
    readonly property real first: Math.min(0.3 * room, Math.max(0.1 * room, Math.ceil(Math.max(0, ...records.cells.map(cell => letters.advanceWidth(cell.name))) * size / 90)))
    // What all columns of numbers share, which are as many as there is something for.
    readonly property var told: columns.filter(column => records.listed || column !== "beyond")
    readonly property real all: room - first - (told.length + 1) * between

    // Each is as wide as its head, and what is left is shared among them; where it is not enough, all are equally wide.
    readonly property real headSize: Math.max(Theme.denser, 0.93 * size)
    readonly property real spare: (all - own(heading) - told.reduce((sum, column) => sum + own(headOf(column)), 0)) / (told.length + 1)
    function headOf(column: string): string {
        return words["console-counts-" + column]
    }
    function own(head: string): real {
        const plain = Math.ceil(letters.advanceWidth(head) * headSize / 100) + 2 * Theme.unit
        return head === heading && records.listed ? Math.max(plain, 6.5 * size) : plain
    }
    function wide(head: string): real {
        return spare >= 0 ? own(head) + spare : all / (told.length + 1)
    }
    readonly property real step: gridded ? 8 * Theme.unit : between
    readonly property real firstWide: gridded ? grid[1] - step : first
    // The columns of numbers, from 0.
    function wideAt(head: string, at: int): real {
        return gridded ? gridRoom(at + 1) : wide(head)
    }
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    readonly property list<string> columns: ["dropped", "overridden", "beyond", "withdrawn"]

    // Without a list there is no quota: its sessions are counted as soon as they begin.
    readonly property string heading: words[records.listed ? "console-counts-done" : "console-counts-begun"]

    aside: names.visible ? names.width : 0
    crown: names.visible ? names.height : 0
    title: words[records.listed ? "console-counts" : "console-counts-unlisted"]

    Row {
        spacing: counts.step
        PlainText { width: counts.firstWide; text: " "; font.pixelSize: counts.size }
        PanelCell { anchors.bottom: parent.bottom; width: counts.wideAt(counts.heading, 0); words: counts.heading; heading: true; number: !counts.records.listed && !counts.gridded; headSize: counts.headSize }
        Repeater {
            model: counts.columns
            delegate: PanelCell {
                required property string modelData
                anchors.bottom: parent?.bottom
                visible: counts.told.includes(modelData)
                width: counts.wideAt(words, counts.told.indexOf(modelData) + 1)
                words: counts.headOf(modelData)
                heading: true
                number: !counts.gridded
                headSize: counts.headSize
            }
        }
    }
    Repeater {
        model: counts.records.cells
        delegate: Row {
            id: cell
            required property var modelData
            spacing: counts.step
            PlainText {
                width: counts.firstWide
                text: cell.modelData.name
                font { pixelSize: counts.figure; bold: true }
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            Item {
                width: counts.wideAt(counts.heading, 0)
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
                    x: cell.modelData.listed ? parent.width * 0.56 : counts.gridded ? 0 : parent.width - width
                    text: cell.modelData.done
                    Accessible.name: `${text} ${counts.heading}`
                    font { pixelSize: counts.figure; bold: true }
                    color: Theme.ink
                }
            }
            Repeater {
                model: cell.modelData.counts
                delegate: PanelCell {
                    required property int index
                    required property string modelData
                    visible: counts.told.includes(counts.columns[index])
                    width: counts.wideAt(column, counts.told.indexOf(counts.columns[index]) + 1)
                    words: modelData
                    column: counts.headOf(counts.columns[index])
                    number: !counts.gridded
                    strong: modelData !== "0"
                    size: counts.figure
                }
            }
        }
    }
    // Visitors may read along, so the conditions are named only on request.
    PanelButton {
        id: names
        parent: counts
        anchors { top: parent.top; right: parent.right; margins: counts.inset; topMargin: 0.8 * Theme.gap }
        objectName: "names"
        font.pixelSize: Math.max(Theme.dense, 0.95 * counts.size)
        width: Math.min(Math.ceil(implicitWidth), Math.floor(0.6 * counts.width))
        visible: counts.records.cells.length > 0
        words: counts.named ? counts.words["console-names-hide"] : counts.words["console-names-show"]
        onClicked: counts.asked()
    }
    Balanced {
        id: visits
        width: parent.width
        text: counts.records.visits
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: Math.max(Theme.denser, 0.94 * counts.size)
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
}
