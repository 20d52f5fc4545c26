// The assistant's place beside every screen: its face, and above it what it says.
import QtQuick
import Recollect
import "."

Item {
    id: panel

    required property AvatarScreen avatar

    Bubble {
        anchors { left: parent.left; right: parent.right; top: parent.top; bottom: face.top; bottomMargin: 4 * Theme.unit }
        sentence: panel.avatar.bubble
        hasSpeaker: panel.avatar.present
    }
    Avatar {
        id: face
        anchors { horizontalCenter: parent.horizontalCenter; bottom: parent.bottom }
        width: Math.min(parent.width - 40 * Theme.unit, parent.height * 0.52 * 400 / 440)
        height: width * 440 / 400
        mood: panel.avatar.mood
        // Without motion it speaks with its mouth shut: the bubble stands there meanwhile.
        mouth: Theme.motion === 0 ? 0 : panel.avatar.mouth
        gazeX: panel.avatar.gazeX
        gazeY: panel.avatar.gazeY
        blinking: panel.avatar.blinking
        motion: Theme.motion * 1.5
        visible: panel.avatar.present
    }
}
