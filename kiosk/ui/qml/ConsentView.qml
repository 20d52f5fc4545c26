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
    readonly property var sizes: upright ? [[38, 36, 1, 0.8], [38, 36, 0.7, 0.6], [36, 36, 0.6, 0.5], [36, 36, 0.4, 0.35], [34, 33, 0.6, 0.4], [34, 33, 0.4, 0.35], [32, 31, 0.4, 0.25]]
        : [[34, 33, 0.9, 0.8], [34, 33, 0.9, 0.5], [34, 33, 0.6, 0.35], [32, 31, 0.6, 0.35], [32, 31, 0.4, 0.25], [30, 29, 0.4, 0.25]]
    readonly property int fitting: short ? sizes.findIndex(([point, box, apart, inside]) => tall(point, box, apart, inside) <= pane.room) : -1
    // How far a heading keeps from what is above it, of which its own line has a part above its letters.
    readonly property real clear: (upright ? 48 : 36) * Theme.unit - 0.3 * Theme.size(36)
    readonly property real heads: Theme.size(upright ? 38 : Math.min(36, used[0] + 2))
    // How wide a drawing is for its letters.
    readonly property real badge: upright || !paired || Theme.textSize > 1 ? 2.1 : 2.5
    // Two points stand beside each other on a wide page, which leaves height to what there is to tick.
    readonly property bool paired: !upright && read.length === 2
    readonly property bool snug: fitting !== 0
    readonly property bool tight: fitting < 0
    readonly property var used: sizes[tight ? sizes.length - 1 : Math.min(fitting, sizes.length - 1)]
    FontMetrics {
        id: measure
        font.pixelSize: 100
    }
    // About how high points and boxes are, with letters of these sizes, so many gaps apart.
    function tall(pointSize: real, boxSize: real, apart: real, inside: real): real {
        const wide = paired ? 0.5 * column - Theme.gap : column
        const points = read.map(point => Math.max(badge * pointSize, 1.48 * pointSize * lines(point.text, pointSize, badge * pointSize + 24, wide)))
        const boxes = consent.purposes.reduce((sum, purpose) => sum + Math.max((upright ? 76 : 64) / Theme.textSize, 1.37 * boxSize * lines(purpose.text, boxSize, 64 + 3 * 28, column)), 0)
        return Theme.size((paired ? Math.max(...points) : points.reduce((sum, point) => sum + point, 0)) + boxes) + 2 * (1.37 * Theme.size(upright ? 38 : 36) + clear)
            + (apart * (0.9 * (paired ? 0 : read.length - 1) + consent.purposes.length) + 2 * inside * consent.purposes.length) * Theme.gap
    }
    // On how many lines a text is in so much width that leaves so much of it to something else.
    function lines(text: string, size: real, taken: real, wide: real): int {
        return Math.ceil(1.05 * measure.advanceWidth(text) * size / 100 / (wide / Theme.unit / Math.max(1, Theme.textSize) - taken))
    }

    title: consent.title
    label: words["consent-agree"]
    other: words["consent-decline"]
    way.name: "agree"
    way.even: true
    way.reason: consent.toGo
    way.otherName: "decline"
    onWent: consent.agree()
    onTurnedDown: consent.decline()
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
            room: view.room - Math.max(0, view.way.over - 0.5 * Theme.gap) - (Theme.textSize > 1.15 ? 0 : (view.upright && Theme.textSize <= 1 ? 1.5 : 0.5) * Theme.gap)
            more: view.words["scroll-more"]
            // What there is to tick stands apart from what is read, as far as the page has room.
            spacing: view.upright && boxes.grouped ? boxes.before : Math.max(0.5 * Theme.gap, Math.min((view.upright ? 3.4 : 2.2) * Theme.gap, room - (view.short ? points.height : sheet.height) - boxes.height))

            Grid {
                id: points
                visible: view.short
                width: pane.width
                // But where large texts need the room themselves.
                readonly property bool airy: Theme.textSize <= 1.15 && !view.tight
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
            Column {
                id: boxes
                width: pane.width
                readonly property bool needs: view.consent.purposes.some(purpose => purpose.required)
                // Whether a heading stands over each group, and not a word at each box: if all that are needed come first, and
                // where the page has room.
                readonly property bool grouped: needs && view.short && points.airy && view.consent.purposes.every((purpose, index, all) => purpose.required || !all.slice(index).some(other => other.required))
                // With a capital letter, as a heading.
                readonly property string optional: view.words["consent-optional"].charAt(0).toUpperCase() + view.words["consent-optional"].slice(1)
                readonly property bool parted: grouped && view.consent.purposes.some(purpose => !purpose.required)
                // What the page has left for distances before its headings.
                readonly property real free: {
                    let left = pane.room - points.height - (parted ? 2 : 1) * waits.height
                    for (let i = 0; i < purposes.count; i++)
                        left -= ((purposes.itemAt(i) as Purpose)?.bare ?? 0) + spacing
                    return left
                }
                // The same before both headings of an upright page.
                readonly property real before: Math.max(0.5 * Theme.gap, Math.min(2.4 * Theme.gap, parted ? 0.5 * (free + (1 - below) * spacing) : free))
                // How many of the distances between boxes are between the second heading and its box.
                readonly property real below: view.upright ? 0.7 : 1
                // How much further apart stands what is not needed, as far as the page has room.
                readonly property real further: !view.short || !points.airy ? 0 : view.upright && parted ? Math.max(0, before - spacing)
                    : Math.max(0, Math.min((view.upright ? 1.3 : points.columns > 1 ? 1 : 0.5) * Theme.gap, free - 1.6 * Theme.gap - (parted ? spacing : 0)))
                spacing: (points.airy && view.short ? view.used[2] : Theme.textSize <= 1.15 ? 0.5 : 0.4) * Theme.gap
                // What is still to be ticked, or that there is a choice now.
                PlainText {
                    id: waits
                    objectName: "consent-waits"
                    FontMetrics {
                        id: letters
                        font: waits.font
                    }
                    visible: boxes.needs
                    width: boxes.width
                    height: Math.ceil(letters.height)
                    text: view.consent.toGo || view.words["consent-ready"]
                    onTextChanged: if (visible) Accessible.announce(waits.text, Accessible.Polite)
                    font { pixelSize: points.airy && view.short ? view.heads : Theme.reading; bold: true }
                    fontSizeMode: Text.HorizontalFit
                    minimumPixelSize: Theme.size(24)
                    verticalAlignment: Text.AlignVCenter
                }
                Repeater {
                    id: purposes
                    model: view.consent.purposes
                    Purpose {
                        id: purpose
                        bare: tick.height
                        required property var modelData
                        required property int index
                        // Whether it is the first one below all that are needed.
                        readonly property bool apart: (view.consent.purposes[index - 1]?.required ?? false)
                            && view.consent.purposes.slice(index).every(other => !other.required)
                        width: boxes.width
                        height: tick.y + tick.height
                        PlainText {
                            id: group
                            objectName: "consent-optional"
                            visible: purpose.apart && boxes.grouped
                            y: boxes.further
                            width: parent.width
                            height: visible ? waits.height : 0
                            text: boxes.optional
                            font: waits.font
                            fontSizeMode: Text.HorizontalFit
                            minimumPixelSize: Theme.size(24)
                            verticalAlignment: Text.AlignVCenter
                        }
                        TickBox {
                            id: tick
                            objectName: "purpose-" + purpose.modelData.id
                            y: group.visible ? group.y + group.height + boxes.below * boxes.spacing : purpose.apart ? boxes.further : 0
                            width: parent.width
                            large: points.airy && view.short
                            broad: large && view.upright && !view.snug
                            font.pixelSize: !large ? Theme.reading : Theme.size(view.used[1])
                            roomy: view.upright
                            verticalPadding: (large ? view.used[3] : view.short ? 0.25 : 0.45) * Theme.gap
                            words: purpose.modelData.text
                            needed: purpose.modelData.required
                            headed: boxes.grouped
                            lighter: !purpose.modelData.required && boxes.needs
                            on: view.consent.ticks.includes(purpose.modelData.id)
                            note: view.words[purpose.modelData.required ? "consent-required" : "consent-optional"]
                            agreed: view.words["consent-agreed"]
                            warning: view.consent.missing.includes(purpose.modelData.id) ? view.words["consent-missing"] : ""
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
