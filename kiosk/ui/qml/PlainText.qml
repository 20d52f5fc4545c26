// A text to be read as it was written, and told to those who cannot see it. What looks like markup is none.
import QtQuick
import "."

Text {
    textFormat: Text.PlainText
    // On a mirrored page every text begins at the right, also one that begins with a Latin word.
    horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
    color: Theme.ink
    Accessible.role: font.bold && font.pixelSize >= Theme.heading ? Accessible.Heading : Accessible.StaticText
    Accessible.name: text
}
