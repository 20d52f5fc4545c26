// The mouth. Law: the mood gives the line of the lips, `open` alone parts them - in every mood - as the sound forms them.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Shape {
    id: lips

    required property real open     // 0 closed .. 1 wide open
    required property real smile    // -1 corners down .. 1 corners up
    required property real span     // width of the closed mouth
    required property real skew     // px the right corner is higher than the left one
    required property real wave     // px of waviness of the closed line
    property string form: "open"    // the sound that is formed: closed, round, open, wide or teeth

    // The origin is the middle of the closed lips. The upper lip gives way less than the lower one: a jaw only drops.
    //   gape: how much of the opening is left;  broad: px of width;  bite: how far the upper teeth are seen
    readonly property var sounds: ({
        closed: { gape: 0, broad: 0, bite: 0 },
        round: { gape: 0.8, broad: -24, bite: 0 },
        open: { gape: 1, broad: 2, bite: 0.25 },
        wide: { gape: 0.62, broad: 18, bite: 0.6 },
        teeth: { gape: 0.34, broad: 12, bite: 1 }
    })
    readonly property var sound: sounds[form] ?? sounds.open
    readonly property real parted: open * sound.gape
    // Consonants are quiet, but shape the lips as far as vowels do.
    readonly property real spread: sound.broad * Math.min(1, open * 3)
    readonly property real w: Math.max(12, (span + (50 - span) * 0.5 * parted + spread) / 2)
    readonly property real yl: -7 * smile + skew / 2 + 6 * parted
    readonly property real yr: -7 * smile - skew / 2 + 6 * parted
    readonly property real bow: 15 * smile * (1 - 0.35 * parted) - 12 * parted
    readonly property real drop: 15 * smile + (60 - 6 * smile) * parted
    readonly property real still: wave * (1 - 0.6 * parted)
    readonly property var low: [[w, yr], [w * (0.4 + 0.55 * parted), drop + still], [-w * (0.4 + 0.55 * parted), drop - still], [-w, yl]]

    readonly property string outline: `M ${-w} ${yl} C ${-w * 0.4} ${bow - still} ${w * 0.4} ${bow + still} ${w} ${yr}`
        + ` C ${low[1][0]} ${low[1][1]} ${low[2][0]} ${low[2][1]} ${-w} ${yl} Z`

    // The point at t of the lower lip, for what lies on it.
    function at(t: real): list<real> {
        const s = 1 - t, k = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t]
        return [0, 1].map(i => k.reduce((sum, f, n) => sum + f * low[n][i], 0))
    }
    // The tongue rests on the lower lip; it needs no mask because its lower edge is the lip itself.
    function tongue(): string {
        const r = at(0.2), l = at(0.8), h = 20 * parted, b = (r[1] + l[1]) / 2
        const f = (at(0.5)[1] - b) * 4 / 3
        return `M ${l[0]} ${l[1]} C ${l[0] * 0.6} ${b - h} ${r[0] * 0.6} ${b - h} ${r[0]} ${r[1]}`
             + ` C ${r[0] * 0.7} ${b + f} ${l[0] * 0.7} ${b + f} ${l[0]} ${l[1]} Z`
    }

    // The upper teeth hang from the upper lip and follow it.
    function teeth(): string {
        const d = Math.min(11, 34 * parted) , l = w * 0.72, top = (yl + yr) / 2 * 0.4 + bow * 0.6 + 2
        return `M ${-l} ${top} C ${-l * 0.5} ${top + bow * 0.15} ${l * 0.5} ${top + bow * 0.15} ${l} ${top} L ${l * 0.9} ${top + d} L ${-l * 0.9} ${top + d} Z`
    }

    antialiasing: true

    ShapePath {
        strokeWidth: -1
        fillColor: "#4B2430"
        PathSvg { path: lips.outline }
    }
    ShapePath {
        strokeWidth: -1
        fillColor: lips.parted > 0.25 ? "#E4725B" : "transparent"
        PathSvg { path: lips.tongue() }
    }
    ShapePath {
        strokeWidth: -1
        fillColor: Qt.rgba(1, 0.98, 0.95, lips.parted > 0.08 ? lips.sound.bite : 0)
        PathSvg { path: lips.teeth() }
    }
    ShapePath {
        strokeWidth: 6
        strokeColor: "#22313F"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
        PathSvg { path: lips.outline }
    }
}
