// Whether something is well, told by shape and colour: a disc, or a triangle with its word beside it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Text {
    required property bool well

    textFormat: Text.PlainText
    text: well ? "●" : "▲"
    width: Theme.dense
    font.pixelSize: Theme.dense
    color: well ? Theme.sea : Theme.deepAmber
    Accessible.ignored: true
}
