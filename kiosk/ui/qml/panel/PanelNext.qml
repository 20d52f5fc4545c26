// The third page: what holds from the next session on, and what is seldom looked at.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: next

    required property PanelScreen panel
    required property bool wide
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    // How much of it is seen at once.
    required property real seen
    // As large as on the first page: as large as goes, as long as the page does not scroll for it. Before letters get
    // smaller, the answers stand closer. In whole pixels, as letters are drawn.
    readonly property real usual: (wide ? 1.15 : 1) * Theme.dense
    readonly property list<real> sizes: Theme.textSize > 1.15 ? [] : [36, 34, 32, 30, 29, 28, 27, 26].map(each => Math.round(each * Theme.unit)).filter(each => each > usual)
    readonly property real size: sizes.find(each => (headed(each) || each <= 30 * Theme.unit) && deep(each, true) <= seen) ?? usual
    readonly property bool close: deep(size, false) > seen
    readonly property real crown: names.visible ? names.height : 0
    readonly property real half: wide ? Math.floor((width - space) * 0.5) : width

    height: wide ? Math.max(left.height, right.height) : left.height + space + right.height

    // Whether the first heading has one line beside its button.
    function headed(size: real): bool {
        const button = choices.conditions.length > 0 ? wordWidths.plain(words[choices.named ? "console-names-hide" : "console-names-show"], 0.95 * size) + 38 * Theme.unit + 0.5 * Theme.gap : 0
        return wordWidths.bold(words["console-next-session"], 1.12 * size) * 1.02 + button <= half - 2 * later.inset
    }
    function tall(close: bool): real {
        return (close ? 68 : 80) * Theme.unit
    }
    function apart(close: bool): real {
        return (!close ? 22 : wide ? 14 : 8) * Theme.unit
    }
    // How many rows the answers to a question have in so much width: each as wide as if it were chosen.
    function rowsOf(options: var, size: real, width: real): int {
        let rows = 1, end = 0
        for (const option of options) {
            const each = Math.max(92 * Theme.unit, wordWidths.bold(option.label, size) + 50 * Theme.unit)
            rows += end > 0 && end + each > width ? 1 : 0
            end = (end > 0 && end + each <= width ? end : 0) + each + Math.round(9 * Theme.unit)
        }
        return rows
    }
    // How high the page is at least with letters of this size, with the answers closer or not.
    function deep(size: real, close: bool): real {
        const width = half - 2 * later.inset, step = 10 * Theme.unit
        const line = Math.ceil(letters.height * Math.round(size) / 100)
        const heading = (title, aside, crown) => Math.max(crown, Math.ceil(wordWidths.lines(title, 1.12 * size, width - aside) * 1.12 * line)) + later.edges + 1
        const listed = (counts, title, crown) => heading(title, 0, crown) + counts.reduce((sum, each) => sum + each * line, 0) + Math.max(0, counts.length - 1) * step
        const crown = choices.conditions.length > 0 ? Math.max(58 * Theme.unit, line + 18 * Theme.unit) : 0
        const asked = [["condition", choices.conditions], ["embodiment", choices.embodiments], ["language", choices.languages], ["volume", choices.volumes]].filter(([_, options]) => options.length > 0)
        const aside = crown > 0 ? Math.min(0.6 * half, wordWidths.plain(names.words, size) + 38 * Theme.unit) + 0.5 * Theme.gap : 0
        const chosen = heading(words["console-next-session"], aside, crown) + (asked.length - 1) * apart(close)
            + asked.reduce((sum, [name, options]) => {
                const rows = rowsOf(options, size, width)
                return sum + wordWidths.plainLines(words["console-" + name], size, width) * line + 8 * Theme.unit
                    + rows * Math.max(tall(close), line + 18 * Theme.unit) + (rows - 1) * Math.round(9 * Theme.unit)
            }, 0)
        const booth = listed(panel.health.more.map(each => {
            const named = Math.min(0.29 * width, 6.5 * size)
            return Math.max(wordWidths.lines(each.name, size, named), wordWidths.plainLines(each.message, size, width - named - 1.25 * size - 2 * step))
        }), words["console-booth"], wide ? crown : 0)
        const keys = Math.max(0, ...panel.shortcuts.rows.map(row => wordWidths.bold(row.keys, size)))
        const told = panel.shortcuts.rows.map(row => wordWidths.plainLines(row.words, size, (width - Theme.gap) / 2 - keys - 16 * Theme.unit))
        const around = wordWidths.plainLines(words["console-keys"], size, width)
        const known = panel.shortcuts.title === "" ? 0 : listed([...told.filter((_, at) => at % 2 === 0).map((each, at) => Math.max(each, told[2 * at + 1] ?? 0)), around], panel.shortcuts.title, 0) + space
        const after = booth + space + known + Math.max(tall(close), 1.45 * size + 18 * Theme.unit)
        const before = chosen
        return Math.ceil(wide ? Math.max(before, after) : before + space + after)
    }
    WordWidths {
        id: wordWidths
    }
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }

    component Choice: PanelChoice {
        size: next.size
        lettering: next.size
        least: next.tall(next.close)
        broad: 92 * Theme.unit
    }

    Column {
        id: left
        width: next.half
        spacing: next.space
        PanelSection {
            id: later
            width: parent.width
            title: next.words["console-next-session"]
            aside: names.visible ? names.width : 0
            crown: next.crown
            size: next.size
            apart: next.apart(next.close)
            Choice {
                width: parent.width
                action: "condition"
                title: next.words["console-condition"]
                options: next.choices.conditions
                chosen: next.choices.condition
                onPicked: value => next.panel.wish("condition", value)
            }
            // As on the first page: beside the heading.
            PanelButton {
                id: names
                parent: later
                objectName: "names-of-choices"
                anchors { top: parent.top; right: parent.right; margins: later.inset; topMargin: later.above }
                width: Math.min(Math.ceil(implicitWidth), Math.floor(0.6 * later.width))
                visible: next.choices.conditions.length > 0
                least: 58 * Theme.unit
                // The heading has one line beside it.
                horizontalPadding: 18 * Theme.unit
                font.pixelSize: Math.max(Theme.dense, 0.95 * next.size)
                words: next.choices.named ? next.words["console-names-hide"] : next.words["console-names-show"]
                onClicked: next.panel.wish("names", "")
            }
            Choice {
                width: parent.width
                action: "embodiment"
                title: next.words["console-embodiment"]
                options: next.choices.embodiments
                chosen: next.choices.embodiment
                onPicked: value => next.panel.wish("embodiment", value)
            }
            Choice {
                width: parent.width
                action: "language"
                title: next.words["console-language"]
                options: next.choices.languages
                chosen: next.choices.language
                onPicked: value => next.panel.wish("language", value)
            }
            Choice {
                width: parent.width
                action: "volume"
                title: next.words["console-volume"]
                options: next.choices.volumes
                chosen: next.choices.volume
                onPicked: value => next.panel.wish("volume", value)
            }
        }
    }
    Column {
        id: right
        x: next.width - width
        y: next.wide ? 0 : left.height + next.space
        width: left.width
        spacing: next.space
        PanelSection {
            width: parent.width
            title: next.words["console-booth"]
            size: next.size
            // Its heading is level with the one beside it.
            crown: next.wide ? next.crown : 0
            Repeater {
                model: next.panel.health.more
                delegate: PanelLine { required property var modelData; line: modelData; words: next.words; width: parent.width; size: next.size }
            }
        }
        PanelShortcuts { width: parent.width; shown: next.panel.shortcuts; keys: next.words["console-keys"]; size: next.size }
        // Apart from what is pressed all day.
        PanelButton {
            objectName: "action-leave"
            anchors.right: parent.right
            words: next.words["console-quit"]
            drawing: "M12 2.5 V11.5 M7.2 5.8 A8 8 0 1 0 16.8 5.8"
            grave: true
            least: next.tall(next.close)
            font.pixelSize: next.size
            horizontalPadding: 24 * Theme.unit
            onClicked: next.panel.wish("quit", "")
        }
    }
}
