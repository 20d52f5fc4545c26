// The way on at the bottom right of a page, or in its middle, and at its left the way back, where there is one.
import QtQuick
import Recollect
import "."

FocusScope {
    id: ways

    required property KioskScreen kiosk
    required property var words
    // What the way on says; with no words there is none but the page's own buttons.
    property string label: ""
    property bool quiet: false
    property bool centred: false
    readonly property alias button: go
    signal went()

    readonly property bool beside: (centred ? 2 : 1) * (back.implicitWidth + Theme.gap) + go.implicitWidth <= width

    height: label === "" ? (back.visible ? back.height : 0)
                         : back.visible && !beside ? go.height + 0.5 * Theme.gap + back.height : go.height

    BigButton {
        id: go
        objectName: "continue"
        visible: ways.label !== ""
        most: ways.width
        x: ways.centred ? (ways.width - width) / 2 : Theme.across(ways.width - width, width, ways.width)
        quiet: ways.quiet
        words: ways.label
        focus: true
        onClicked: ways.went()
    }
    BigButton {
        id: back
        objectName: "back"
        visible: ways.kiosk.goesBack
        most: ways.width
        x: Theme.across(0, width, ways.width)
        y: ways.label === "" ? 0 : ways.beside ? (go.height - height) / 2 : go.height + 0.5 * Theme.gap
        quiet: true
        words: ways.words["control-back"]
        verticalPadding: 18 * Theme.unit
        horizontalPadding: 40 * Theme.unit
        onClicked: ways.kiosk.goBack()
    }
}
