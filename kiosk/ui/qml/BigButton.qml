// A button that is hard to miss: large, and the same by mouse, touch and keyboard.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import "."

Button {
    id: button

    // What it says, and to those who cannot see it too. Not its text: "&" in that makes a shortcut of the letter behind.
    required property string words
    // How wide it may be at most; its words then take more lines.
    property real most: Infinity
    // And at least, with few words.
    property real least: 0
    property bool quiet: false
    // A quiet one that is the way on, once what the page asks for is done: it looks at rest until then, unlike all that can be chosen.
    property bool waits: false
    // A few words more, such as why it waits: after the words, where it is wide enough. Both are one group in its middle.
    property string note: ""
    // How far it is from the words there.
    readonly property real apart: 0.8 * Theme.gap
    readonly property bool noteBeside: note !== "" && measure.advanceWidth + apart + noted.advanceWidth + 2.4 * Theme.gap <= width
    // What follows from it, in smaller letters below its words, and on how many lines.
    property string under: ""
    property real underSize: Theme.small
    property int underLines: 1
    // Before that line, if it is one: how many boxes are to be ticked first, and how many of them are.
    property int boxes: 0
    property int ticked: 0
    readonly property real boxSide: Math.round(0.8 * underSize)
    readonly property real boxesWide: boxes * (boxSide + 8 * Theme.unit) + 6 * Theme.unit
    readonly property bool boxed: boxes > 0 && underLines === 1 && underMeasure.advanceWidth + boxesWide <= width - 2 * Theme.gap
    readonly property real underTall: under === "" ? 0 : Math.ceil(1.37 * underLines * underSize)
    // A sign that tells it from its neighbour at a glance; none without. It stands above its words, or before them.
    property string sign: ""
    property real signSize: 0
    property bool signAbove: true
    readonly property real signTall: sign !== "" && signAbove ? signSize + 0.5 * Theme.gap : 0
    readonly property real signBroad: sign !== "" && !signAbove ? signSize + 0.7 * Theme.gap : 0
    // How round it is at most.
    property real corner: Infinity
    property real letters: Theme.onButtons
    // How wide its words need it, within a pixel or two. Measured apart: where what lays a text out depends on the text's own
    // size, lines get lost.
    readonly property real wish: Math.max(least, needed)
    readonly property real needed: Math.ceil(measure.advanceWidth) + 2 + 2 * horizontalPadding

    width: Math.min(wish, most)
    Accessible.name: words
    focusPolicy: Qt.StrongFocus
    horizontalPadding: 56 * Theme.unit
    // How high it is with one line of words: larger letters take from the air above and below them.
    property real tall: 52 * Theme.unit + 1.36 * Theme.body
    readonly property alias line: lines.height
    verticalPadding: (tall - Math.ceil(line)) / 2
    leftPadding: horizontalPadding + (Theme.mirrored ? 0 : signBroad)
    rightPadding: horizontalPadding + (Theme.mirrored ? signBroad : 0)
    topPadding: verticalPadding + signTall
    bottomPadding: verticalPadding + underTall + (under === "" ? 0 : 4 * Theme.unit)
    font.pixelSize: letters
    font.bold: true
    scale: down ? 0.96 : 1
    // Where there is no other stop, Tab still shows this one.
    Keys.onTabPressed: event => {
        Theme.byKeyboard = true
        event.accepted = false
    }
    // A key that is held down is one click.
    onClicked: Theme.clicked()
    Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }

    FontMetrics {
        id: lines
        font: button.font
    }
    TextMetrics {
        id: measure
        font: button.font
        text: button.words
    }
    TextMetrics {
        id: underMeasure
        font.pixelSize: button.underSize
        text: button.under
    }
    TextMetrics {
        id: noted
        font.pixelSize: Theme.size(32)
        text: button.note
    }
    contentItem: Text {
        transform: Translate {
            x: button.noteBeside ? -Theme.ahead * (button.apart + noted.advanceWidth) / 2 : 0
        }
        textFormat: Text.PlainText
        text: button.words
        font: button.font
        color: !button.quiet ? Theme.white : button.waits ? Theme.faintInk : Theme.sea
        horizontalAlignment: Text.AlignHCenter
        verticalAlignment: Text.AlignVCenter
        // Not where it fits: a width less the paddings can lack the last fraction of what the words need.
        wrapMode: button.width < button.needed + button.signBroad - 2 ? Text.Wrap : Text.NoWrap
    }
    Loader {
        readonly property real before: Math.max(button.horizontalPadding, (button.width - button.signBroad - measure.advanceWidth) / 2)
        active: button.sign !== ""
        x: button.signAbove ? (button.width - button.signSize) / 2 : Theme.across(before, button.signSize, button.width)
        y: button.signAbove ? button.verticalPadding : (button.height - button.signSize) / 2
        sourceComponent: Sign {
            width: button.signSize
            sign: button.sign
            reach: 37
        }
    }
    Text {
        objectName: "note"
        x: Theme.across((parent.width + measure.advanceWidth + button.apart - noted.advanceWidth) / 2, width, parent.width)
        width: Math.ceil(noted.advanceWidth) + 2
        // On one line with the words.
        y: (parent.height - height) / 2 + 0.39 * (button.letters - noted.font.pixelSize)
        visible: button.noteBeside
        height: button.note === "" ? 0 : Math.ceil(1.37 * noted.font.pixelSize)
        textFormat: Text.PlainText
        text: button.note
        font.pixelSize: noted.font.pixelSize
        horizontalAlignment: Text.AlignHCenter
        color: button.waits ? Theme.faintInk : button.quiet ? Theme.sea : Theme.white
        Accessible.ignored: true
    }
    Row {
        x: Theme.across((parent.width - button.boxesWide - underMeasure.advanceWidth) / 2, width, parent.width)
        y: underLine.y + (underLine.height - height) / 2
        visible: button.boxed
        spacing: 8 * Theme.unit
        Repeater {
            model: button.boxed ? button.boxes : 0
            Rectangle {
                required property int index
                objectName: "box"
                width: button.boxSide
                height: width
                radius: 0.2 * width
                color: index < button.ticked ? Theme.white : "transparent"
                border { color: Theme.white; width: 3 * Theme.unit }
            }
        }
    }
    Text {
        id: underLine
        objectName: "under"
        x: (parent.width - width) / 2 + (button.boxed ? Theme.ahead * button.boxesWide / 2 : 0)
        y: parent.height - button.verticalPadding - height
        width: parent.width - 2 * Theme.gap
        height: button.underTall
        visible: button.under !== ""
        textFormat: Text.PlainText
        text: button.under
        font.pixelSize: button.underSize
        wrapMode: button.underLines > 1 ? Text.Wrap : Text.NoWrap
        horizontalAlignment: Text.AlignHCenter
        verticalAlignment: Text.AlignVCenter
        color: Theme.white
        Accessible.ignored: true
    }
    background: Rectangle {
        id: ground
        radius: Math.min(height / 2, button.topPadding + button.font.pixelSize, button.corner)
        color: button.waits ? Theme.resting : button.quiet ? "transparent" : button.hovered ? Theme.lightSea : Theme.sea
        // Without an edge it looks at rest. With high contrast the edge is all that shows where it is.
        border.color: button.waits ? Theme.slot : Theme.shy
        border.width: button.waits && !Theme.highContrast ? 0 : button.quiet || button.waits ? 3 * Theme.unit : 0
        FocusRing {
            around: button
            radius: ground.radius + reach
        }
    }
}
