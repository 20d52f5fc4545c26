// The points of the debrief: two of them on cards, below each other, or in two columns.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: texts

    required property PageFrame frame
    required property DebriefShape page
    required property PointPairs pairs
    required property DebriefSizes sizes
    // A card that the visitor knows, and what cards look like.
    required property url picture
    required property url cardBack
    required property url cardShadow

    // Short lines are read with less effort than long ones: in two columns where there is room.
    readonly property var columns: {
        const half = sizes.halved ? page.half : page.points.length
        return [page.points.slice(0, half), page.points.slice(half)].filter(column => column.length > 0)
    }

    height: sizes.paired ? rows.height : list.height
    // How high all rows are, without what is between them.
    readonly property real taken: Array.from(rows.children, row => (row as PointRow)?.own ?? 0).reduce((sum, each) => sum + each, 0)

    component PointRow: Row {
        // How high it is below its padding.
        readonly property real own: Math.max(0, ...Array.from(children, each => (each as PointCard)?.height ?? 0))
    }

    Column {
        id: rows
        Repeater {
            // All of these by number: a list that is made anew with the same points would have all of them made anew.
            model: texts.sizes.paired ? texts.pairs.rows.length : 0
            PointRow {
                id: row
                required property int index
                readonly property var points: texts.pairs.rows[index] ?? []
                readonly property bool plain: index !== 1
                readonly property bool alone: plain && (index === 0 || !texts.pairs.split)
                // As high as the one that says more.
                readonly property real tall: Math.max(...Array.from(children, each => (each as PointCard)?.said ?? 0))
                topPadding: texts.pairs.step(index, texts.pairs.further)
                spacing: Theme.gap
                Repeater {
                    model: row.alone ? 1 : row.points.length
                    PointCard {
                        required property int index
                        points: row.alone ? row.points : row.points.slice(index, index + 1)
                        width: row.alone ? texts.width : (texts.width - row.spacing) / 2
                        row: row.index
                        plain: row.plain
                        tall: row.tall
                        frame: texts.frame
                        page: texts.page
                        pairs: texts.pairs
                        picture: texts.picture
                        cardBack: texts.cardBack
                        cardShadow: texts.cardShadow
                    }
                }
            }
        }
    }
    Row {
        id: list
        spacing: 2 * Theme.gap
        Repeater {
            model: texts.sizes.paired ? 0 : texts.columns.length
            Column {
                id: column
                required property int index
                readonly property var points: texts.columns[index] ?? []
                width: texts.sizes.halved ? (texts.width - list.spacing) / 2 : texts.width
                spacing: texts.sizes.spacing
                Repeater {
                    model: column.points.length
                    SignedLine {
                        required property int index
                        readonly property var point: column.points[index] ?? {text: "", sign: ""}
                        width: column.width
                        text: point.text
                        sign: texts.sizes.signed ? point.sign : ""
                        size: texts.sizes.text
                        leading: texts.sizes.signed ? texts.page.leading : 1.08
                        strong: texts.page.isHeading(text)
                    }
                }
            }
        }
    }
}
