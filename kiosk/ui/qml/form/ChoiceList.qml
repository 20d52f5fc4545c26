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
    required property bool alone
    required property bool dense
    property bool large: false          // whether there is much height for the page
    // How large they are in two columns, all as wide; 0 where they do not stand so.
    property real paired: 0
    // How many of such stand in each row, which they fill; none where all are as wide.
    property var shared: []
    required property real usual        // how high an option is at least
    // How much higher it is where there is height for that, and how large its letters are then.
    property real grown: 0
    property bool easy: false
    property real size: Theme.size(34)
    readonly property real tall: usual + grown
    // In how many rows they stand if all are as wide, and how high these are without what is added.
    readonly property int rows: tiled ? Math.ceil(options.length / columns) : stacked ? options.length : 0
    readonly property real least: {
        if (rows === 0 || flowing)
            return height
        let most = usual
        for (let i = 0; i < buttons.count; i++)
            most = Math.max(most, (buttons.itemAt(i) as Choosable)?.implicitHeight ?? 0)
        return rows * most + (rows - 1) * spacing
    }
    signal picked(string option)

    // Large texts on a wide screen leave little room around them.
    readonly property bool narrow: Theme.textSize > 1.15 && width >= 1020 * Theme.unit && !alone
    // Whether they may stand in the columns that all lists of a wide page share.
    readonly property bool even: !alone && !dense && !large && width >= 1020 * Theme.unit
    readonly property bool stacked: alone && options.length <= 6
    // Where there is room for it, all are as wide, in rows that are as full; one below the other only on an upright screen.
    readonly property bool tiled: !stacked && !dense && (columns > 1 || width < 1020 * Theme.unit)
    // How far apart they are in columns, and in rows that are filled.
    readonly property real packed: !dense && !alone && width >= 1020 * Theme.unit ? 8 * Theme.unit : large ? (easy ? 14 : 18) * Theme.unit : 0.5 * Theme.gap
    readonly property real apart: shared.length > 0 ? gridGap : 0.67 * Theme.gap
    readonly property real widest: {
        let most = 0
        for (let i = 0; i < buttons.count; i++)
            most = Math.max(most, (buttons.itemAt(i) as Choosable)?.implicitWidth ?? 0)
        return most
    }
    readonly property int columns: {
        const fit = Math.max(1, Math.min(options.length, Math.floor((width + packed) / (widest + packed))))
        return Math.ceil(options.length / Math.ceil(options.length / fit))
    }
    // On a wide screen, what takes fewer rows so: each as wide as its words need, and then wider until its row is full.
    readonly property var filled: {
        const rows = [], wide = width - (shared.length > 0 ? 0 : 0.5)
        let left = -1
        for (let i = 0; i < buttons.count; i++) {
            const wish = (buttons.itemAt(i) as Choosable)?.implicitWidth ?? 0
            if (shared.length > 0 ? i === 0 || rows[rows.length - 1].length === shared[rows.length - 1] : left < wish + apart) {
                rows.push([])
                left = wide + apart
            }
            rows[rows.length - 1].push(wish)
            left -= wish + apart
        }
        if (shared.length === 0 && rows.length >= Math.ceil(options.length / columns))
            return []
        // A row whose words fit that has columns, as those of the other lists.
        const part = count => (wide + apart) / count - apart
        const equal = row => shared.length > 0 && row.every(wish => wish + 20 * Theme.unit <= part(row.length))
        const widths = []
        for (const fit of rows) {
            const row = equal(fit) ? fit.map(() => part(fit.length)) : fit
            const spare = (wide - row.reduce((sum, wish) => sum + wish + apart, -apart)) / row.length
            // Whole pixels, and the row ends where the others do.
            let at = 0
            for (const wish of row) {
                widths.push(Math.floor(at + wish + spare) - Math.floor(at))
                at += wish + spare
            }
        }
        return widths
    }
    // The same in columns that all lists of the page share: each as many of them as its words need, and the last ones of
    // a row what is left. So what stands in two rows, or in two lists, begins at the same places.
    property real gridGap: 12 * Theme.unit
    readonly property var gridded: {
        if (shared.length > 0)
            return []
        const wishes = []
        for (let i = 0; i < buttons.count; i++)
            wishes.push((buttons.itemAt(i) as Choosable)?.implicitWidth ?? 0)
        if (paired > 0)
            // The last of an odd number is as wide as the others: a wider one would look as if it weighed more.
            return wishes.map(() => Math.floor((width - gridGap) / 2))
        // As many rows as they would take side by side, or one less than in columns of their own.
        let most = 1, end = -packed
        for (const wish of wishes) {
            if (end + packed + wish > width && end > 0) {
                most++
                end = -packed
            }
            end += packed + wish
        }
        if (tiled)
            most = Math.ceil(options.length / columns) - 1
        for (const count of even ? [6, 12] : []) {
            const part = (width - (count - 1) * gridGap) / count
            const rows = []
            let left = -1
            for (const wish of wishes) {
                const span = Math.min(count, Math.max(1, Math.ceil((wish + gridGap) / (part + gridGap))))
                if (left < span) {
                    rows.push([])
                    left = count
                }
                rows[rows.length - 1].push(span)
                left -= span
            }
            if (rows.length > most)
                continue
            const widths = []
            for (const row of rows) {
                // The narrowest first, and of two as narrow the last.
                for (let spare = count - row.reduce((sum, span) => sum + span, 0); spare > 0; spare--)
                    row[row.lastIndexOf(Math.min(...row))]++
                let at = 0
                for (const span of row) {
                    widths.push(Math.floor((at + span) * (part + gridGap) - gridGap) - Math.floor(at * (part + gridGap)))
                    at += span
                }
            }
            return widths
        }
        return []
    }
    readonly property bool flowing: width >= 1020 * Theme.unit && (gridded.length > 0 || (tiled || shared.length > 0) && filled.length > 0)
    readonly property real tile: Math.floor((width - (columns - 1) * packed) / columns)

    spacing: flowing ? (gridded.length > 0 ? gridGap : apart) : packed
    flow: stacked ? Flow.TopToBottom : Flow.LeftToRight

    Repeater {
        id: buttons
        model: list.options
        Choosable {
            id: option
            required property int index
            required property var modelData

            function go(to: int) {
                const other = buttons.itemAt(to) as Choosable
                if (other)
                    other.forceActiveFocus(Qt.TabFocusReason)
            }
            objectName: `option-${list.item}-${modelData.id}`
            on: list.chosen.includes(modelData.id)
            focusPolicy: list.several || on || (list.chosen.length === 0 && index === 0) ? Qt.StrongFocus : Qt.ClickFocus
            focus: index === 0
            height: Math.max(implicitHeight, list.tall)
            width: list.stacked ? list.width : list.flowing ? (list.gridded.length > 0 ? list.gridded : list.filled)[index] : list.tiled ? list.tile : Math.min(implicitWidth, list.width)
            words: modelData.text
            font.pixelSize: list.paired > 0 ? list.paired : list.alone ? Theme.body : list.large ? list.size : Theme.reading
            leftPadding: (list.narrow ? 14 : list.paired > 0 ? 18 : list.even ? 20 : 22) * Theme.unit
            rightPadding: (list.narrow ? 16 : list.paired > 0 ? 9 : list.even ? 16 : 30) * Theme.unit
            verticalPadding: (list.alone ? 16 : list.narrow ? 3 : 10) * Theme.unit
            spacing: (list.narrow ? 10 : list.even ? 12 : 16) * Theme.unit
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
                    width: 34 * Theme.unit
                    height: width
                    radius: list.several ? 7 * Theme.unit : width / 2
                    color: Theme.white
                    border { color: option.on ? Theme.white : Theme.sea; width: 3 * Theme.unit }
                    Rectangle {
                        anchors.centerIn: parent
                        width: 18 * Theme.unit
                        height: width
                        radius: list.several ? 3 * Theme.unit : width / 2
                        color: Theme.sea
                        visible: option.on
                    }
                }
                Text {
                    textFormat: Text.PlainText
                    anchors.verticalCenter: parent.verticalCenter
                    width: Math.min(implicitWidth, list.width - mark.width - option.spacing - option.leftPadding - option.rightPadding)
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
