// A text to be read, and told to those who cannot see it.
import QtQuick
import "."

Text {
    color: Theme.ink
    Accessible.role: font.bold && font.pixelSize >= Theme.heading ? Accessible.Heading : Accessible.StaticText
    Accessible.name: text
}
