// What everything looks like: colours, sizes and the one duration. Law: no screen names a colour or a pixel of its own.
pragma Singleton
import QtQuick

QtObject {
    // Both are set by the window: pixels of one unit of a 1080-line screen, and the factor for all texts.
    property real unit: 1
    property real textSize: 1
    // How long anything takes to move, in ms; 0 without motion.
    property int motion: 0

    readonly property color paper: "#FBF6EC"
    readonly property color white: "#FFFBF2"
    readonly property color sand: "#E9D8B4"
    readonly property color ink: "#22313F"
    readonly property color faintInk: "#4A5A68"
    readonly property color sea: "#1F5F6B"
    readonly property color lightSea: "#2E7784"
    readonly property color amber: "#F2A33A"
    readonly property color deepAmber: "#8A4B00"

    readonly property real title: 76 * unit * textSize
    readonly property real figure: 64 * unit * textSize
    readonly property real heading: 46 * unit * textSize
    readonly property real body: 32 * unit * textSize
    readonly property real small: 26 * unit * textSize
    readonly property real gap: 24 * unit
    readonly property real radius: 22 * unit
}
