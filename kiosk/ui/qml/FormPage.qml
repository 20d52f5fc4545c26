// A page of a form at its place in the window, and the helper turned away beside it while it is rated.
import QtQuick
import Recollect
import "."

Item {
    id: page

    required property KioskScreen kiosk
    required property AvatarScreen avatar
    required property FormScreen form
    required property var words
    required property WindowLayout windowLayout
    // Whether it takes the size that there is for it; a page that is not seen keeps its own.
    required property bool follows
    // Whether the helper has left its place.
    required property bool helperGone
    readonly property alias keysBeside: formView.keysBeside
    readonly property alias lined: formView.lined

    TurnedAway {
        id: turnedAway
        anchors.fill: parent
        windowLayout: page.windowLayout
        form: formView
        gone: page.avatar.present && page.helperGone
        why: page.words["form-turned"]
    }
    FormView {
        id: formView
        x: page.windowLayout.pageX
        y: page.windowLayout.pageY
        Binding on width { when: page.follows; value: page.windowLayout.widthOn("form"); restoreMode: Binding.RestoreNone }
        Binding on height { when: page.follows; value: page.windowLayout.heightOn("form"); restoreMode: Binding.RestoreNone }
        Binding on accompanied { when: page.follows; value: page.windowLayout.accompanied && !page.avatar.away; restoreMode: Binding.RestoreNone }
        Binding on turned { when: page.follows; value: page.avatar.present && page.avatar.away; restoreMode: Binding.RestoreNone }
        focus: true
        sunk: turnedAway.slack / 2
        aligned: page.windowLayout.accompanied
        before: page.windowLayout.pageX
        form: page.form
        kiosk: page.kiosk
        words: page.words
    }
}
