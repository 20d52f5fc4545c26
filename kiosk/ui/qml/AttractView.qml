// What draws people in: a small board that plays by itself, a title, and one large button for each language.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow
    required property string labName
    required property url labLogo
    // Whether the helper stands beside it on a wide screen: then it says the invitation itself.
    property bool accompanied: false

    // The lab stands above everything, if it says who it is.
    readonly property real head: lab.visible ? lab.height + Theme.gap : 0
    // Below everything it says whether this is a trial.
    readonly property real foot: trial.visible ? trial.height + Theme.gap : 0
    readonly property int columns: Math.ceil(attract.layout.length / 2)
    readonly property real between: (ample ? 2 : 1.5) * Theme.gap
    readonly property int rows: Math.ceil(attract.layout.length / columns)
    // The words take what they need; the cards have the rest.
    readonly property real cardSize: Math.max(60 * Theme.unit,
        Math.min(widest, (height - head - foot - words.height - 5 * Theme.gap) / (1.12 * rows)))
    readonly property bool upright: width < height
    // An upright page has room for larger words, and more of it between them.
    readonly property bool ample: upright && Theme.textSize <= 1.15
    readonly property real widest: width / (1.12 * columns + (upright ? 0.42 : 0.7))
    // The buttons are as wide as each other and end with the cards, where their words fit.
    readonly property bool even: several && longest(attract.ways, letters.font) + 48 * Theme.unit <= (upright ? 1 : 0.9) * share(widest)
    function share(size: real): real {
        const count = Math.max(1, attract.ways.length)
        return Math.min(460 * Theme.unit, Math.floor((size * (1.12 * columns - 0.15) - (count - 1) * starts.columnSpacing) / count))
    }
    // What is measured depends on the font, which is named for that reason alone.
    function longest(ways: var, _font: font): real {
        return Math.max(0, ...ways.map(way => letters.advanceWidth(way.start)))
    }
    FontMetrics {
        id: letters
        font { pixelSize: Theme.size(54); bold: true }
    }
    WordWidths {
        id: wordWidths
    }
    // The names of languages are as large as each other: as large as the longest allows, which is hardly wider than its
    // button.
    readonly property real named: {
        const most = Theme.size(Theme.textSize > 1.15 ? 30 : upright ? 52 : 44)
        const padded = way => (even ? longest(attract.ways, letters.font) + 48 * Theme.unit : letters.advanceWidth(way.start) + 88 * Theme.unit)
        const shares = attract.ways.map(way => (padded(way) + 0.5 * Theme.gap) / wordWidths.bold(way.name, most))
        return Math.max(Theme.size(30), Math.floor(most * Math.min(1, ...shares)))
    }
    // A card was turned, in the middle of this item; the helper looks at it.
    signal looked(place: point)
    readonly property bool several: attract.ways.length > 1

    // The next visitor begins as if the last one had never been: at the first language, and with no ring.
    onVisibleChanged: {
        if (visible && ways.count > 0)
            (ways.itemAt(0) as Way).focus = true
        Theme.byKeyboard = Theme.byKeyboard && !visible
    }

    component Way: FocusScope {
        id: way
        required property int index
        required property var modelData
        focus: index === 0
        width: start.width
        height: start.height + (name.visible ? name.height + 0.4 * Theme.gap : 0)
        BigButton {
            id: start
            objectName: "start-" + way.modelData.language
            most: view.width - 4 * Theme.gap
            words: way.modelData.start
            font.pixelSize: Theme.size(54)
            width: view.even ? Math.max(wish, view.share(view.cardSize)) : Math.min(wish, most)
            horizontalPadding: (view.even ? 24 : Theme.textSize > 1 ? 44 : 68) * Theme.unit
            verticalPadding: (view.ample ? 42 : 32) * Theme.unit
            focus: true
            Accessible.description: way.modelData.name
            Keys.onLeftPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)
            Keys.onRightPressed: nextItemInFocusChain().forceActiveFocus(Qt.TabFocusReason)
            onClicked: view.attract.start(way.modelData.language)
        }
        PlainText {
            id: name
            anchors { horizontalCenter: start.horizontalCenter; top: start.bottom; topMargin: 0.4 * Theme.gap }
            visible: view.several
            text: way.modelData.name
            font { pixelSize: view.named; bold: true }
            color: Theme.ink
        }
    }
    // A line in as large letters as let it stand in one. It takes the height of the largest in every language, so that
    // nothing else moves when the language changes.
    component Fitted: Line {
        property real most
        property real smallest
        readonly property real fitting: Math.floor(0.985 * most * room / Math.max(1, wordWidths.plain(text, most)))
        readonly property real size: Math.max(smallest, Math.min(most, fitting))
        anchors.horizontalCenter: parent?.horizontalCenter
        room: view.width - 4 * Theme.gap
        font.pixelSize: size
        lineHeight: fitting >= smallest ? most / size : 1
        color: Theme.ink
    }

    Row {
        id: lab
        objectName: "lab"
        anchors { left: parent.left; leftMargin: 1.5 * Theme.gap; top: parent.top; topMargin: Theme.gap }
        visible: view.labName !== "" || logo.visible
        spacing: 0.7 * Theme.gap
        Image {
            id: logo
            objectName: "logo"
            visible: source.toString() !== ""
            height: 84 * Theme.unit
            width: Math.min(implicitWidth, 360 * Theme.unit)
            fillMode: Image.PreserveAspectFit
            source: view.labLogo
            // By its height alone: how wide it is, the picture says.
            sourceSize.height: height
            Accessible.ignored: true
        }
        PlainText {
            anchors.verticalCenter: parent.verticalCenter
            width: Math.min(implicitWidth, view.width - 3 * Theme.gap - (logo.visible ? logo.width + lab.spacing : 0))
            wrapMode: Text.Wrap
            text: view.labName
            font { pixelSize: Theme.body; bold: true }
            color: Theme.sea
        }
    }
    Line {
        id: trial
        objectName: "trial"
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: 0.5 * Theme.gap }
        visible: text !== ""
        room: view.width - 2 * Theme.gap
        text: view.attract.trial
        font.pixelSize: Theme.small
        color: Theme.faintInk
    }
    Connections {
        target: view.attract
        function onTurned(card) {
            view.looked(cards.mapToItem(view, (card % view.columns + 0.5) * cards.pitch,
                                        (Math.floor(card / view.columns) + 0.5) * cards.pitch))
        }
    }
    Item {
        id: cards
        readonly property real pitch: view.cardSize * 1.12
        anchors { horizontalCenter: parent.horizontalCenter; bottom: words.top; bottomMargin: view.between }
        width: pitch * view.columns
        height: pitch * view.rows
        Repeater {
            model: view.attract.layout
            Item {
                id: place
                required property int index
                required property string modelData
                readonly property bool found: view.attract.found.includes(index)
                // How far a pair has come forward when it is found.
                property real forward: 0
                x: index % view.columns * cards.pitch
                y: Math.floor(index / view.columns) * cards.pitch
                z: forward > 0 ? 1 : 0
                width: cards.pitch
                height: cards.pitch
                onFoundChanged: if (found && Theme.motion > 0) coming.restart()

                Rectangle {
                    visible: place.found
                    anchors.centerIn: face
                    width: face.width * face.scale + 12 * Theme.unit
                    height: width
                    radius: width * 0.13
                    color: Theme.leaf
                }
                CardFace {
                    id: face
                    anchors.centerIn: parent
                    width: view.cardSize
                    height: view.cardSize
                    back: view.cardBack
                    shadow: view.cardShadow
                    picture: place.modelData
                    up: view.attract.up.includes(place.index)
                    scale: 1 + 0.07 * lift + 0.35 * place.forward
                }
                SequentialAnimation {
                    id: coming
                    NumberAnimation { target: place; property: "forward"; to: 1; duration: Theme.motion; easing.type: Easing.OutBack }
                    PauseAnimation { duration: Theme.motion }
                    NumberAnimation { target: place; property: "forward"; to: 0; duration: Theme.motion; easing.type: Easing.InOutQuad }
                }
            }
        }
    }
    Column {
        id: words
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom; bottomMargin: view.foot + (view.height - view.head - view.foot - height - cards.height - view.between) / 2 }
        // Above a greeting the cards need the room.
        spacing: (!view.ample ? 1 : view.height < 1.1 * view.width ? 0.75 : 1.5) * Theme.gap

        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.attract.title
            // Large words are large enough in one line, and the cards need the room.
            font { pixelSize: Math.min(Theme.size(92), 0.087 * view.width); bold: true }
        }
        Fitted {
            visible: !view.accompanied
            text: view.attract.line
            most: Theme.size(view.ample ? 64 : 44)
            smallest: Theme.size(view.ample ? 50 : 44)
        }
        Fitted {
            objectName: "promise"
            visible: text !== ""
            bottomPadding: Theme.gap
            text: view.attract.promise
            most: Theme.size(Theme.textSize > 1.15 ? 34 : view.ample ? 56 : view.accompanied ? 52 : 42)
            smallest: Theme.size(Theme.textSize > 1.15 ? 34 : 42)
        }
        Grid {
            id: starts
            anchors.horizontalCenter: parent.horizontalCenter
            // All in one row; or where that is too narrow, in rows that are as long.
            readonly property real widest: {
                let most = 0
                for (let i = 0; i < ways.count; i++)
                    most = Math.max(most, ways.itemAt(i)?.width ?? 0)
                return most + columnSpacing
            }
            readonly property real wish: {
                let sum = 0
                for (let i = 0; i < ways.count; i++)
                    sum += (ways.itemAt(i)?.width ?? 0) + columnSpacing
                return sum
            }
            readonly property int fit: Math.max(1, Math.floor((view.width - 2 * Theme.gap) / Math.max(1, widest)))
            columns: view.even || wish <= view.width - 2 * Theme.gap ? ways.count : Math.ceil(ways.count / Math.ceil(ways.count / fit))
            columnSpacing: (Theme.textSize > 1 || view.upright ? 1 : 1.5) * Theme.gap
            rowSpacing: 0.7 * Theme.gap
            horizontalItemAlignment: Grid.AlignHCenter
            Repeater {
                id: ways
                model: view.attract.ways
                Way {}
            }
        }
    }
}
