// The panel: how everything is, who has come, and what can be done, at one glance and by keyboard alone.
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
    readonly property real space: 0.75 * Theme.gap

    objectName: "panel"
    Keys.onEscapePressed: panel.wish("panel", "")
    Component.onCompleted: close.forceActiveFocus(Qt.ShortcutFocusReason)

    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }
    Item {
        id: head
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: view.space }
        height: Math.max(close.height, title.height, session.height)

        PlainText {
            id: title
            anchors.verticalCenter: parent.verticalCenter
            text: view.words["console-title"]
            font { pixelSize: Theme.dense * 1.35; bold: true }
            color: Theme.ink
        }
        PlainText {
            id: session
            anchors { left: title.right; right: close.left; margins: Theme.gap; verticalCenter: parent.verticalCenter }
            text: view.panel.choices.session
            font.pixelSize: Theme.dense
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
        PanelButton {
            id: close
            objectName: "panel-close"
            anchors.right: parent.right
            words: view.words["console-close"]
            focus: true
            onClicked: view.panel.wish("panel", "")
        }
    }
    Rectangle {
        id: summary
        anchors { top: head.bottom; left: parent.left; right: parent.right; margins: view.space }
        height: sentence.height + Theme.gap
        radius: Theme.radius
        color: view.panel.health.well ? Theme.sea : Theme.amber
        PlainText {
            id: sentence
            objectName: "panel-summary"
            anchors { left: parent.left; right: parent.right; margins: Theme.gap; verticalCenter: parent.verticalCenter }
            text: (view.panel.health.well ? "✓   " : "▲   ") + view.panel.health.summary
            font { pixelSize: Theme.dense * 1.12; bold: true }
            color: view.panel.health.well ? Theme.white : Theme.ink
            wrapMode: Text.Wrap
        }
    }
    Flickable {
        id: pane
        anchors { top: summary.bottom; left: parent.left; right: parent.right; bottom: foot.top; margins: view.space }
        contentHeight: content.height
        clip: true
        boundsBehavior: Flickable.StopAtBounds
        ScrollBar.vertical: ScrollBar {
            anchors { top: parent?.top; bottom: parent?.bottom; right: parent?.right }
            policy: pane.contentHeight > pane.height ? ScrollBar.AlwaysOn : ScrollBar.AlwaysOff
            width: 8 * Theme.unit
            padding: 0
            contentItem: Rectangle { radius: width / 2; color: Theme.lightSea }
        }

        // Where the keyboard is, there the eye is.
        readonly property Item held: view.Window.activeFocusItem
        onHeldChanged: {
            if (held === null || held.parent === null || held === close)
                return
            const at = held.mapToItem(content, 0, 0).y
            if (at >= 0 && (at < contentY || at + held.height > contentY + height))
                contentY = Math.max(0, Math.min(contentHeight - height, at - height / 2))
        }

        Item {
            id: content
            width: pane.width
            height: view.wide ? Math.max(left.height, middle.height, right.height)
                              : Math.max(left.height, right.height) + view.space + middle.height

            Column {
                id: left
                width: view.wide ? content.width * 0.29 : (content.width - view.space) * 0.5
                spacing: view.space
                PanelSection {
                    width: parent.width
                    title: view.words["console-health"]
                    Repeater {
                        model: view.panel.health.lines
                        delegate: PanelLine { required property var modelData; line: modelData; width: parent.width }
                    }
                }
                PanelAlarms { width: parent.width; panel: view.panel }
                PanelResume {
                    width: parent.width
                    panel: view.panel
                }
            }
            Column {
                id: middle
                x: view.wide ? left.width + view.space : 0
                y: view.wide ? 0 : Math.max(left.height, right.height) + view.space
                width: view.wide ? content.width * 0.41 : content.width
                spacing: view.space
                PanelCounts { width: parent.width; words: view.words; records: view.panel.records }
                PanelSessions { width: parent.width; words: view.words; records: view.panel.records }
                PanelSection {
                    width: parent.width
                    title: view.words["console-deviations"]
                    PanelEmpty {
                        words: view.words["console-deviations-none"]
                        visible: view.panel.records.deviations.length === 0
                    }
                    Repeater {
                        model: view.panel.records.deviations
                        delegate: PanelDeviation {
                            required property var modelData
                            deviation: modelData
                            width: parent.width
                        }
                    }
                    PanelEmpty { words: view.panel.records.more; visible: words !== "" }
                }
            }
            PanelActions {
                id: right
                x: content.width - width
                width: view.wide ? content.width - left.width - middle.width - 2 * view.space
                                 : (content.width - view.space) * 0.5
                panel: view.panel
                space: view.space
            }
        }
    }
    PlainText {
        id: foot
        anchors { left: parent.left; right: parent.right; bottom: parent.bottom; margins: view.space }
        text: view.words["console-keys"]
        font.pixelSize: Theme.denser
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
}
