"""The window as a whole: which screen is shown, and what lies over it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import Property, QLocale, QObject, Qt, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.config import ConsentConfig
from kiosk.experiment.events import SoundSelected, TextSize, TextSizeSelected
from kiosk.ui.screens.fixed_texts import fixed_texts

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

_TEXT_SCALES = {TextSize.NORMAL: 1.0, TextSize.LARGE: 1.15, TextSize.LARGEST: 1.3}

_PARTS = (
    ("about", "age", "consent", "about_you"),
    ("introduction", "practice"),
    ("game", "result"),
    ("questions",),
    ("debrief", "thanks"),
)
"""The stages that are one part of a visit to those who visit."""


@QmlElement
class KioskScreen(QObject):
    """The window as a whole: which screen is shown, in which language, and what lies over it."""

    changed = Signal()
    spoken = Signal()
    """Another language is spoken; apart from ``changed``, because all texts follow."""
    confirmed = Signal()
    """The visitor said that they are still there."""
    screen_changed = Signal()
    """Something else is shown than a moment ago."""
    expected = Signal()
    """Another page is filled, and shown a moment later."""
    pressed = Signal()
    """A button was pressed, whichever it was."""
    chosen = Signal()
    """A person chose text size or sound on the start screen."""
    controls = Signal()
    """What the visitor can do in the corner has changed."""
    stopped = Signal()
    """The visitor stops, and has confirmed it."""
    went_back = Signal()
    asked_again = Signal()
    """The visitor wants to hear the last sentence again."""
    language_selected = Signal(str)
    text_size_selected = Signal(str)
    sound_selected = Signal(bool)

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._words = fixed_texts(catalogue)
        self._screen = "attract"
        self._coming = ""
        self._asks_still_there = False
        self._answer_ms = 0
        self._paused = self._behind_panel = self._waits = False
        self._back_at = ""
        self._leaving = False
        self._takes_input = True
        self._catalogue = catalogue
        self._languages: tuple[str, ...] = ()
        self._language = catalogue.language
        self._consent: ConsentConfig | None = None
        self._code = ""
        self._text_size = TextSize.NORMAL
        self._sound = self._audible = True
        self._goes_back = False
        self._asks: str = ""
        self._parts: tuple[tuple[str, ...], ...] = ()
        self._step = -1

    def plan(self, stages: Sequence[str]) -> None:
        """Count the parts of a visit that has these stages."""
        self._parts = tuple(part for part in _PARTS if any(stage in stages for stage in part))

    def reach(self, stage: str) -> None:
        """Show how far the visit is, by the name of its stage."""
        step = next((number for number, part in enumerate(self._parts) if stage in part), -1)
        if step != self._step:
            self._step = step
            self.controls.emit()

    def begin(self, languages: Sequence[str], language: str, consent: ConsentConfig) -> None:
        """Show that a visitor can go on in one of these languages, or stop."""
        self._languages, self._language, self._consent = tuple(languages), language, consent
        self.controls.emit()

    def give_code(self, code: str) -> None:
        """Keep the code of what is recorded, for a visitor who stops; empty while nothing is."""
        if code != self._code:
            self._code = code
            self.controls.emit()

    def offer_back(self, *, offered: bool) -> None:
        """Let the visitor go back to the page before, or not."""
        if offered is not self._goes_back:
            self._goes_back = offered
            self.controls.emit()

    def set_text_size(self, size: TextSize) -> None:
        """Show all texts in this size."""
        self._text_size = size
        self.controls.emit()

    def set_sound(self, *, on: bool) -> None:
        """Show whether the visitor hears voice and sounds."""
        self._sound = on
        self.controls.emit()

    def set_audible(self, *, audible: bool) -> None:
        """Offer the sound as a choice only where there is any, so that no button promises what is not heard."""
        self._audible = audible
        self.controls.emit()

    def set_language(self, catalogue: Catalogue) -> None:
        """Show every fixed text in this language."""
        if catalogue is self._catalogue and catalogue.language == self._language:
            return  # so that no text is laid out anew
        self._words = fixed_texts(catalogue)
        self._catalogue, self._language = catalogue, catalogue.language
        self.spoken.emit()
        self.controls.emit()

    def expect(self, screen: str) -> None:
        """Let the page of this name get the size that it is shown in, before it is filled."""
        if screen != self._coming:
            self._coming = screen
            self.expected.emit()

    def show(self, screen: str, *, goes_back: bool | None = None) -> None:
        """Show the screen of this name, which may have a way back; it takes no input until ``end_input_guard``."""
        self._screen = screen
        self._asks = ""
        self._goes_back = self._goes_back if goes_back is None else goes_back
        self._start_input_guard()
        # By now the page before is out of sight, and not laid out once more for this.
        self.controls.emit()
        self.expect("")

    def end_input_guard(self) -> None:
        """Take input: a double click on the last screen is over by now."""
        self._takes_input = True
        self.changed.emit()

    def ask_still_there(self, *, asks: bool, wait_ms: int = 0) -> None:
        """Ask over whatever is shown, with the time left where one is given; or stop asking."""
        if asks != self._asks_still_there:
            self._asks_still_there = asks
            self._answer_ms = wait_ms if asks else 0
            self._asks = ""
            self.controls.emit()
            self._start_input_guard()

    def pause(self, *, paused: bool) -> None:
        """Cover everything with a calm word, or take it away."""
        if paused != self._paused:
            self._paused = paused
            self._back_at = ""
            self.controls.emit()
            self._start_input_guard()

    def come_back_at(self, time: str) -> None:
        """Show on the pause screen when it goes on, such as "14:05"; an empty text says no time."""
        self._back_at = time
        self.controls.emit()

    def wait(self, *, waits: bool) -> None:
        """Ask the visitor for a moment, over whatever is shown, or let them go on."""
        if waits != self._waits:
            self._waits = waits
            self._start_input_guard()

    def step_back(self, steps_back: bool) -> None:  # noqa: FBT001 - it is what is set
        """Leave input to the experimenter's panel, or take it again."""
        self._behind_panel = steps_back
        self._start_input_guard()

    def clear(self) -> None:
        """Nothing of a session lies over the screen."""
        self.ask_still_there(asks=False)
        self.pause(paused=False)
        self.wait(waits=False)
        self._languages, self._consent, self._code = (), None, ""
        self._text_size, self._sound, self._goes_back, self._asks = TextSize.NORMAL, True, False, ""
        self._step = -1
        self.controls.emit()

    @property
    def back_at(self) -> str:
        """The time at which a break is over, such as "14:05"; empty without one."""
        return self._back_at

    @property
    def shown(self) -> str:
        """The name of the screen that is shown."""
        return self._screen

    @property
    def spoken_language(self) -> str:
        """The code of the language that is shown."""
        return self._language

    @property
    def takes_input(self) -> bool:
        """Whether what is shown can be tapped."""
        return self._takes_input

    @property
    def waits_for_answer(self) -> bool:
        """Whether the visitor is asked if they are still there, and nothing lies over that question."""
        return self._asks_still_there and not (self._paused or self._waits or self._behind_panel)

    @property
    def covered(self) -> bool:
        """Whether a question, a calm word or the experimenter's panel lies over the screen."""
        return self._asks_still_there or self._paused or self._waits or self._behind_panel or bool(self._asks)

    @Property("QVariantMap", notify=spoken)  # type: ignore[arg-type]  # the stubs know no names of Qt's types
    def words(self) -> dict[str, str]:
        """Return the fixed texts, by the names of their messages."""
        return self._words

    @Property(str, notify=changed)
    def screen(self) -> str:
        """Return the name of the screen that is shown."""
        return self._screen

    @Property(str, notify=expected)
    def coming(self) -> str:
        """Return the name of the page that is filled to be shown next; empty while none is."""
        return self._coming

    @Property(bool, notify=changed)
    def asksStillThere(self) -> bool:  # noqa: N802 - QML's convention
        """Whether the visitor is asked if they are still there."""
        return self._asks_still_there and not (self._paused or self._waits)

    @Property(int, notify=changed)
    def answerMs(self) -> int:  # noqa: N802 - QML's convention
        """How long an answer to that question is waited for; 0 where nothing is asked, or no time is known."""
        return self._answer_ms

    @Property(bool, notify=changed)
    def waits(self) -> bool:
        """Whether the visitor is asked for a moment."""
        return self._waits and not self._paused

    @Property(bool, notify=changed)
    def paused(self) -> bool:
        """Whether a calm word covers everything."""
        return self._paused

    @Property(bool, notify=changed)
    def bare(self) -> bool:
        """Whether nothing lies over the screen."""
        return not self.covered

    @Property(bool, notify=changed)
    def takesInput(self) -> bool:  # noqa: N802 - QML's convention
        """Whether what is shown can be tapped."""
        return self._takes_input

    @Property(bool, notify=changed)
    def leaving(self) -> bool:
        """Whether the window may be closed."""
        return self._leaving

    def let_go(self) -> None:
        """Let the window be closed."""
        self._leaving = True
        self.changed.emit()

    @Slot()
    def confirm(self) -> None:
        """Report that the visitor is still there."""
        self.confirmed.emit()

    # The corner

    @Property(int, notify=controls)
    def steps(self) -> int:
        """How many parts a visit has."""
        return len(self._parts)

    @Property(int, notify=controls)
    def step(self) -> int:
        """Return the number of the part that the visit is in, from 0; -1 without a visit."""
        return self._step

    @Property(bool, notify=controls)
    def inSession(self) -> bool:  # noqa: N802 - QML's convention
        """Whether a visitor is there, who can stop."""
        return self._consent is not None

    @Property(bool, notify=controls)
    def goesBack(self) -> bool:  # noqa: N802 - QML's convention
        """Whether there is a page to go back to."""
        return self._goes_back

    @Property(str, notify=controls)
    def asks(self) -> str:
        """Return what the corner asks over the screen: ``stop``, ``language``, ``code``, or nothing."""
        return self._asks

    @Property(float, notify=controls)
    def textScale(self) -> float:  # noqa: N802 - QML's convention
        """How many times larger than usual the visitor has the texts."""
        return _TEXT_SCALES[self._text_size]

    @Property(int, notify=controls)
    def textStep(self) -> int:  # noqa: N802 - QML's convention
        """Return the step of the text size, from 0."""
        return list(TextSize).index(self._text_size)

    @Property(bool, notify=controls)
    def sound(self) -> bool:
        """Whether the visitor hears voice and sounds."""
        return self._sound

    @Property(bool, notify=controls)
    def audible(self) -> bool:
        """Whether there is anything to be heard."""
        return self._audible

    @Property(str, notify=controls)
    def language(self) -> str:
        """Return the code of the language that is shown."""
        return self._language

    @Property(bool, notify=controls)
    def mirrored(self) -> bool:
        """Whether the language is written from right to left, and the page laid out so."""
        return QLocale(self._language).textDirection() == Qt.LayoutDirection.RightToLeft

    @Property(list, notify=controls)
    def languages(self) -> list[str]:
        """Return the codes of the languages to choose from; fewer than two are no choice."""
        return list(self._languages)

    @Property(str, notify=controls)
    def stopLine(self) -> str:  # noqa: N802 - QML's convention
        """Return what becomes of what is recorded if the visitor stops now."""
        if self._consent is None or not self._code:
            return self._catalogue.text("stop-line-nothing")
        if self._consent.on_withdrawal == "delete":
            return self._catalogue.text("stop-line-deleted")
        return self._catalogue.text("stop-line-kept", code=self._code)

    @Property(str, notify=controls)
    def stopCode(self) -> str:  # noqa: N802 - QML's convention
        """Return the code with which a visitor who stops can have it deleted; empty if nothing is kept."""
        return self._code if self._consent is not None and self._consent.on_withdrawal != "delete" else ""

    @Property(str, notify=controls)
    def pauseLine(self) -> str:  # noqa: N802 - QML's convention
        """Return what the pause screen says below its title: when it goes on, or who paused it."""
        if self._back_at:
            return self._catalogue.text("pause-back", time=self._back_at)
        # A pause goes on by itself; the screen of that name waits for the experimenter.
        return self._catalogue.text("pause-help" if self._screen == "pause" else "pause-line")

    @Property(str, notify=controls)
    def pauseMore(self) -> str:  # noqa: N802 - QML's convention
        """Return what else the visitor should know about the pause; empty if there is nothing."""
        if self._screen != "pause":
            return self._catalogue.text("pause-kept")
        return self._catalogue.text("pause-then") if self._back_at else ""

    @Property(bool, notify=controls)
    def pauseEnds(self) -> bool:  # noqa: N802 - QML's convention
        """Whether the pause screen says when the people at the table are back."""
        return self._back_at != ""

    @Slot(str)
    def ask(self, what: str) -> None:
        """Ask over the screen whether to ``stop``, or for a ``language``; with nothing, ask no longer."""
        self._asks = what
        self.controls.emit()
        self._start_input_guard()

    @Slot()
    def stop(self) -> None:
        """Stop, after the visitor was asked."""
        self.ask("")
        self.stopped.emit()

    @Slot()
    def goBack(self) -> None:  # noqa: N802 - QML's convention
        """Go back to the page before."""
        self.went_back.emit()

    @Slot()
    def sayAgain(self) -> None:  # noqa: N802 - QML's convention
        """Say the last sentence again."""
        self.asked_again.emit()

    @Slot(str)
    def selectLanguage(self, language: str) -> None:  # noqa: N802 - QML's convention
        """Go on in this language."""
        self.ask("")
        if language != self._language:
            self.language_selected.emit(language)

    @Slot()
    def changeTextSize(self) -> None:  # noqa: N802 - QML's convention
        """Show the next size of texts; after the largest comes the usual one."""
        sizes = list(TextSize)
        size = sizes[(sizes.index(self._text_size) + 1) % len(sizes)]
        if self._consent is not None:
            self.text_size_selected.emit(size.value)
        else:
            self.set_text_size(size)
            self.chosen.emit()

    @Slot()
    def changeSound(self) -> None:  # noqa: N802 - QML's convention
        """Turn sound off, or on again."""
        if self._consent is not None:
            self.sound_selected.emit(not self._sound)
        else:
            self.set_sound(on=not self._sound)
            self.chosen.emit()

    def forget_choices(self) -> None:
        """Take back what was chosen on the start screen by a person who has not begun."""
        if self._consent is None:
            self.set_text_size(TextSize.NORMAL)
            self.set_sound(on=True)

    def choices(self, at_ms: int) -> Iterator[TextSizeSelected | SoundSelected]:
        """Yield what was chosen on the start screen, for the session that begins there."""
        if self._text_size is not TextSize.NORMAL:
            yield TextSizeSelected(at_ms=at_ms, size=self._text_size)
        if not self._sound:
            yield SoundSelected(at_ms=at_ms, on=False)

    def _start_input_guard(self) -> None:
        self._takes_input = False
        self.changed.emit()
        self.screen_changed.emit()

    @Slot()
    def press(self) -> None:
        """Report that a button was pressed."""
        self.pressed.emit()
