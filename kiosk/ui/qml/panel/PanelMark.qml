// Whether something is well, told by shape and colour: a disc, or a triangle with its word beside it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Text {
    required property bool well
    property real size: Theme.dense

    textFormat: Text.PlainText
    text: well ? "●" : "▲"
    width: size
    font.pixelSize: size
    color: well ? Theme.sea : Theme.deepAmber
    Accessible.ignored: true
}
