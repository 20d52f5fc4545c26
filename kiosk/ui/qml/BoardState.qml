// What all cards of a board have in common: what the board tells of them, and what has just happened to them.
import QtQuick
import Recollect
import "."

QtObject {
    id: state

    required property BoardScreen board

    // Asked of the board once, and not by every card.
    readonly property bool open: board.open
    readonly property bool speaking: board.speaking
    readonly property bool missed: board.missed
    readonly property int markRow: board.markRow
    readonly property int markColumn: board.markColumn
    readonly property bool marks: markRow >= 0 || markColumn >= 0

    // How many cards turn just now.
    property int turning: 0
    // Where the pair lies that was just found, until another card is turned over.
    property list<int> latest: []
    // Where the last pair lies, once all are found.
    property list<int> last: []
    // How far the joy about that has run over the cards, from the first to the last.
    property real wave: 0
    // Whether the last pair is in the tray, and how far the others have stepped back from it.
    property bool over: false
    property real ended: over ? 1 : 0
    Behavior on ended { NumberAnimation { duration: Theme.motion } }
    // A card was touched or has turned.
    signal touched(location: int)

    // A new board.
    function begin() {
        turning = 0
        last = []
        latest = []
        wave = 0
        over = false
    }
}
