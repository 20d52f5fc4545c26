// The points of the debrief: in pairs of cards, below each other, or in two columns.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: texts

    required property PageFrame frame
    required property DebriefShape page
    required property PointPairs pairs
    required property DebriefSizes sizes
    // How far the card to take home is below them; 0 where it is not.
    required property real apart

    // Short lines are read with less effort than long ones: in two columns where there is room.
    readonly property var columns: {
        const half = sizes.halved ? frame.half(page.points.map(point => point.text)) : page.points.length
        return [page.points.slice(0, half), page.points.slice(half)].filter(column => column.length > 0)
    }

    height: sizes.paired ? rows.height : list.height

    Column {
        id: rows
        Repeater {
            model: texts.sizes.paired ? texts.pairs.rows : []
            Row {
                id: row
                required property var modelData
                required property int index
                readonly property bool plain: modelData.length === 1
                // As high as the one that says more.
                readonly property real tall: Math.max(...Array.from(children, each => (each as PointCard)?.said ?? 0))
                topPadding: texts.pairs.step(index)
                spacing: Theme.gap
                // A plain line between cards and the code has as much air above its letters as below them.
                transform: Translate {
                    y: row.index > 1 && row.plain && texts.apart > 0
                        ? Math.round(Math.max(0, texts.apart - row.topPadding - 0.17 * texts.pairs.headingSize) / 2) : 0
                }
                Repeater {
                    model: row.modelData
                    PointCard {
                        width: row.plain ? texts.width : (texts.width - row.spacing) / 2
                        plain: row.plain
                        tall: row.tall
                        frame: texts.frame
                        page: texts.page
                        pairs: texts.pairs
                    }
                }
            }
        }
    }
    Row {
        id: list
        spacing: 2 * Theme.gap
        Repeater {
            model: texts.sizes.paired ? [] : texts.columns
            Column {
                id: column
                required property var modelData
                width: texts.sizes.halved ? (texts.width - list.spacing) / 2 : texts.width
                spacing: texts.sizes.spacing
                Repeater {
                    model: column.modelData
                    SignedLine {
                        required property var modelData
                        width: column.width
                        text: modelData.text
                        sign: texts.sizes.signed ? modelData.sign : ""
                        size: texts.sizes.text
                        leading: texts.sizes.signed ? texts.page.leading : 1.08
                        strong: texts.page.isHeading(text)
                    }
                }
            }
        }
    }
}
