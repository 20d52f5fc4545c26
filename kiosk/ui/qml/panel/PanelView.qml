// The panel: the day at one glance, and what can be done, by keyboard alone or by touch.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import Recollect
import ".."

FocusScope {
    id: view

    required property PanelScreen panel
    readonly property var words: panel.words
    readonly property bool wide: width >= height
    // Whole pixels: what ends at a fraction of one would lose its edge.
    readonly property real space: Math.round(0.7 * Theme.gap)
    readonly property real edge: Math.round(1.5 * Theme.gap)
    // Which page is shown, from 0: today, the sessions, and what holds from the next one on.
    property int page: 0
    // Whether something on the first page is to be seen.
    readonly property bool warns: panel.health.matters.length > 0 || panel.alarms.some(alarm => alarm.holds)

    objectName: "panel"
    onPageChanged: pane.contentY = 0
    Keys.onEscapePressed: panel.wish("panel", "")
    // The ring comes with the first key: as long as none is pressed, it would only make the way out the strongest line.
    // A visitor who works by keyboard has it back afterwards.
    property bool visitorsRing: false
    Component.onCompleted: {
        visitorsRing = Theme.byKeyboard
        Theme.byKeyboard = false
        today.way.forceActiveFocus(Qt.OtherFocusReason)
    }
    Component.onDestruction: if (visitorsRing) Theme.byKeyboard = true

    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }
    Item {
        id: head
        z: 1
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: view.edge; topMargin: Theme.gap }
        height: Math.max(pages.height, close.height + 0.3 * Theme.gap)
        // Where large words leave too little room, as on an upright screen, the title is what can be spared.
        readonly property bool tight: !fits(usual, true)
        // How large the names of the pages are: as large as has room beside the clock.
        readonly property real usual: 1.1 * Theme.dense
        readonly property real tabSize: [38, 36, 34, 33, 32, 31, 30, 29, 28, 27, 26].map(each => each * Theme.unit)
            .find(each => each > usual && fits(each, !tight)) ?? usual

        // Whether they have room in this size, with the title before them or without it.
        function fits(size: real, titled: bool): bool {
            const names = [view.words["console-today"], view.words["console-sessions-page"], view.words["console-next-page"]]
            return (titled ? wordWidths.bold(view.words["console-title"], Math.max(size, 1.35 * Theme.dense)) + 2 * Theme.gap : 0)
                + names.reduce((sum, name) => sum + wordWidths.bold(name, size) + 32 * Theme.unit, (names.length - 1) * Theme.gap)
                + clock.width + close.width + 2 * Theme.gap <= width
        }
        WordWidths { id: wordWidths }

        PlainText {
            id: title
            visible: !head.tight
            y: (close.height - height) / 2
            text: view.words["console-title"]
            font.pixelSize: Math.max(head.tabSize, 1.35 * Theme.dense)
            color: Theme.faintInk
        }
        Row {
            id: pages
            x: head.tight ? 0 : title.width + 2 * Theme.gap
            anchors.bottom: parent.bottom
            spacing: Theme.gap
            PanelTab {
                objectName: "panel-today"
                words: view.words["console-today"]
                font.pixelSize: head.tabSize
                chosen: view.page === 0
                onClicked: view.page = 0
                // What is not well stands there alone, and must not be missed on the other pages.
                PanelMark {
                    visible: view.warns && !parent.chosen
                    x: parent.width - 0.7 * width
                    y: 4 * Theme.unit
                    well: false
                    size: 0.7 * head.tabSize
                    words: view.words["console-mark-ill"]
                }
            }
            PanelTab {
                objectName: "panel-sessions"
                words: view.words["console-sessions-page"]
                font.pixelSize: head.tabSize
                chosen: view.page === 1
                onClicked: view.page = 1
            }
            PanelTab {
                objectName: "panel-next"
                words: view.words["console-next-page"]
                font.pixelSize: head.tabSize
                chosen: view.page === 2
                onClicked: view.page = 2
            }
        }
        PlainText {
            id: clock
            objectName: "today-clock"
            anchors { right: close.visible ? close.left : parent.right; rightMargin: close.visible ? Theme.gap : 0; verticalCenter: close.verticalCenter }
            text: view.panel.today.clock
            font.pixelSize: Math.max(head.usual, Theme.dense * 1.45)
            color: Theme.faintInk
        }
        PanelButton {
            id: close
            objectName: "panel-close"
            // The first page has ways back that say what they do.
            visible: view.page > 0
            anchors { right: parent.right; top: parent.top }
            width: 76 * Theme.unit
            words: view.words["console-close"]
            horizontalPadding: 0
            // A plain cross: the way back to what was shown stands with the state.
            contentItem: Item {
                Drawing {
                    anchors.centerIn: parent
                    scale: 2.5 * Theme.unit
                    thick: 1.8
                    path: "M5 5 L19 19 M19 5 L5 19"
                    ink: close.front
                }
            }
            background: Rectangle {
                radius: 12 * Theme.unit
                color: close.down ? Theme.sand : close.hovered ? Theme.white : "transparent"
                FocusRing {
                    around: close
                    reach: 0
                    radius: parent.radius
                }
            }
            onClicked: view.panel.wish("panel", "")
        }
    }
    // The tabs stand on it.
    Rectangle {
        id: rule
        z: 1
        anchors { top: head.bottom; left: parent.left; right: parent.right; leftMargin: view.edge; rightMargin: view.edge }
        height: 2 * Theme.unit
        color: Theme.edge
    }
    Flickable {
        id: pane
        anchors { top: rule.bottom; left: parent.left; right: parent.right; bottom: parent.bottom; margins: view.edge; topMargin: view.space; bottomMargin: 1.3 * view.space }
        contentHeight: content.height
        clip: true
        boundsBehavior: Flickable.StopAtBounds
        ScrollBar.vertical: ScrollBar {
            // In the margin beside the pane, so that all edges of the page are in line.
            parent: view
            anchors { top: pane.top; bottom: pane.bottom; left: pane.right; leftMargin: 5 * Theme.unit }
            policy: pane.contentHeight > pane.height ? ScrollBar.AlwaysOn : ScrollBar.AlwaysOff
            width: 8 * Theme.unit
            padding: 0
            contentItem: Rectangle { radius: width / 2; color: Theme.lightSea }
        }

        // Where the keyboard is, there the eye is.
        readonly property Item held: view.Window.activeFocusItem
        onHeldChanged: {
            if (held === null || held.parent === null || held === close || held === today.way)
                return
            const at = held.mapToItem(content, 0, 0).y
            if (at >= 0 && (at < contentY || at + held.height > contentY + height))
                contentY = Math.max(0, Math.min(contentHeight - height, at - height / 2))
        }

        Item {
            id: content
            width: pane.width
            height: view.page === 0 ? today.height : (other.item as Item)?.height ?? 0

            PanelToday {
                id: today
                visible: view.page === 0
                width: parent.width
                panel: view.panel
                wide: view.wide
                seen: pane.height
                // Its parts stand further from each other than what belongs together in them.
                space: Math.round((view.wide ? 1.3 : 1.5) * view.space)
            }
            // Made when they are turned to: the panel opens the sooner.
            Loader {
                id: other
                width: parent.width
                active: view.page > 0
                sourceComponent: view.page === 1 ? stored : next
            }
            Component {
                id: stored
                PanelRecords {
                    panel: view.panel
                    wide: view.wide
                    seen: pane.height
                    space: view.space
                }
            }
            Component {
                id: next
                PanelNext {
                    panel: view.panel
                    wide: view.wide
                    seen: pane.height
                    space: view.space
                }
            }
        }
    }
    // Without a graphics card, drawings that are scrolled out of the pane are not cut off by it.
    Rectangle {
        anchors { top: parent.top; left: parent.left; right: parent.right; bottom: pane.top; bottomMargin: 2 * Theme.unit }
        color: Theme.paper
    }
    Rectangle {
        anchors { top: pane.bottom; left: parent.left; right: parent.right; bottom: parent.bottom; topMargin: 2 * Theme.unit }
        color: Theme.paper
    }
}
