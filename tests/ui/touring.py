"""A tour of everything there is to be seen: every screen of a whole session, what lies over them, and the panel."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtQuick import QQuickWindow
from PySide6.QtTest import QTest

from kiosk.config import ASSETS, Settings
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.experimenter import hash_pin
from kiosk.experiment.items import TextPage
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.ui.app import App
from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.experimenter.view_model import AuthorisationStep
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import NO_KEY, Aside, UiDriver, UiTimeout, find_item, lay_out
from tests.ui.headless import SMALL
from tests.ui.reaching import Keyboard

SEED = 1
"""With this seed the visitor practises."""
PIN, WRONG = "258013", "9999"
SHORTCUT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
ASKED: dict[str, Item] = {item.kind: item for item in GALLERY.items if not isinstance(item, TextPage)}
"""An item of every kind that is answered."""

Look = Callable[[str], None]
"""Looks at the window, with what stands there."""


def whole_study(first: str = "en", **screen: object) -> Settings:
    """Every stage, every kind of item, and an experimenter with a PIN, who reads the language that comes ``first``.

    ``screen`` is that section of the study file.
    """
    languages = sorted(SMALL.languages, key=lambda language: language != first)
    more = {"languages": languages, "screen": screen, "experimenter": {"pin_hash": hash_pin(PIN, bytes(16), cost=10)}}
    return Settings.model_validate({**SMALL.model_dump(exclude={"experimenter", "languages"}), **more})


class Looking(UiDriver):
    """A hand whose owner looks at every new screen before doing anything to it."""

    def __init__(self, window: QQuickWindow, aside: Aside, app: App, look: Look) -> None:
        """``look`` is called once for everything new that there is."""
        super().__init__(window, aside)
        self._app = app
        self._look = look
        self._seen: set[str] = set()

    def click(self, name: str, across: float = 0.5) -> None:
        """Look first, if this was not seen yet."""
        moment = self._moment(name)
        if moment not in self._seen:
            self._seen.add(moment)
            looked_at(self._app, self._look, moment)
            self._look_at_what_lacks(moment)
        super().click(name, across)

    def _moment(self, name: str) -> str:
        """Return what stands there, in words; a form counts once empty, once filled in, and once with its keys."""
        shown, form = self._app.screens.kiosk.shown, self._app.screens.form
        if shown != "form":
            return f"{shown}{', agreed' if name == 'agree' else ''}"
        kinds = ", ".join(item.kind for item in form.shown)
        return f"form: {kinds}{', keys' if name.startswith('key-') else ', filled in' if form.given else ''}"

    def _look_at_what_lacks(self, moment: str) -> None:
        """Look at the same screen with something that has to be done first."""
        screens = self._app.screens
        if moment == "consent":
            screens.consent.show_missing(screens.consent.offered)
        elif screens.kiosk.shown == "form" and not screens.form.given and "page" not in moment and "keys" not in moment:
            screens.form.show_missing(tuple(item.id for item in screens.form.shown))
        else:
            return
        looked_at(self._app, self._look, f"{moment}, missing")


def looked_at(app: App, look: Look, moment: str) -> None:
    """Look, when everything is where it belongs."""
    lay_out(app.window)
    try:
        look(moment)
    except Exception as fault:
        # It would be taken for a fault of the kiosk's, and the session would never end.
        raise UiTimeout(f"{moment} could not be looked at: {fault!r}") from fault


def tour(app: App, look: Look) -> None:
    """Look at everything there is, in the order in which it comes, in the study's first language."""
    Rehearsal(app, SEED, hand=partial(Looking, app=app, look=look)).run()
    look_over(app, look)
    look_behind(app, look)


def look_over(app: App, look: Look) -> None:
    """Look at the marks, at what is said meanwhile, and at the calm words that lie over everything."""
    screens = app.screens
    screens.avatar.say("Something that is said.")
    screens.board.deal(2, 3, 3, "animals")
    screens.kiosk.show("game")
    screens.kiosk.end_input_guard()
    for wait in BoardWait:
        screens.board.lock(wait)
        looked_at(app, look, f"game, {wait.value}")
    screens.board.lock(None)
    for name, row, column in (("row", 1, None), ("column", None, 1), ("card", 1, 1)):
        screens.board.highlight(row, column)
        looked_at(app, look, f"game, a {name} is marked")
    screens.board.clear_highlight()
    screens.kiosk.ask_still_there(asks=True)
    screens.kiosk.end_input_guard()
    looked_at(app, look, "still there")
    screens.kiosk.ask_still_there(asks=False)
    screens.kiosk.show("pause")
    looked_at(app, look, "pause")
    screens.clear()
    screens.attract.show_trial("Ctrl+Shift+F12")
    screens.kiosk.show("attract")
    screens.kiosk.end_input_guard()
    looked_at(app, look, "attract, a trial")


def look_behind(app: App, look: Look) -> None:
    """Look at the experimenter's card, note and panel, while a visitor is there."""
    card, note, _ = app.screens.experimenter.parts
    hand = UiDriver(app.window)
    hand.click(f"start-{app.screens.resting.language}")
    press(app, Qt.Key.Key_P, SHORTCUT)
    hand.type(PIN[:2])
    looked_at(app, look, "card: pin")
    hand.type(WRONG)
    press(app, Qt.Key.Key_Return)
    assert card.asks_for is AuthorisationStep.WAIT
    looked_at(app, look, "card: wait")
    wait_until(app, lambda: card.asks_for is AuthorisationStep.PIN)
    hand.type(PIN)
    press(app, Qt.Key.Key_Return)
    assert app.experimenter.panel.is_open
    wait_until(app, lambda: find_item(app.window.contentItem(), "resume-1") is None)
    looked_at(app, look, "panel: today")
    hand.click("panel-sessions")
    looked_at(app, look, "panel: sessions")
    hand.click("names")
    hand.click("panel-next")
    hand.click("condition-tom")
    looked_at(app, look, "panel, card: reason")
    hand.type("5")
    looked_at(app, look, "panel, card: words")
    hand.type("a try")
    press(app, Qt.Key.Key_Return)
    wait_until(app, lambda: note.property("text") == "")
    looked_at(app, look, "panel")
    press(app, Qt.Key.Key_Escape)
    for chosen in (0, 2):
        note.point(chosen, 3)
        looked_at(app, look, "note: dots")
    note.tell("Heard again")
    looked_at(app, look, "note")
    note.hide()


def press(app: App, key: Qt.Key, modifiers: Qt.KeyboardModifier = NO_KEY) -> None:
    """Press and release a key."""
    QTest.keyClick(app.window, key, modifiers)


def wait_until(app: App, condition: Callable[[], bool]) -> None:
    """Let time pass until something is so; nothing here takes a thousand waits."""
    assert isinstance(app.clock, VirtualClock)
    for _ in range(1_000):
        if condition():
            return
        app.clock.jump()
    raise UiTimeout("it never came")


def open_panel(app: App) -> Keyboard:
    """Open the panel with its shortcut and the PIN."""
    keyboard = Keyboard(app.window)
    keyboard.press(Qt.Key.Key_P, SHORTCUT)
    keyboard.type(PIN)
    keyboard.press(Qt.Key.Key_Return)
    wait_until(app, lambda: app.screens.kiosk.takes_input)
    return keyboard
