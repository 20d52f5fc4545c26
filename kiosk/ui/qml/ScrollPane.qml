// A place for what may be longer than its room: it then scrolls by wheel, touch and keyboard, and says so in words.
import QtQuick
import QtQuick.Controls.Basic
import "."

Item {
    id: pane

    required property real room         // the height that there is
    required property string more       // "there is more below"
    property alias spacing: column.spacing
    default property alias content: column.data

    // What is to stay in view while things around it find their places.
    property Item wanted: null

    // What stands out of the content on both sides, such as the ring around a button, is not cut off.
    readonly property real reach: 9 * Theme.unit
    readonly property bool long: column.height > room + 1
    readonly property real step: 0.8 * flick.height

    height: Math.max(0, Math.min(column.height, room))
    // Every visitor begins at the top.
    onVisibleChanged: rewind()
    onHeightChanged: flick.returnToBounds()

    function scroll(by: real) {
        wanted = null
        flick.contentY = Math.max(0, Math.min(flick.contentHeight - flick.height, flick.contentY + by))
    }
    // The bar does not follow by itself once there is nothing to scroll.
    function rewind() {
        wanted = null
        flick.contentY = 0
        bar.position = 0
    }
    function reveal(item: Item) {
        wanted = item
        bring()
    }
    function bring() {
        // What a page shows anew, as in another language, takes the place of what was to be seen.
        if (!wanted || !part(wanted))
            return
        const y = wanted.mapToItem(column, 0, 0).y
        if (y < flick.contentY)
            flick.contentY = y
        else if (y + wanted.height > flick.contentY + flick.height)
            flick.contentY = Math.max(0, Math.min(y, y + wanted.height - flick.height))
    }
    // For the keys of a view: those that scroll are used up, if there is anything to scroll.
    function turn(event: var) {
        const steps = { [Qt.Key_Down]: 0.25, [Qt.Key_Up]: -0.25, [Qt.Key_PageDown]: 1, [Qt.Key_PageUp]: -1 }
        event.accepted = pane.long && event.key in steps
        if (event.accepted)
            scroll(steps[event.key] * pane.step)
    }
    // What of this column an item belongs to, or null.
    function part(item: Item): Item {
        for (let above = item; above; above = above.parent)
            if (above.parent === column)
                return above
        return null
    }

    Flickable {
        id: flick
        x: -pane.reach
        width: parent.width + 2 * pane.reach
        height: Math.max(0, parent.height - (pane.long ? further.height + 0.3 * Theme.gap : 0))
        contentWidth: width
        contentHeight: column.height
        interactive: pane.long
        boundsBehavior: Flickable.StopAtBounds
        flickableDirection: Flickable.VerticalFlick
        // Nothing is cut off that fits: rings around buttons reach a little beyond them.
        clip: pane.long
        onHeightChanged: pane.bring()
        onContentHeightChanged: pane.bring()
        onMovementStarted: pane.wanted = null
        Column {
            id: column
            x: pane.reach
            // Never narrower for the bar: a page that became lower by it would need no bar, and so on without end.
            width: pane.width
        }
        ScrollBar.vertical: ScrollBar {
            id: bar
            // In the margin beside the pane, out of the flickable, which cuts off what reaches beyond it.
            parent: pane
            anchors { top: flick.top; bottom: flick.bottom; left: flick.right; leftMargin: 3 * Theme.unit }
            policy: pane.long ? ScrollBar.AlwaysOn : ScrollBar.AlwaysOff
            width: 18 * Theme.unit
            padding: 2 * Theme.unit
            contentItem: Rectangle { radius: width / 2; color: Theme.lightSea }
            background: Rectangle { radius: width / 2; color: Theme.sand }
        }
    }
    Button {
        id: further
        objectName: "more"
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom }
        // Its place is kept at the end too, so that nothing moves when it goes.
        visible: pane.long
        opacity: flick.atYEnd ? 0 : 1
        enabled: !flick.atYEnd
        focusPolicy: Qt.NoFocus
        horizontalPadding: Theme.gap
        verticalPadding: 6 * Theme.unit
        width: Math.min(implicitWidth, pane.width)
        Accessible.name: pane.more
        onClicked: pane.scroll(pane.step)
        contentItem: Text {
            textFormat: Text.PlainText
            text: pane.more
            font { pixelSize: Theme.small; bold: true }
            color: Theme.white
            horizontalAlignment: Text.AlignHCenter
            wrapMode: further.width < further.implicitWidth ? Text.Wrap : Text.NoWrap
        }
        background: Rectangle { radius: height / 2; color: Theme.lightSea }
    }
    Connections {
        target: pane.Window.window
        function onActiveFocusItemChanged() {
            const item = pane.Window.activeFocusItem as Item
            const whole = pane.visible && item ? pane.part(item) : null
            if (whole)
                pane.reveal(whole.height <= flick.height ? whole : item)
        }
    }
}
