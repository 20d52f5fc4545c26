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

    // The page has the largest letters with which points and boxes are all seen at once: in both, how many gaps are above and
    // below the words of a box, and how many between boxes. Whether even the smallest are too large.
    readonly property bool upright: width < height
    readonly property var sizes: upright ? [[38, 1, 1], [38, 0.9, 0.9], [37, 0.75, 0.8], [36, 0.6, 0.7], [36, 0.45, 0.6], [34, 0.4, 0.5], [33, 0.35, 0.5], [31, 0.3, 0.4], [29, 0.25, 0.4]]
        : [[38, 1, 0.9], [36, 1, 0.8], [35, 0.85, 0.7], [34, 0.7, 0.65], [34, 0.5, 0.6], [32, 0.4, 0.5], [31, 0.3, 0.4], [29, 0.25, 0.4]]
    readonly property int fitting: short ? sizes.findIndex(([letters, inside, apart]) => tall(letters, inside, apart) <= pane.room) : -1
    readonly property bool tight: fitting < 0
    readonly property var used: sizes[tight ? sizes.length - 1 : Math.min(fitting, sizes.length - 1)]
    // Large texts need the room themselves.
    readonly property real heads: Theme.size(Theme.textSize > 1.15 ? 38 : upright ? 46 : 44)
    readonly property real pointSize: Theme.size(pointLetters(used[0]))
    readonly property real between: used[2] * Theme.gap
    readonly property real leastGap: (Theme.textSize > 1.15 ? 0.4 : upright ? 0.8 : 0.7) * Theme.gap
    // What the page has left parts the points first, unless boxes may need it to say that they are missed.
    readonly property real spare: carded ? Math.max(0, pane.room - tall(...used)) : 0
    readonly property real pointGap: leastGap + Math.min(0.6 * Theme.gap, 0.4 * spare / Math.max(1, read.length))
    // How wide a drawing is for its letters.
    readonly property real badge: 1.7
    readonly property int needed: consent.purposes.filter(purpose => purpose.required).length
    // Where the page has room, points and boxes have large letters. Headings over the boxes then say which are needed, and
    // not a word at each: if those come first.
    readonly property bool roomy: short && !tight && Theme.textSize <= 1.3
    readonly property bool grouped: roomy && consent.purposes.every((purpose, index) => !purpose.required || index < needed)
    WordWidths {
        id: widths
    }
    // Without boxes that are needed, the points have a card of their own: how far they are from its edges.
    readonly property bool carded: short && needed === 0 && Theme.textSize <= 1.15
    readonly property real inset: carded ? 24 * Theme.unit : 0
    readonly property real padding: carded ? 1.1 * Theme.gap : 0
    // How high what opens all of the text is below the points.
    readonly property real asked: besides ? 0 : leastGap + 0.4 * Theme.gap + 1.37 * Theme.reading + 28 * Theme.unit
    // About how high points and boxes are, with letters of these sizes and so many gaps.
    function tall(letters: real, inside: real, apart: real): real {
        const size = Math.round(Theme.size(letters)), pointSize = Math.round(Theme.size(pointLetters(letters))), count = consent.purposes.length
        const points = read.map(each => Math.max(badge * pointSize, 1.48 * pointSize * linesOf(each.text, pointSize)))
        const boxes = consent.purposes.map(purpose => 2 * inside * Theme.gap + Math.max(64 * Theme.unit,
            lineOf(size) * widths.plainLines(purpose.text, size, column - 136 * Theme.unit)))
        return sum(points) + 2 * padding + (read.length - 1) * leastGap + asked + (needed > 0 ? Theme.gap + 1.37 * heads : 0)
            + sum(boxes) + count * apart * Theme.gap + (count - needed) * Math.ceil(1.37 * size)
    }
    // On how many lines a point stands.
    function linesOf(text: string, size: int): int {
        return widths.plainLines(text, size, column - 2 * inset - badge * size - apart(badge * size))
    }
    // Words stand above the words of the boxes: how far they are from a drawing that is so wide.
    function apart(drawing: real): real {
        return Math.max(0.9 * Theme.gap, 88 * Theme.unit + 0.9 * Theme.gap - inset - drawing)
    }
    // Points have the letters of the boxes, or somewhat smaller ones where these spare them a line: much smaller ones only
    // where the page needs it.
    function pointLetters(letters: real): real {
        const lines = less => sum(read.map(each => linesOf(each.text, Math.round(Theme.size(letters - less)))))
        const tried = (carded && !upright ? [0, 1, 2, 3, 4] : [0, 1, 2, 3, 4, 5, 6, 7]).map(lines), least = Math.min(...tried)
        return letters - tried.indexOf(least)
    }
    // How high a line of a box is: letters and lines have whole pixels.
    function lineOf(size: int): int {
        return Math.ceil(widths.leading * size)
    }
    function sum(heights: var): real {
        return heights.reduce((all, each) => all + each, 0)
    }

    title: consent.title
    // A title that nearly leaves the button beside it its line does so with letters a little smaller.
    titleSize: {
        const fits = Theme.pageTitle * (column - (besides ? titled.width + 1.2 * Theme.gap : 0)) / Math.max(1, widths.bold(title, Theme.pageTitle))
        return besides && fits >= 0.65 * Theme.pageTitle ? Math.min(Theme.pageTitle, Math.floor(fits)) : Theme.pageTitle
    }
    label: words["consent-agree"]
    other: words["consent-decline"]
    way.name: "agree"
    way.even: true
    // Both answers look the same at all times. What one of them still needs is said within it.
    way.follows: consent.toGoLine || way.later
    way.boxes: consent.toGo === "" ? 0 : needed
    way.ticked: consent.purposes.filter(purpose => purpose.required && consent.ticks.includes(purpose.id)).length
    way.later: words["consent-agree-line"]
    way.otherFollows: words["consent-decline-line"]
    way.reason: way.follows
    way.otherName: "decline"
    onWent: consent.agree()
    onTurnedDown: consent.decline()
    // Those who cannot see the heading change hear of it.
    readonly property string heard: consent.toGo || words["consent-ready"]
    onHeardChanged: if (visible && needed > 0) home.Accessible.announce(heard, Accessible.Polite)
    onVisibleChanged: {
        whole = false
        home.focus = true
    }
    Keys.onPressed: event => pane.turn(event)

    // All of the text is asked for where what stands for it ends; with large letters, which need that room, at the title.
    beside: titled
    besides: consent.points.length > 0 && Theme.textSize > 1.15
    Component {
        id: more
        BigButton {
            objectName: "read-more"
            most: 0.45 * view.column
            quiet: true
            font.pixelSize: Theme.reading
            horizontalPadding: 34 * Theme.unit
            verticalPadding: 14 * Theme.unit
            // As wide whichever it says: the title beside it keeps its lines, and what is pressed its place.
            least: Math.ceil(Math.max(...["consent-more", "consent-less"].map(name => widths.bold(view.words[name], font.pixelSize)))) + 2 + 2 * horizontalPadding
            words: view.words[view.whole ? "consent-less" : "consent-more"]
            onClicked: {
                view.whole = !view.whole
                pane.rewind()
            }
        }
    }
    Loader {
        id: titled
        active: view.besides
        x: Theme.across(view.column - width, width, view.column)
        // Level with the title's letters, and above the content where it is higher than they are.
        y: Math.min(-height - Theme.gap, view.titleMiddle - height / 2)
        sourceComponent: more
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
            spacing: Math.max((view.consent.missing.length > 0 ? 0.4 : 0.5) * Theme.gap, Math.min((view.roomy ? 2 : view.upright ? 3.4 : 2.2) * Theme.gap, room - told.height - boxes.height))

            Item {
                id: told
                width: pane.width
                height: lines.height + 2 * view.padding
                Rectangle {
                    visible: view.carded
                    anchors.fill: parent
                    radius: Theme.radius
                    color: Theme.white
                    border { color: Theme.edge; width: 2 * Theme.unit }
                }
                Column {
                    id: lines
                    x: view.inset
                    y: view.padding
                    width: parent.width - 2 * x
                    spacing: view.pointGap
                    Repeater {
                        model: view.short ? view.read : []
                        SignedLine {
                            required property var modelData
                            width: lines.width
                            text: modelData.text
                            sign: modelData.sign
                            badge: (view.roomy ? view.badge : 2.1) * size
                            apart: view.roomy ? view.apart(badge) : Theme.gap
                            size: view.roomy ? view.pointSize : Theme.body
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
                        visible: seated.active
                        width: lines.width
                        height: seated.y + seated.height
                        Loader {
                            id: seated
                            // It begins where the words do, a little apart from the last of them.
                            readonly property real indent: view.short && view.roomy ? view.badge * view.pointSize + view.apart(view.badge * view.pointSize) : 0
                            active: view.consent.points.length > 0 && !view.besides
                            x: Theme.across(indent, width, lines.width)
                            y: view.roomy ? 0.4 * Theme.gap : 0
                            sourceComponent: more
                        }
                    }
                }
            }
            Item {
                id: boxes
                width: pane.width
                height: stack.height
                // With a capital letter, as it stands alone.
                readonly property string optional: view.words["consent-optional"].charAt(0).toUpperCase() + view.words["consent-optional"].slice(1)

                Column {
                    id: stack
                    width: parent.width
                    spacing: view.roomy ? view.between : (Theme.textSize <= 1.15 ? 0.5 : 0.4) * Theme.gap
                    PlainText {
                        objectName: "consent-needed"
                        visible: view.grouped && view.needed > 0
                        width: parent.width
                        height: Math.ceil(1.37 * view.heads)
                        text: view.heard
                        font { pixelSize: view.heads; bold: true }
                        fontSizeMode: Text.HorizontalFit
                        minimumPixelSize: Theme.size(24)
                        verticalAlignment: Text.AlignVCenter
                    }
                    Repeater {
                        model: view.consent.purposes
                        TickBox {
                            id: tick
                            required property var modelData
                            objectName: "purpose-" + modelData.id
                            width: stack.width
                            large: view.roomy
                            // On a wide page, what need not be ticked is no larger than what is to be read.
                            font.pixelSize: !large ? Theme.reading : view.carded && !view.upright ? Math.min(Theme.size(view.used[0]), view.pointSize) : Theme.size(view.used[0])
                            horizontalPadding: (large ? 24 : 17) * Theme.unit
                            verticalPadding: (large ? view.used[1] : view.short ? 0.25 : 0.45) * Theme.gap
                            words: modelData.text
                            needed: modelData.required
                            headed: view.grouped
                            on: view.consent.ticks.includes(modelData.id)
                            note: headed && !needed ? boxes.optional : view.words[needed ? "consent-required" : "consent-optional"]
                            agreed: headed ? "" : view.words["consent-agreed"]
                            warning: view.consent.missing.includes(modelData.id) ? view.words["consent-missing"] : ""
                            // The first one of a card says so for all of them.
                            terse: headed && view.consent.missing[0] !== modelData.id
                            onClicked: view.consent.tick(modelData.id, !on)
                            Connections {
                                target: view.consent
                                function onMissed(missed: string) {
                                    if (missed !== tick.modelData.id)
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
