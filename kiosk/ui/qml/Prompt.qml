// What stands in the helper's bubble while it says nothing: how a move goes on, or a line of the page.
import QtQuick
import Recollect
import "."

QtObject {
    id: prompt

    required property BoardScreen board
    // Where the cards are; null while they are not shown.
    required property BoardView view
    required property var words
    // What the page has it say.
    required property string line
    // Whether nothing is to stand there, and whether it says something itself.
    required property bool hushed
    required property bool says

    // How a move goes on, and that it made a pair, is said in the practice; in the game a line under the cards says it.
    readonly property bool practises: view !== null && board.practice
    readonly property bool second: practises && board.oneUp && board.open && !view.marks
    readonly property bool missed: practises && board.missed
    readonly property bool glad: practises && view.latest.length > 0 && !board.speaking
    readonly property bool done: view !== null && !board.practice && view.last.length > 0
    readonly property string move: second ? words["practice-second"]
        : missed ? words["practice-turning-back"]
        : glad ? words["practice-pair"]
        : done ? words["game-found"]
        : view !== null && board.untouched && board.open ? words["game-begin"] : ""

    readonly property string text: hushed ? "" : view !== null ? move : line
    // Whether it says what to do.
    readonly property string advice: view !== null && (second || move === words["game-begin"]) ? text : ""
    // Whether it tells how the move goes on, and whether it cheers.
    readonly property bool tells: (second || missed) && text !== "" && !says
    readonly property bool cheers: (glad || done) && text !== "" && !second && !missed
    readonly property bool triumphs: cheers && done
}
