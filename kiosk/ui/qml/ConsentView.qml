// What can be agreed to. Nothing is ticked beforehand, and to decline is as easy as to agree, and looks like it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property ConsentScreen consent

    // Whether all of the text is shown, or what stands for it in short.
    property bool whole: false
    readonly property bool short: consent.points.length > 0 && !whole

    aside: short ? sayable(consent.points) : ""
    readonly property var read: aside === "" ? consent.points : consent.points.slice(0, -1)

    // The page has the largest letters with which points and boxes are all seen at once: in points, in boxes, how many gaps
    // apart its groups are, and how many are in a box above and below its words. Whether it has the largest of all, and
    // whether even the smallest are too large.
    readonly property bool upright: width < height
    readonly property var sizes: upright ? [[36, 36, 1, 0.8], [36, 36, 0.7, 0.6], [36, 36, 0.6, 0.5], [36, 36, 0.4, 0.35], [36, 36, 0.4, 0.25], [34, 33, 0.6, 0.4], [34, 33, 0.4, 0.35], [32, 31, 0.4, 0.25], [31, 31, 0.4, 0.2], [30, 29, 0.4, 0.2]]
        : [[34, 34, 0.9, 0.9], [32, 34, 0.9, 0.9], [32, 34, 0.9, 0.5], [32, 33, 0.6, 0.35], [31, 31, 0.6, 0.35], [31, 31, 0.4, 0.25], [29, 29, 0.4, 0.25]]
    readonly property int fitting: short ? sizes.findIndex(([point, box, apart, inside]) => tall(point, box, apart, inside) <= pane.room) : -1
    readonly property real heads: Theme.size(upright ? 40 : 38)
    // The heading of a box that is up to the visitor, and how far above it. Large texts need the room themselves.
    readonly property real tagSize: Theme.textSize > 1 ? Theme.size(28) : heads
    readonly property real tagGap: Theme.textSize > 1 ? 0 : 12 * Theme.unit
    // How far the boxes of a card keep from its edges: at its sides, and above and below.
    readonly property real inset: (upright ? 22 : 24) * Theme.unit
    readonly property real pad: (upright ? 24 : 22) * Theme.unit
    // How wide a drawing is for its letters.
    readonly property real badge: upright || !paired || Theme.textSize > 1 ? 2.1 : 2.5
    // Two points stand beside each other on a wide page, which leaves height to what there is to tick.
    readonly property bool paired: !upright && read.length === 2
    readonly property bool snug: fitting !== 0
    readonly property bool tight: fitting < 0
    readonly property var used: sizes[tight ? sizes.length - 1 : Math.min(fitting, sizes.length - 1)]
    WordWidths {
        id: widths
    }
    // About how high points and boxes are, with letters of these sizes, so many gaps apart.
    function tall(pointSize: real, boxSize: real, apart: real, inside: real): real {
        const wide = paired ? 0.5 * column - Theme.gap : column, [point, box] = [pointSize, boxSize].map(size => Math.round(Theme.size(size)))
        const points = read.map(each => Math.max(badge * point, 1.48 * point * widths.plainLines(each.text, point, wide - badge * point - Theme.gap)))
        const boxes = consent.purposes.map(purpose => 2 * inside * Theme.gap + (purpose.required ? 0 : Math.ceil(1.37 * tagSize) + 2 * tagGap) + Math.max((upright ? 76 : 64) * Theme.unit,
            lineOf(box) * widths.plainLines(purpose.text, box, column - 2 * inset - 144 * Theme.unit)))
        const needed = consent.purposes.filter(purpose => purpose.required).length
        return (paired ? Math.max(...points) : sum(points)) + sum(boxes) + 1.2 * heads + 2 * pad
            + (apart * (0.9 * (paired ? 0 : read.length - 1) + needed) + Math.min(1.6, 0.2 + apart) * (1 + consent.purposes.length - needed)) * Theme.gap
    }
    // How high a line of a box is: letters and lines have whole pixels.
    function lineOf(size: int): int {
        return Math.ceil(widths.leading * size)
    }
    function sum(heights: var): real {
        return heights.reduce((all, each) => all + each, 0)
    }

    title: consent.title
    label: words["consent-agree"]
    other: words["consent-decline"]
    way.name: "agree"
    way.even: true
    way.follows: words["consent-agree-line"]
    way.otherFollows: words["consent-decline-line"]
    way.reason: consent.toGo || way.follows
    way.otherName: "decline"
    onWent: consent.agree()
    onTurnedDown: consent.decline()
    // Those who cannot see the answers change hear of it.
    readonly property string heard: consent.toGo || words["consent-ready"]
    onHeardChanged: if (visible) home.Accessible.announce(heard, Accessible.Polite)
    onVisibleChanged: {
        whole = false
        home.focus = true
    }
    Keys.onPressed: event => pane.turn(event)

    beside: toggle
    besides: consent.points.length > 0

    // The place of a box, and how high the box alone is.
    component Purpose: Item {
        property real bare: 0
    }

    BigButton {
        id: toggle
        objectName: "read-more"
        visible: view.besides
        most: 0.45 * view.column
        // Right after the title on a wide screen, away from the steps of the visit; at the end of the line where it would
        // nearly reach that.
        readonly property real after: view.titleWidth + 40 * Theme.unit
        readonly property bool follows: !view.upright && view.titleInOneLine && after + width + 2 * Theme.gap <= view.column
        x: Theme.across(follows ? after : view.column - width, width, view.column)
        // Level with the title's letters, and above the content where it is higher than they are.
        y: Math.min(-height - Theme.gap, view.titleMiddle - height / 2)
        quiet: true
        font.pixelSize: Theme.reading
        horizontalPadding: 34 * Theme.unit
        verticalPadding: 14 * Theme.unit
        words: view.words[view.whole ? "consent-less" : "consent-more"]
        onClicked: {
            view.whole = !view.whole
            pane.rewind()
        }
    }
    FocusScope {
        id: home
        y: Math.max(0, Math.min(view.sink(height), pane.room - height))
        width: parent?.width ?? 0
        height: pane.height
        // At first at no box: the page is read from its top, and no key ticks what was not seen. Tab goes to the first.
        focus: true
        Accessible.role: Accessible.Form
        Accessible.name: view.consent.title
        ScrollPane {
            id: pane
            width: parent.width
            // The boxes keep some distance from the answers below, but where large texts need the room.
            room: view.room - Math.max(0, view.way.over - 0.5 * Theme.gap) - (Theme.textSize > 1.15 ? 0 : (view.upright && Theme.textSize <= 1 ? 1 : 0.5) * Theme.gap)
            more: view.words["scroll-more"]
            // What there is to tick stands apart from what is read, as far as the page has room.
            spacing: boxes.grouped ? boxes.apart : Math.max(0.5 * Theme.gap, Math.min((view.upright ? 3.4 : 2.2) * Theme.gap, room - (view.short ? points.height : sheet.height) - boxes.height))

            Grid {
                id: points
                visible: view.short
                width: pane.width
                // But where large texts need the room themselves.
                readonly property bool airy: Theme.textSize <= 1.3 && !view.tight
                spacing: (!airy ? 0.6 : 0.9 * view.used[2]) * Theme.gap
                columns: airy && view.paired ? 2 : 1
                columnSpacing: 2 * Theme.gap
                Repeater {
                    model: view.short ? view.read : []
                    SignedLine {
                        required property var modelData
                        width: (points.width - (points.columns - 1) * points.columnSpacing) / points.columns
                        text: modelData.text
                        sign: modelData.sign
                        badge: view.badge * size
                        size: points.airy ? Theme.size(view.used[0]) : Theme.body
                    }
                }
            }
            Rectangle {
                id: sheet
                visible: !view.short
                readonly property var texts: view.consent.paragraphs
                // Short lines are read with less effort than long ones: in two columns where there is room.
                readonly property bool halved: pane.width > 900 * Theme.unit && texts.length > 1
                readonly property int first: halved ? view.half(texts) : texts.length
                readonly property real column: halved ? (width - 4 * Theme.gap) / 2 : width - 2 * Theme.gap
                width: pane.width
                height: Math.max(left.height, halved ? right.height : 0) + 1.4 * Theme.gap
                radius: Theme.radius
                color: Theme.white
                border { color: Theme.edge; width: 2 * Theme.unit }
                Paragraphs {
                    id: left
                    x: Theme.across(Theme.gap, width, sheet.width)
                    y: 0.7 * Theme.gap
                    width: sheet.column
                    texts: sheet.texts.slice(0, sheet.first)
                    size: Theme.small
                }
                Rectangle {
                    visible: sheet.halved
                    x: (parent.width - width) / 2
                    y: 0.9 * Theme.gap
                    width: 2 * Theme.unit
                    height: parent.height - 2 * y
                    color: Theme.edge
                }
                Paragraphs {
                    id: right
                    visible: sheet.halved
                    x: Theme.across(sheet.column + 3 * Theme.gap, width, sheet.width)
                    y: 0.7 * Theme.gap
                    width: sheet.column
                    texts: sheet.texts.slice(sheet.first)
                    size: Theme.small
                }
            }
            Item {
                id: boxes
                width: pane.width
                height: stack.height
                readonly property bool needs: view.consent.purposes.some(purpose => purpose.required)
                // How many there are by now: the count changes before they are made.
                property int made: 0
                // How many come first that are needed.
                readonly property int first: {
                    const others = view.consent.purposes.findIndex(purpose => !purpose.required)
                    return others < 0 ? view.consent.purposes.length : others
                }
                // Whether those that are needed share a card, as the answers to a question do, and not a word at each box: if
                // all of them come first, and where the page has room.
                readonly property bool grouped: needs && view.short && points.airy && view.consent.purposes.every((purpose, index) => !purpose.required || index < first)
                // With a capital letter, as a line of its own.
                readonly property string optional: view.words["consent-optional"].charAt(0).toUpperCase() + view.words["consent-optional"].slice(1)
                readonly property real inset: grouped ? view.inset : 0
                // What the page has left for the distance between cards.
                readonly property real free: {
                    let left = pane.room - points.height - (grouped ? 2 * view.pad + heading.height : 0)
                    for (let i = 0; i < made; i++)
                        left -= ((purposes.itemAt(i) as Purpose)?.bare ?? 0) + (i < first ? stack.spacing : 0)
                    return left
                }
                readonly property int gaps: grouped ? 1 + made - first : 1
                // Words about a box that is missed may take of it.
                readonly property real apart: grouped ? Math.max((view.consent.missing.length > 0 ? 0.25 : 0.5) * Theme.gap, Math.min(1.7 * Theme.gap, free / gaps)) : stack.spacing
                // How high the card is.
                readonly property real closes: {
                    const last = made >= first ? purposes.itemAt(first - 1) : null
                    return last ? last.y + last.height + view.pad : 0
                }

                Rectangle {
                    objectName: "consent-card"
                    visible: boxes.grouped
                    width: parent.width
                    height: boxes.closes
                    radius: Theme.radius
                    color: Theme.white
                    border { color: Theme.edge; width: 3 * Theme.unit }
                    Rectangle {
                        objectName: "consent-due"
                        anchors.fill: parent
                        radius: parent.radius
                        color: "transparent"
                        // All edges are dark with high contrast.
                        border { color: Theme.sea; width: (Theme.highContrast ? 7 : 4) * Theme.unit }
                        opacity: view.consent.toGo !== "" ? 1 : 0
                        Behavior on opacity { NumberAnimation { duration: Theme.motion } }
                    }
                }
                Column {
                    id: stack
                    width: parent.width
                    topPadding: boxes.grouped ? view.pad - 0.2 * view.heads : 0
                    bottomPadding: boxes.grouped && boxes.first === boxes.made ? view.pad : 0
                    spacing: (points.airy && view.short ? view.used[2] : Theme.textSize <= 1.15 ? 0.5 : 0.4) * Theme.gap
                    PlainText {
                        id: heading
                        objectName: "consent-needed"
                        FontMetrics {
                            id: letters
                            font: heading.font
                        }
                        visible: boxes.grouped
                        x: boxes.inset
                        width: boxes.width - 2 * x
                        height: Math.ceil(letters.height)
                        text: view.consent.toGo || view.words["consent-needed"]
                        font { pixelSize: view.heads; bold: true }
                        fontSizeMode: Text.HorizontalFit
                        minimumPixelSize: Theme.size(24)
                        verticalAlignment: Text.AlignVCenter
                    }
                    Repeater {
                        id: purposes
                        model: view.consent.purposes
                        onItemAdded: boxes.made++
                        onItemRemoved: boxes.made--
                        Purpose {
                            id: purpose
                            bare: tick.height
                            required property var modelData
                            required property int index
                            readonly property bool inside: boxes.grouped && index < boxes.first
                            // How much further from the one above it than others are.
                            readonly property real above: !boxes.grouped || inside ? 0 : boxes.apart - stack.spacing + (index === boxes.first ? view.pad : 0)
                            width: boxes.width
                            height: tick.y + tick.height
                            TickBox {
                                id: tick
                                objectName: "purpose-" + purpose.modelData.id
                                x: purpose.inside ? boxes.inset : 0
                                y: purpose.above
                                width: parent.width - 2 * x
                                large: points.airy && view.short
                                broad: large && view.upright && !view.snug
                                // All marks stand below each other.
                                horizontalPadding: (large ? 28 : 17) * Theme.unit + (boxes.grouped && !purpose.inside ? boxes.inset : 0)
                                font.pixelSize: !large ? Theme.reading : Theme.size(view.used[1])
                                roomy: view.upright
                                bottomPadding: verticalPadding + (tagged ? view.tagGap : 0)
                                verticalPadding: (large ? (purpose.inside ? 0.85 : 1) * view.used[3] : view.short ? 0.25 : 0.45) * Theme.gap
                                words: purpose.modelData.text
                                needed: purpose.modelData.required
                                headed: purpose.inside
                                tagged: boxes.grouped && !purpose.inside
                                tagSize: view.tagSize
                                tagGap: view.tagGap
                                outdent: 28 * Theme.unit
                                lighter: !purpose.modelData.required && boxes.needs
                                on: view.consent.ticks.includes(purpose.modelData.id)
                                note: tagged ? boxes.optional : view.words[purpose.modelData.required ? "consent-required" : "consent-optional"]
                                agreed: tagged ? "" : view.words["consent-agreed"]
                                warning: view.consent.missing.includes(purpose.modelData.id) ? view.words["consent-missing"] : ""
                                // The first one of a card says so for all of them.
                                terse: purpose.inside && view.consent.missing[0] !== purpose.modelData.id
                                onClicked: view.consent.tick(purpose.modelData.id, !on)
                            }
                            Connections {
                                target: view.consent
                                function onMissed(missed: string) {
                                    if (missed !== purpose.modelData.id)
                                        return
                                    tick.forceActiveFocus(Qt.TabFocusReason)
                                    pane.reveal(tick)
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
