// Points between two ends, as numbers or as pictures. Nothing is chosen beforehand.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: scale

    required property string item
    required property string label
    required property int points
    required property list<string> pictures
    required property string leftEnd
    required property string rightEnd
    required property int value         // the chosen point, 0 for none
    // How it looks if the page belongs to it: its points then have the width of the card, from edge to edge; else null.
    property LoneRating lone: null
    required property bool dense
    required property bool tight
    // Whether there is much height for the page.
    property bool large: false
    // Whether it is a row of a table, and whether the words for its ends stand above it there.
    property bool beside: false
    property bool headed: true
    // Whether they stand below the points of every row instead.
    property bool own: false
    // How its row looks if they stand at both sides of the points instead, level with them; null if they do not.
    property var flank: null
    // How its part of a sheet looks, where they stand once in a band above all or below its own points; null if it is not on one.
    property var table: null
    // Whether that says the words for its ends.
    readonly property bool headless: table !== null && table.own !== true
    // Whether it has the width of its card, below its question.
    property bool crowned: false
    // How far above the points the words stand in a table.
    property real lift: 0
    signal chosen(int point)

    readonly property bool pictured: pictures.length > 0
    readonly property real wish: (lone?.point ?? (beside ? dense ? 72 : 92 : dense ? 58 : tight ? 66 : large ? 112 : 76) * Theme.unit) * (pictured ? 1.25 : 1)
    // Whether there are more points than stand well in a row with the words for their ends: they then have its width,
    // from edge to edge, and the words stand below them.
    readonly property bool many: points > 7 && !pictured
    readonly property bool spread: flank !== null && many && !crowned
    // How large a point is, and how far it is from the next one.
    readonly property real size: lone ? Math.min(wish, filling) : spread ? Math.min(76 * Theme.unit, filling) : flank?.point ?? Math.min(table?.point ?? wish, table !== null ? filling : many ? Math.min(84 * Theme.unit, filling) : width / (points * 1.45))
    readonly property real gap: table || lone || beside && !flank || many && below ? (width - points * size) / Math.max(1, points - 1) : flank ? spare / Math.max(1, points - 1) : pictured ? 0.4 * size
        : Math.min(1.6 * size, Math.max(0.25 * size, (below ? width - points * size : spare) / Math.max(1, points - 1)))
    readonly property real span: points * size + (points - 1) * gap
    // Many narrow ones are higher than wide, where there is the height.
    readonly property real tall: pictured || size > 0.75 * wish ? size : lone?.tall ?? table?.point ?? (many && flank === null ? wish : size)
    readonly property real filling: width / (points + (lone?.apart ?? 0.24) * (points - 1))
    // The ends stand beside the points, where there is room for that, and else below them.
    readonly property real most: 250 * Theme.unit * Theme.textSize
    readonly property bool roomy: lowest.implicitWidth + highest.implicitWidth + 2 * Theme.gap + points * size + least <= width
    readonly property real leftRoom: crowned ? lowest.implicitWidth : flank ? flank.left : roomy ? lowest.implicitWidth : Math.min(lowest.implicitWidth, most)
    readonly property real rightRoom: crowned ? Math.max(flank?.right ?? 0, highest.implicitWidth) : flank ? flank.right : roomy ? highest.implicitWidth : Math.min(highest.implicitWidth, most)
    readonly property real spare: width - leftRoom - rightRoom - 2 * Theme.gap - points * size
    readonly property real least: 0.42 * size * (points - 1)
    readonly property bool below: spread || !flank && (table !== null || lone !== null || beside || !roomy && (Math.max(lowest.implicitWidth, highest.implicitWidth) > 1.9 * most || spare < least))

    readonly property real under: (spread ? 4 : own ? 6 : table !== null ? 8 : large && Theme.textSize <= 1.15 ? 14 : 12) * Theme.unit
    readonly property real words: Math.max(lowest.height, highest.height)
    // Below a few points there would be room for a few letters only: the ends then reach beyond the points.
    readonly property real half: Math.min(width / 2 - Theme.gap, Math.max(span / 2 - 0.5 * Theme.gap, most))

    // In a table the ends stand above the points: they head the rows below, too.
    readonly property real head: beside && headed && !own && table === null ? words + lift : 0

    // In a row, what has air below its letters is in the middle by what can be seen of it.
    height: headless ? row.height : spread ? row.height + words + under - 8 * Theme.unit : flank ? tall : beside && !own ? head + row.height : below ? row.height + words + under : Math.max(row.height, words)

    // Under the first point, or above it; or before it, at the edge where the question begins.
    PlainText {
        id: lowest
        visible: !scale.headless && (!scale.beside || scale.own || scale.headed)
        x: Theme.across(0, width, scale.width)
        y: scale.beside && !scale.own ? scale.words - height : scale.below ? row.y + row.height + scale.under : (scale.height - height) / 2
        width: scale.table?.own ? scale.table.room(scale.leftEnd, scale.rightEnd) : scale.below ? scale.half : scale.leftRoom
        text: scale.leftEnd
        horizontalAlignment: scale.flank && !scale.spread ? Text.AlignRight : Text.AlignLeft
        lineHeight: scale.flank && !scale.spread ? 0.9 : 1
        font.pixelSize: (scale.flank ?? scale.table)?.end ?? (scale.own ? Theme.size(28) : scale.lone?.end ?? (scale.large ? Theme.size(Theme.textSize > 1.15 ? 30 : 34) : scale.beside ? Theme.size(30) : Theme.small))
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    PlainText {
        id: highest
        visible: lowest.visible
        readonly property real end: Math.max(scale.span, 2 * scale.half + Theme.gap)
        x: Theme.across(scale.below ? end - width : scale.leftRoom + scale.span + 2 * Theme.gap, width, scale.width)
        y: scale.beside && !scale.own ? scale.words - height : scale.below ? lowest.y : (scale.height - height) / 2
        width: scale.table?.own ? scale.table.room(scale.rightEnd, scale.leftEnd) : scale.below ? scale.half : scale.rightRoom
        text: scale.rightEnd
        horizontalAlignment: scale.below ? Text.AlignRight : Text.AlignLeft
        lineHeight: lowest.lineHeight
        font.pixelSize: lowest.font.pixelSize
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    // The line that joins the points to a scale.
    Rectangle {
        visible: !scale.pictured
        x: row.x + scale.size / 2
        y: row.y + (scale.tall - height) / 2
        width: scale.span - scale.size
        height: 4 * Theme.unit
        color: Theme.edge
    }
    Row {
        id: row
        x: Theme.across(scale.below ? 0 : scale.leftRoom + Theme.gap, width, scale.width)
        y: scale.beside && !scale.flank ? scale.head : scale.below ? 0 : (scale.height - height) / 2
        spacing: scale.gap
        Repeater {
            id: buttons
            model: scale.points
            Choosable {
                id: point
                required property int index
                readonly property int number: index + 1

                // The keyboard stops once at a scale, at its answer or its first point; arrows go on from there.
                function go(to: int) {
                    const other = buttons.itemAt(to) as Choosable
                    if (other)
                        other.forceActiveFocus(Qt.TabFocusReason)
                }
                objectName: `answer-${scale.item}-${number}`
                on: scale.value === number
                focusPolicy: on || (scale.value === 0 && index === 0) ? Qt.StrongFocus : Qt.ClickFocus
                focus: index === 0
                width: scale.size
                height: scale.tall
                z: visualFocus ? 1 : 0
                scale: down ? 0.94 : 1
                Accessible.role: Accessible.RadioButton
                Accessible.name: `${scale.label} ${number}` + (index === 0 ? ` ${scale.leftEnd}` : number === scale.points ? ` ${scale.rightEnd}` : "")
                onClicked: scale.chosen(number)
                Keys.onLeftPressed: go(index - Theme.ahead)
                Keys.onRightPressed: go(index + Theme.ahead)

                contentItem: Item {
                    Text {
                        textFormat: Text.PlainText
                        anchors.centerIn: parent
                        visible: !scale.pictured
                        readonly property real reach: Math.min(scale.size, scale.tall)
                        text: point.number
                        font { pixelSize: Math.min(scale.lone ? Theme.size(56) : Theme.heading, Math.max((scale.lone && scale.tall > scale.size ? 0.6 : scale.lone ? 0.53 : 0.48) * reach, Math.min(Theme.body, 0.5 * reach))); bold: true }
                        color: point.on ? Theme.white : Theme.ink
                    }
                    Image {
                        anchors.centerIn: parent
                        visible: scale.pictured
                        width: 0.8 * scale.size
                        height: width
                        source: Qt.resolvedUrl(scale.pictures[point.index] ?? "")
                        sourceSize: Qt.size(width, height)
                    }
                }
                background: Rectangle {
                    radius: scale.pictured ? Theme.radius : width / 2
                    // Only what is chosen is filled; the pointer over it changes the edge alone.
                    color: point.on ? (scale.pictured ? Theme.sand : Theme.sea) : scale.pictured ? Theme.white : Theme.touchable
                    border.color: Theme.sea
                    border.width: (point.on && scale.pictured ? 8 : point.hovered ? 5 : 3) * Theme.unit
                    FocusRing {
                        around: point
                        reach: 8 * Theme.unit
                        radius: scale.pictured ? Theme.radius + reach : width / 2
                    }
                }
            }
        }
    }
}
