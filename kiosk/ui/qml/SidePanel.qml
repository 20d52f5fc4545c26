// The assistant's place beside every screen: its face, and above it what it says.
import QtQuick
import Recollect
import "."

Item {
    id: panel

    required property AvatarScreen avatar

    // What the visitor has just touched, in this item; for a moment the face looks there.
    property point noticed
    readonly property bool notices: attention.running

    function notice(place: point) {
        noticed = place
        attention.restart()
    }
    // The next visitor must not meet a face that still looks where the last one touched.
    function stopNoticing() {
        attention.stop()
    }
    function towards(place: real, middle: real): real {
        return Math.max(-1, Math.min(1, (place - middle) / (500 * Theme.unit)))
    }

    PauseAnimation { id: attention; duration: 1200 }

    Bubble {
        anchors { left: parent.left; right: parent.right; top: parent.top; bottom: panel.avatar.present ? face.top : parent.bottom; bottomMargin: 4 * Theme.unit }
        sentence: panel.avatar.bubble
        hasSpeaker: panel.avatar.present
    }
    Avatar {
        id: face
        objectName: "face"
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom }
        width: Math.min(parent.width - 40 * Theme.unit, parent.height * 0.52 * 400 / 440)
        height: width * 440 / 400
        mood: panel.avatar.mood
        // Without motion it speaks with its mouth shut: the bubble stands there meanwhile.
        mouth: Theme.motion === 0 ? 0 : panel.avatar.mouth
        gazeX: panel.notices ? panel.towards(panel.noticed.x, face.x + face.width / 2) : panel.avatar.gazeX
        gazeY: panel.notices ? panel.towards(panel.noticed.y, face.y + face.height / 2) : panel.avatar.gazeY
        blinking: panel.avatar.blinking
        motion: Theme.motion * 1.5
        visible: panel.avatar.present
    }
}
