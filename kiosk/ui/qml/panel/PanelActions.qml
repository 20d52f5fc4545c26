// What can be done at once: what is done all day first, and apart at the foot what ends a session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: actions

    required property PanelScreen panel
    required property bool wide
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property real space: apart
    // How high they are: higher where they have a column of their own.
    readonly property bool ample: wide && least > 0 && choices.underWay && !choices.canBeNext && Theme.textSize <= 1.15
    readonly property real tall: (ample ? 97 : wide ? 84 : 72) * Theme.unit

    readonly property real lettering: (Theme.textSize > 1.15 ? 1 : wide ? 1.2 : 1.05) * Theme.dense

    title: words["console-actions"]

    // How many stand in a row; one, where its words need more.
    component Action: PanelButton {
        property int row: actions.wide ? 1 : actions.choices.underWay ? 3 : 2
        readonly property real room: parent?.width ?? Infinity
        readonly property real each: (room - (row - 1) * actions.space) / row - 0.5
        least: actions.tall
        width: implicitWidth <= each ? each : room
        font { pixelSize: actions.lettering; bold: true }
    }
    // Whether one thing alone is pressed all day, and how high and wide that is: the largest.
    readonly property bool alone: [choices.onBreak, choices.canBeNext, choices.underWay].filter(Boolean).length === 1
    readonly property real mainTall: (ample ? 124 : wide ? 108 : alone ? 76 : 92) * Theme.unit
    function mainWide(room: real): real {
        return wide || alone ? room : (room - space) / 2 - 0.5
    }
    component Main: PanelButton {
        least: actions.mainTall
        width: actions.mainWide(parent?.width ?? Infinity)
        font.pixelSize: 1.12 * actions.lettering
    }

    Flow {
        width: parent.width
        spacing: actions.space
        Main {
            objectName: "break-end"
            filled: true
            visible: actions.choices.onBreak ?? false
            words: actions.words["console-break-end"]
            onClicked: actions.panel.wish("break", "")
        }
        Main {
            objectName: "action-next"
            filled: !(actions.choices.onBreak ?? false)
            visible: actions.choices.canBeNext
            words: actions.words["console-next"]
            onClicked: actions.panel.wish("next", "")
        }
        PanelSwitch {
            objectName: "action-pause"
            visible: actions.choices.underWay
            // As high as what it stands beside.
            least: actions.wide || actions.alone ? actions.tall : actions.mainTall
            width: actions.mainWide(parent?.width ?? Infinity)
            font.pixelSize: actions.lettering
            words: actions.words["console-stay-paused"]
            on: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
    }
    Flow {
        width: parent.width
        spacing: actions.space
        Action {
            objectName: "action-again"
            visible: actions.choices.underWay
            words: actions.words["console-repeat"]
            onClicked: actions.panel.wish("repeat", "")
        }
        Action {
            objectName: "action-backup"
            enabled: actions.choices.backup === ""
            words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
            onClicked: actions.panel.wish("backup", "")
        }
        Action {
            objectName: "action-mute"
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            onClicked: actions.panel.wish("mute", "")
        }
    }
    Item { width: 1; height: 2 * Theme.unit }
    PanelChoice {
        id: breaks
        width: actions.wide || !actions.choices.underWay ? parent.width : (parent.width - 2 * Theme.gap) / 2
        action: "break"
        even: true
        least: actions.tall
        size: actions.size
        // Four of them fit one row of the column in smaller letters only.
        lettering: actions.wide && options.length > 3 ? Theme.dense : actions.lettering
        title: actions.words["console-break"]
        options: actions.choices.breaks ?? []
        chosen: actions.choices.break ?? ""
        onPicked: value => actions.panel.wish("break", value)
    }
    // Apart, at the foot or beside the break: it takes a game from a visitor.
    Item {
        visible: actions.choices.underWay && actions.wide
        width: parent.width
        height: end.height + then.height + 2 * Theme.gap
    }
    Rectangle {
        parent: actions
        visible: end.visible
        x: actions.wide ? end.x : actions.width / 2 - width
        y: actions.wide ? then.y - Theme.gap : actions.height - height - 1.1 * Theme.gap
        width: actions.wide ? end.width : 2 * Theme.unit
        height: actions.wide ? 2 * Theme.unit : breaks.height
        color: Theme.edge
    }
    PlainText {
        id: then
        parent: actions
        visible: end.visible
        x: end.x
        y: end.y - height - 8 * Theme.unit
        width: end.width
        text: actions.words["console-abort-then"]
        font.pixelSize: actions.size
        color: Theme.faintInk
        horizontalAlignment: Text.AlignLeft
        wrapMode: Text.Wrap
    }
    PanelButton {
        id: end
        parent: actions
        objectName: "action-end"
        visible: actions.choices.underWay
        anchors { right: parent.right; bottom: parent.bottom; margins: 0.8 * Theme.gap; bottomMargin: 1.1 * Theme.gap }
        width: actions.wide ? actions.width - 1.6 * Theme.gap : actions.width / 2 - 1.8 * Theme.gap
        least: actions.tall
        grave: true
        font.pixelSize: actions.lettering
        words: actions.words["console-abort"]
        onClicked: actions.panel.wish("abort", "")
    }
}
