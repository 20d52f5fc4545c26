// The last sessions and how they ended; what was not completed carries a mark.
pragma ComponentBehavior: Bound
import QtQuick

PanelTable {
    id: sessions

    required property var words
    required property var records

    title: words["console-sessions"]
    marked: true
    shown: ({
        heads: ["console-sessions-number", "console-sessions-begun", "console-sessions-condition", "console-sessions-stage", "console-sessions-status"].map(name => words[name]),
        rows: records.sessions.map(each => ({
            odd: each.odd,
            running: each.under_way,
            cells: [
                { words: each.participant, strong: true },
                { words: each.when, strong: false },
                { words: each.condition, strong: false },
                { words: each.stage, strong: false },
                { words: [each.status, each.reason, each.robot].filter(part => part !== "").join(" · "), strong: true }
            ]
        }))
    })

    PanelEmpty { words: sessions.words["console-sessions-none"]; font.pixelSize: sessions.size; visible: sessions.records.sessions.length === 0 }
}
