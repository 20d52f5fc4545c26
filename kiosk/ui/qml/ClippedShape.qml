// A drawing that may be scrolled out of sight.
import QtQuick
import QtQuick.Shapes

Shape {
    id: drawing

    // What it is scrolled in, if anything.
    readonly property Flickable pane: paneAround(parent)
    // Qt's software renderer draws what is cut off entirely as if nothing were cut off.
    readonly property bool inSight: {
        // What moves it; the place alone would not be looked up again.
        if (pane === null || pane.contentY + pane.contentHeight < 0)
            return true
        // The lines alone: the square they are drawn on reaches further.
        const place = mapToItem(pane, boundingRect)
        return place.y + place.height > 1 && place.y < pane.height - 1
    }

    function paneAround(item: Item): Flickable {
        for (let above = item; above; above = above.parent) {
            const found = above as Flickable
            if (found)
                return found
        }
        return null
    }

    opacity: inSight ? 1 : 0
}
