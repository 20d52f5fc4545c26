// The drawing on a key that takes back a character.
import "."

Drawing {
    path: "M8 5 H21 V19 H8 L2.5 12 Z M11.5 9 L17 15 M17 9 L11.5 15"
    ink: Theme.ink
    scale: 1.5 * Theme.unit
}
