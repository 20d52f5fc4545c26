// Keys for a booth without a keyboard. They type into the field that they are told, keep no text, and move nothing: a
// number's stand beside it, and letters at the bottom.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import QtQuick.Shapes
import Recollect
import ".."

Rectangle {
    id: keyboard

    property TypedField field: null
    // What the field belongs to.
    property FormItem card: null
    required property FormScreen form
    required property var words
    // Where a number's keys stand, and how much room they have.
    required property KeyPlace where
    readonly property point place: where.at(width, height, grand)
    // How far they are from the cards.
    readonly property real away: where.awayFrom(x, width)
    signal done()

    // A keyboard is not turned round with the page.
    LayoutMirroring.enabled: false
    LayoutMirroring.childrenInherit: true

    property bool capitals: false
    property string shown: "letters"
    readonly property bool numbers: field !== null && field.digits
    // Whether a number's keys stand in rows of three across an upright screen's width, or in two rows where height lacks.
    readonly property bool grand: numbers && broad && where.open >= 544 * Theme.unit
    readonly property bool flat: numbers && broad && !grand && !field?.minus
    readonly property bool wideKeys: grand || numbers && roomy
    // Whether the word that ends typing has room beside the 0, as on a telephone's keys.
    readonly property bool ends: wideKeys && !field?.minus && ending.width + 28 * Theme.unit <= keyWidth
    readonly property var rows: flat ? ["12345", "67890"] : numbers ? ["123", "456", "789", ends ? "⌫0✓" : `${field?.minus ? "-" : ""}0⌫`] : form.keys[shown]
    // Not from the rows of a number, which depend on how wide its keys are.
    readonly property int longest: numbers ? 10 : Math.max(10, ...form.keys[shown].map(row => row.length))
    readonly property real gap: (grand ? 20 : wideKeys && !field?.minus ? 16 : wideKeys || flat ? 12 : 8) * Theme.unit
    // How far the keys are from the edge that is drawn around a number's.
    readonly property real margin: wideKeys ? gap + border.width : flat ? 16 * Theme.unit : 0.6 * Theme.gap
    readonly property real room: parent.width
    // Whether a number's keys have an upright page's width.
    readonly property bool broad: parent.width < parent.height
    // Or a wide screen's margin beside it.
    readonly property bool roomy: Window.width - parent.width >= 440 * Theme.unit
    readonly property real keyWidth: numbers ? flat ? fitting(where.spare - 190 * Theme.unit - gap, 5, 90, 160)
        : grand ? fitting(where.spare, 3, 108, 420) : broad ? 150 * Theme.unit : roomy ? fitting(where.spare, 3, 108, 160) : 80 * Theme.unit : Math.min(96 * Theme.unit, (room - 2 * Theme.gap - longest * gap) / longest)
    readonly property real keyHeight: grand ? Math.min(270 * Theme.unit, Math.floor((tall - 2 * margin + gap) / (ends ? 4 : 5) - gap))
        : (numbers ? (flat ? 140 : roomy ? (ends ? 82 : 64) : 68) : 60) * Theme.unit
    // How high large keys are with their edge: they end where the cards do, and cut none of these.
    readonly property real tall: Math.min(where.open, Math.max(where.covers, 684 * Theme.unit))
    // How large the words of a number's keys are.
    readonly property real wording: grand ? Theme.size(48) : flat ? Theme.size(42) : Theme.body
    TextMetrics {
        id: ending
        font { pixelSize: keyboard.wording; bold: true }
        text: keyboard.words["keyboard-done"]
    }

    // Whether they point at their field, at one side of it.
    readonly property bool points: numbers && (broad ? where.aim.x > x + radius + 36 * Theme.unit && where.aim.x < x + width - radius - 36 * Theme.unit
        : (x >= parent.width || x < 0) && where.aim.y > y + radius + 24 * Theme.unit && where.aim.y < y + height - radius - 24 * Theme.unit)

    // How wide so many keys in a row are in this room, within these units.
    function fitting(wide: real, many: int, least: real, most: real): real {
        const each = (wide - 2 * margin - (many - 1) * gap) / many
        return Math.floor(Math.max(least * Theme.unit, Math.min(most * Theme.unit, each)))
    }

    width: grand ? Math.max(where.spare, keys.width + 2 * margin) : numbers ? keys.width + 2 * margin : parent.width
    height: grand && keyHeight < 270 * Theme.unit ? tall : keys.height + 2 * margin
    x: numbers ? place.x : 0
    y: numbers ? place.y : parent.height - height
    radius: numbers ? Theme.radius : 0
    // A number's look like what the helper says.
    color: numbers ? Theme.white : Theme.sand
    border { color: Theme.sea; width: numbers ? 4 * Theme.unit : 0 }
    visible: field !== null
    onFieldChanged: {
        capitals = false
        shown = "letters"
    }

    // Between the keys nothing happens, and nothing below is reached.
    MouseArea { anchors.fill: parent; Accessible.ignored: true }

    // Not named Key: outside of QML, that name belongs to something else.
    component ScreenKey: AbstractButton {
        id: key
        required property string words
        property bool pressedIn: false
        // Whether it has the drawing of a key that deletes instead of its word.
        property bool drawn: false
        Accessible.name: words
        focusPolicy: Qt.NoFocus
        autoRepeat: objectName === "key-delete"
        readonly property real usualWidth: drawn || keyboard.numbers ? keyboard.keyWidth : Math.max(keyboard.keyWidth, implicitWidth)
        width: usualWidth
        height: keyboard.keyHeight
        horizontalPadding: (keyboard.longest > 11 && words.length === 1 ? 2 : 14) * Theme.unit
        scale: down ? 0.94 : 1
        contentItem: Text {
            textFormat: Text.PlainText
            text: key.drawn ? "" : key.words
            // Digits are looked for, and larger than words.
            readonly property bool digit: keyboard.numbers && !key.pressedIn
            font { pixelSize: Math.min(digit ? Theme.size(keyboard.grand ? 76 : keyboard.flat ? 60 : 42) : keyboard.wording, 0.56 * keyboard.keyHeight); bold: key.pressedIn || digit }
            color: key.pressedIn ? Theme.white : Theme.ink
            horizontalAlignment: Text.AlignHCenter
            verticalAlignment: Text.AlignVCenter
        }
        background: Rectangle {
            radius: (keyboard.numbers ? 16 : 10) * Theme.unit
            color: key.pressedIn ? Theme.sea : keyboard.numbers ? Theme.touchable : Theme.white
            border { color: key.hovered || keyboard.numbers ? Theme.sea : Theme.edge; width: (key.hovered && keyboard.numbers ? 4 : 2) * Theme.unit }
            Backspace {
                visible: key.drawn
                anchors.centerIn: parent
                scale: (keyboard.grand ? 3.8 : keyboard.flat ? 3 : keyboard.numbers ? 2.1 : 1.5) * Theme.unit
            }
        }
    }
    component LayerKey: ScreenKey {
        id: key
        required property string leads
        objectName: `key-${leads}`
        visible: !keyboard.numbers && keyboard.shown !== leads
        Accessible.name: ({ letters: keyboard.words["keyboard-letters"],
                            accents: keyboard.words["keyboard-accents"],
                            signs: keyboard.words["keyboard-signs"] })[leads]
        onClicked: keyboard.shown = leads
    }

    // A bubble's tail, level with the middle of the field. It ends at the outer edge of its card: across that edge, two
    // outlines would cross.
    Shape {
        id: tail
        objectName: "keys-tail"
        visible: keyboard.points
        readonly property bool after: keyboard.broad ? keyboard.where.aim.y > keyboard.y : keyboard.x < 0
        readonly property real line: keyboard.border.width
        width: Math.max(0, keyboard.away)
        height: keyboard.broad ? 2 * width : 48 * Theme.unit
        x: keyboard.broad ? keyboard.where.aim.x - keyboard.x - width / 2 : after ? keyboard.width : -width
        y: keyboard.broad ? (after ? keyboard.height + width / 2 : -width / 2) - height / 2 : keyboard.where.aim.y - keyboard.y - height / 2
        rotation: (keyboard.broad ? 90 : 0) + (after ? 180 : 0)
        // Without the line that is drawn around the keys between its ends, which is on whole pixels.
        ShapePath {
            fillColor: keyboard.color
            strokeColor: "transparent"
            startX: tail.width + tail.line + 2; startY: 0
            PathLine { x: tail.width; y: 0 }
            PathLine { x: Theme.unit; y: tail.height / 2 }
            PathLine { x: tail.width; y: tail.height }
            PathLine { x: tail.width + tail.line + 2; y: tail.height }
        }
        // Its line ends within the width of that one.
        ShapePath {
            fillColor: "transparent"
            strokeColor: keyboard.border.color
            strokeWidth: tail.line
            joinStyle: ShapePath.RoundJoin
            capStyle: ShapePath.RoundCap
            startX: tail.width + tail.line / 2; startY: 0
            PathLine { x: Theme.unit; y: tail.height / 2 }
            PathLine { x: tail.width + tail.line / 2; y: tail.height }
        }
    }
    Grid {
        id: keys
        x: (keyboard.width - width) / 2
        y: (keyboard.height - height) / 2
        columns: keyboard.flat ? 2 : 1
        spacing: keyboard.gap
        horizontalItemAlignment: Grid.AlignHCenter
        Column {
            spacing: keyboard.gap
            Repeater {
                model: keyboard.rows
                Row {
                    id: row
                    required property string modelData
                    anchors.horizontalCenter: parent?.horizontalCenter
                    spacing: keyboard.gap
                    Repeater {
                        model: Array.from(row.modelData)
                        ScreenKey {
                            required property string modelData
                            readonly property bool wipes: modelData === "⌫"
                            readonly property bool ends: modelData === "✓"
                            objectName: wipes ? "key-delete" : ends ? "key-done" : "key-" + modelData
                            pressedIn: ends
                            // Twice as wide where no minus stands before it: no place is empty.
                            width: keyboard.numbers && !keyboard.flat && !keyboard.ends && modelData === "0" && !keyboard.field?.minus
                                ? 2 * keyboard.keyWidth + keyboard.gap : usualWidth
                            drawn: wipes
                            words: wipes ? keyboard.words["keyboard-delete"] : ends ? keyboard.words["keyboard-done"] : keyboard.capitals ? keyboard.form.capital(modelData) : keyboard.numbers && modelData === "-" ? "−" : modelData
                            onClicked: {
                                if (wipes || ends) {
                                    if (wipes)
                                        keyboard.field.wipe()
                                    else
                                        keyboard.done()
                                    return
                                }
                                keyboard.field.type(keyboard.numbers ? modelData : words)
                                keyboard.capitals = false
                            }
                        }
                    }
                }
            }
        }
        Flow {
            id: others
            visible: !keyboard.ends
            readonly property real wish: keyboard.flat ? Math.max(190 * Theme.unit, Math.floor(keyboard.where.spare - 2 * keyboard.margin - 5 * (keyboard.keyWidth + keyboard.gap))) : keyboard.numbers ? 3 * keyboard.keyWidth + 2 * keyboard.gap : keyboard.room - 2 * Theme.gap
            width: keyboard.numbers ? wish : Math.min(wish, implicitRow)
            readonly property real implicitRow: {
                let sum = -spacing
                for (const child of children)
                    sum += child.visible ? child.width + spacing : 0
                return sum + 1
            }
            spacing: keyboard.gap
            ScreenKey {
                visible: !keyboard.numbers && keyboard.shown !== "signs"
                objectName: "key-shift"
                words: keyboard.words["keyboard-shift"]
                pressedIn: keyboard.capitals
                checkable: true
                checked: pressedIn
                onCheckedChanged: if (checked !== pressedIn) checked = Qt.binding(() => keyboard.capitals)
                onClicked: keyboard.capitals = !keyboard.capitals
            }
            LayerKey { leads: "letters"; words: keyboard.form.keys.letters[1].slice(0, 3) }
            LayerKey { leads: "accents"; words: keyboard.form.keys.accents[0].slice(1, 4) }
            LayerKey { leads: "signs"; words: "#+=" }
            ScreenKey {
                visible: !keyboard.numbers && keyboard.shown !== "signs"
                objectName: "key-@"
                words: "@"
                onClicked: keyboard.field.type("@")
            }
            ScreenKey {
                visible: !keyboard.numbers
                objectName: "key-space"
                width: Math.max(2.2 * keyboard.keyWidth, implicitWidth)
                words: keyboard.words["keyboard-space"]
                onClicked: keyboard.field.type(" ")
            }
            ScreenKey {
                visible: !keyboard.numbers && keyboard.shown !== "signs"
                objectName: "key-."
                words: "."
                onClicked: keyboard.field.type(".")
            }
            ScreenKey {
                visible: !keyboard.numbers || keyboard.flat
                objectName: "key-delete"
                width: drawn ? others.wish : Math.max(keyboard.keyWidth, implicitWidth)
                drawn: keyboard.numbers
                words: keyboard.words["keyboard-delete"]
                onClicked: keyboard.field.wipe()
            }
            ScreenKey {
                objectName: "key-done"
                width: keyboard.numbers ? others.wish : Math.max(keyboard.keyWidth, implicitWidth)
                words: keyboard.words["keyboard-done"]
                pressedIn: true
                onClicked: keyboard.done()
            }
        }
    }
}
