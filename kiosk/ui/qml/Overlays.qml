// The cards that lie over every page: most of them ask something, and one says that it takes a moment.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

Item {
    id: overlays

    required property KioskScreen kiosk
    required property AttractScreen attract
    required property ReturnScreen returning
    required property var words
    required property WindowLayout windowLayout
    // As in PartLoader.
    required property bool needed
    required property bool prepares
    // Whether the time to answer runs; a replay has a time of its own.
    required property bool timed
    // What the visitor wants to do, unless something else is in the way.
    readonly property string asks: kiosk.paused || kiosk.waits ? "" : kiosk.asks

    component Overlay: PartLoader {
        anchors.fill: parent
        focus: visible
        enabled: overlays.kiosk.takesInput
        needed: overlays.needed
        prepares: overlays.prepares
    }

    Overlay {
        shown: overlays.kiosk.asksStillThere
        sourceComponent: CalmCard {
            focus: true
            windowLayout: overlays.windowLayout
            least: roomy ? Math.min(1040 * Theme.unit, 0.83 * speaker) : speaker > 0 && overlays.windowLayout.board !== null ? 730 * Theme.unit : 0
            sign: "M1.5 12 C6 3.5 18 3.5 22.5 12 C18 20.5 6 20.5 1.5 12 Z M12 8.5 A3.5 3.5 0 0 1 12 15.5 A3.5 3.5 0 0 1 12 8.5"
            title: overlays.words["still-there-title"]
            titleSize: roomy ? largestInOneLine(title, [104, 100, 96, 94, 92, 90, 88]) : beside > 0 && Theme.textSize <= 1.15 ? largestInOneLine(title, [104, 100, 96, 92, 88, 84]) : Theme.figure
            line: overlays.words["still-there-line"]
            lineSize: Theme.size(roomy ? 46 : large ? 42 : 36)
            lasts: overlays.timed ? overlays.kiosk.answerMs : 0
            second: overlays.words["still-there-second"]
            seconds: overlays.words["still-there-seconds"]
            choices: [{ name: "still-here", words: overlays.words["still-there-yes"] }]
            onChosen: overlays.kiosk.confirm()
        }
    }
    Overlay {
        shown: overlays.asks === "stop"
        sourceComponent: CalmCard {
            focus: true
            windowLayout: overlays.windowLayout
            // Above a face it reaches up to the distance that a page has from the edge, where it has so much to say.
            least: roomy ? (code !== "" ? speaker - 5 * Theme.gap : 900 * Theme.unit) : beside > 0 && Theme.textSize <= 1.15 && code !== "" ? 896 * Theme.unit : speaker > 0 && overlays.windowLayout.board !== null ? 900 * Theme.unit : 0
            title: overlays.words["stop-title"]
            titleSize: roomy ? Theme.size(96) : beside > 0 && Theme.textSize <= 1.15 ? largestInOneLine(title, [92, 88, 84, 80]) : Theme.figure
            line: overlays.kiosk.stopLine
            lineSize: roomy ? Theme.size(50) : large ? Theme.size(44) : Theme.body
            code: overlays.kiosk.stopCode
            codeNote: overlays.words["stop-code"]
            // Neither is the quieter one: to stop is as easy to see as to go on.
            choices: [{ name: "stop-no", words: overlays.words["stop-no"], sign: "play" }, { name: "stop-yes", words: overlays.words["stop-yes"], sign: "leave" }]
            onChosen: name => name === "stop-yes" ? overlays.kiosk.stop() : overlays.kiosk.ask("")
            Keys.onEscapePressed: overlays.kiosk.ask("")
        }
    }
    Overlay {
        shown: overlays.asks === "language"
        sourceComponent: CalmCard {
            focus: true
            sign: "M12 3 A9 9 0 0 1 12 21 A9 9 0 0 1 12 3 M3.5 9.5 H20.5 M3.5 14.5 H20.5 M12 3 C7.5 8 7.5 16 12 21 M12 3 C16.5 8 16.5 16 12 21"
            title: overlays.words["control-language"]
            choices: overlays.attract.ways.filter(way => overlays.kiosk.languages.includes(way.language))
                .map(way => ({ name: `language-${way.language}`, words: way.name, quiet: way.language !== overlays.kiosk.language }))
            onChosen: name => overlays.kiosk.selectLanguage(name.slice("language-".length))
            Keys.onEscapePressed: overlays.kiosk.ask("")
        }
    }
    // Made anew each time, and kept while something else covers it.
    Loader {
        anchors.fill: parent
        active: overlays.kiosk.asks === "code"
        visible: overlays.asks === "code"
        focus: visible
        enabled: overlays.kiosk.takesInput
        sourceComponent: CodeCard {
            focus: true
            returning: overlays.returning
            words: overlays.words
            onWentAway: {
                overlays.kiosk.ask("")
                overlays.returning.clear()
            }
        }
    }
    Overlay {
        shown: ["welcome", "unknown"].includes(overlays.asks)
        sourceComponent: CalmCard {
            focus: true
            title: overlays.words[overlays.kiosk.asks === "unknown" ? "return-as-new" : "return-welcome"]
            choices: [{ name: "return-on", words: overlays.words["about-continue"] }]
            onChosen: overlays.kiosk.ask("")
            Keys.onEscapePressed: overlays.kiosk.ask("")
        }
    }
    // There is nothing to be done to it.
    PartLoader {
        anchors.fill: parent
        shown: overlays.kiosk.waits && overlays.kiosk.screen !== "pause"
        needed: overlays.needed
        prepares: overlays.prepares
        sourceComponent: CalmCard {
            objectName: "wait"
            sign: "M6 4 H18 M6 20 H18 M7 4 C7 9 12 10 12 12 C12 14 7 15 7 20 M17 4 C17 9 12 10 12 12 C12 14 17 15 17 20"
            title: overlays.words["wait-title"]
            line: overlays.words["wait-line"]
        }
    }
}
