// What everything looks like: colours, sizes and the one duration. Law: no screen names a colour or a pixel of its own.
pragma Singleton
import QtQuick

QtObject {
    // A button was clicked, whichever it was: it is heard.
    signal clicked()

    // Set by the window, as all that is not readonly: pixels of one unit of a 1080-line screen, and the factor for texts.
    property real unit: 1
    property real textSize: 1
    property bool upright: false
    // Whether the person who is there works by keyboard: what has the focus then shows so, on a screen that only just came too.
    property bool byKeyboard: false
    // When the keys on the screen come: "touch", "always" or "never".
    property string screenKeys: "touch"
    // Whether the page is read from right to left: then what stands at the left stands at the right.
    property bool mirrored: false
    readonly property int ahead: mirrored ? -1 : 1
    // How long anything takes to move, in ms; 0 without motion.
    property int motion: 0

    // The study's palette, or one in which everything that is read stands out at 7:1 and nothing is pale.
    property bool highContrast: false
    property color accent: "#1F5F6B"
    property color background: "#FBF6EC"
    readonly property color paper: highContrast ? "#FFFFFF" : background
    readonly property color white: highContrast ? "#FFFFFF" : "#FFFBF2"
    readonly property color sand: highContrast ? "#FFD54A" : "#E9D8B4"
    // The ground of pictures, which those of the cards have, too. Pictures keep it with high contrast.
    readonly property color sunny: "#F9DDA9"
    readonly property color edge: highContrast ? "#000000" : sand
    // What can be chosen and is not: a light tint of the colour that it will have.
    readonly property color touchable: highContrast ? white : Qt.hsla(Math.max(0, accent.hslHue), Math.min(0.38, accent.hslSaturation), 0.92, 1)
    // What cannot do yet what it is for.
    readonly property color resting: highContrast ? white : Qt.tint(paper, Qt.alpha(sand, 0.5))
    // The outline of what is as easy to choose as all else, and is not what most are looking for.
    readonly property color shy: highContrast ? sea : Qt.tint(paper, Qt.alpha(sea, 0.65))
    // The ground of what is to be seen first, and cannot be touched.
    readonly property color stated: highContrast ? "#FFFFFF" : Qt.tint(white, Qt.alpha(sea, 0.13))
    // What lies below things that are put down on it.
    readonly property color shelf: highContrast ? "#FFFFFF" : Qt.tint(paper, Qt.alpha(sand, 0.32))
    // The head of a table.
    readonly property color band: highContrast ? "#FFFFFF" : Qt.tint(white, Qt.alpha(sand, 0.4))
    // The outline of a card on it.
    readonly property color slot: highContrast ? "#000000" : Qt.darker(sand, 1.25)
    readonly property color ink: highContrast ? "#000000" : "#22313F"
    readonly property color faintInk: highContrast ? "#1A2430" : "#4A5A68"
    readonly property color sea: highContrast ? "#0A3A44" : accent
    readonly property color lightSea: highContrast ? "#000000" : Qt.colorEqual(accent, "#1F5F6B") ? "#2E7784" : Qt.darker(accent, 1.15)
    readonly property color amber: highContrast ? "#FFB000" : "#F2A33A"
    readonly property color deepAmber: highContrast ? "#5A2D00" : "#8A4B00"
    // A pair that is found: not the colour of a hint, nor that of a closed card.
    readonly property color leaf: highContrast ? "#00592E" : "#3E8E5A"
    // How much of a card is still to be seen when it is found for good, and while a tap on it would not count.
    readonly property real done: highContrast ? 1 : 0.6
    readonly property real held: highContrast ? 1 : 0.72

    readonly property real title: size(76)
    readonly property real pageTitle: size(60)
    // What is found and the thanks are the heights of a visit.
    readonly property real highTitle: size(84)
    readonly property real figure: size(64)
    readonly property real heading: size(46)
    readonly property real body: size(32)
    // An upright page's texts are larger than a wide one's, and so are the words of its buttons.
    readonly property real onButtons: size(upright && textSize <= 1.15 ? 36 : 32)
    // The way on is what most look for on a page; the way back is a little smaller.
    readonly property real onWays: (22 + 20 * textSize) * unit
    readonly property real onBack: (12 + 24 * textSize) * unit
    readonly property real small: size(26)
    readonly property real reading: size(29)
    // What the experimenter reads, who sits close and wants all of it at once: 20 of 1080 lines at least.
    // More on an upright screen, which has the height for it.
    readonly property real dense: Math.max(upright ? 28 : 20, 22 * textSize) * unit
    readonly property real denser: Math.max(upright ? 24 : 20, 18 * textSize) * unit
    readonly property real gap: 24 * unit
    readonly property real radius: 22 * unit

    // Where something of this width stands, in so much room, that is so far from the edge where reading begins.
    function across(from: real, width: real, room: real): real {
        return mirrored ? room - from - width : from
    }
    // Nothing is set smaller than 24 of 1080 lines, whatever the factor.
    function size(usual: real): real {
        return Math.max(24, usual * textSize) * unit
    }
    // How large a picture of so many squares a side is in so much room: whole pixels for each, so that edges are sharp.
    function sharpSide(room: real, squares: int): real {
        return Math.max(2, Math.floor(room / Math.max(1, squares))) * squares
    }
}
