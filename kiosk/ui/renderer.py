"""Carry out the effects of a session: screens, speech, timers and sounds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from functools import partial
from pathlib import Path
from typing import assert_never

from kiosk.config import ASSETS
from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait, Effect, Mood
from kiosk.experiment.events import Timer
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.experiment.session_config import SessionConfig
from kiosk.game import Position
from kiosk.robots.embodiment import ASIDE, Embodiment
from kiosk.robots.selector import EmbodimentSelector
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.screens.registry import ScreenSet


class SoundEffect(Enum):
    """A sound, by the name of its file; what comes first here goes before the others."""

    END = "end"
    MATCH = "match"
    MISS = "miss"
    FLIP = "flip"
    NUDGE = "nudge"
    """A card was touched that cannot be turned."""
    BUTTON = "button"
    ALARM = "alarm"
    """The experimenter is called."""

    @property
    def file(self) -> Path:
        """Where it is; packaging/make_sounds.py made it."""
        return ASSETS / "sounds" / f"{self.value}.wav"


def sound_for(effects: Iterable[Effect]) -> SoundEffect | None:
    """Return the sound for these effects; None if they begin a sentence, which is never made to wait."""
    heard: set[SoundEffect] = set()
    for effect in effects:
        match effect:
            case do.Speak():
                return None
            case do.StartTimer(timer=Timer.FINISH):
                heard.add(SoundEffect.END)
            case do.MarkMatched():
                heard.add(SoundEffect.MATCH)
            case do.LockBoard(wait=BoardWait.TURNING_BACK):
                heard.add(SoundEffect.MISS)
            case do.RevealCard():
                heard.add(SoundEffect.FLIP)
    return next((sound for sound in SoundEffect if sound in heard), None)


_FILLED: Mapping[type[Effect], str] = {
    do.ShowAbout: "about",
    do.ShowConsent: "consent",
    do.ShowAgeQuestion: "age",
    do.ShowIntroduction: "introduction",
    do.ShowBoard: "game",
    do.ShowResult: "result",
    do.ShowItems: "form",
    do.ShowDebrief: "debrief",
    do.ShowThanks: "thanks",
}
"""The page that an effect fills and then shows; a practice is on the page of the game."""

FEELING_MS = 1_800
"""How long the avatar looks glad at a pair, or thoughtful at two cards that are none, unless the session says more."""

INPUT_GUARD_MS = 400
"""How long a new screen takes no input; the slowest double click that desktops accept by default."""


class Renderer:
    """Carries out effects: shows them on the screens, has them said, and waits."""

    def __init__(self, screens: ScreenSet, clock: Clock, timer_expired: Callable[[Timer], None]) -> None:
        """Call ``timer_expired`` when a timer ends that was not stopped."""
        self.embodiments: EmbodimentSelector | None = None
        self.screens = screens
        self._clock = clock
        self._timer_expired = timer_expired
        self._waits: dict[Timer, TimerWait] = {}
        self._input_guard: TimerWait | None = None
        self._calming: TimerWait | None = None
        self._is_rated = False
        self._back: bool | None = None
        self._plan: SessionConfig | None = None
        screens.kiosk.screen_changed.connect(self._start_input_guard)
        screens.kiosk.screen_changed.connect(self._mind_screen)

    def begin(self, plan: SessionConfig) -> None:
        """Begin a session: everything speaks its language, and tells its contact."""
        self._plan = plan
        self.screens.set_language(plan.catalogue)
        self.screens.kiosk.begin(plan.languages, plan.language, plan.settings.consent)
        self.screens.debrief.give_contact(plan.settings.consent.contact)
        self.screens.debrief.give_summary(next(iter(plan.information.about.paragraphs), ""))
        self._is_rated = False
        if self.embodiments is not None:
            self.embodiments.begin_session(plan.language)

    def reset(self, screen: str) -> None:
        """Leave nothing of a session: no wait, no sound, and no screen that remembers; then show this one."""
        for timer in Timer:
            self._stop_wait(timer)
        self.screens.clear()
        self.screens.kiosk.show(screen)
        # Where the avatar comes back, the page of the last visitor is not laid out once more.
        if self.embodiments is not None:
            self.embodiments.end_session()

    def perform(self, effects: Iterable[Effect]) -> None:
        """Carry out these effects in their order."""
        for _ in self.steps(effects):
            pass

    def steps(self, effects: Iterable[Effect]) -> Iterator[None]:  # noqa: C901, PLR0912, PLR0915 - one case per effect
        """Carry out these effects in their order; yields where the event loop may do other things in between."""
        screens = self.screens
        effects = tuple(effects)
        # A page is laid out once, with the way back that it has.
        self._back = next((effect.offered for effect in effects if isinstance(effect, do.OfferBack)), None)
        for effect in effects:
            if type(effect) in _FILLED:
                screens.kiosk.expect(_FILLED[type(effect)])
            match effect:
                case do.ShowAbout(page=page):
                    screens.about.show(page)
                    yield from self._turn_to("about")
                case do.ShowConsent(page=sheet):
                    screens.consent.show(sheet)
                    yield from self._turn_to("consent")
                case do.ShowTicks(purposes=purposes):
                    screens.consent.show_ticks(purposes)
                case do.ShowAgeQuestion(adult=adult):
                    screens.age.ask(adult)
                    yield from self._turn_to("age")
                case do.ShowIntroduction(helped=helped, points=points):
                    screens.introduction.show(helped=helped, points=points)
                    yield from self._turn_to("introduction")
                case do.ShowBoard(practice=practice):
                    board = screens.board
                    # What was asked before is not laid out anew whenever a robot comes or goes.
                    screens.form.clear()
                    yield
                    board.clear_table(effect.rows, effect.columns, effect.pairs, effect.deck, practice=practice)
                    # To make the cards is a step of its own.
                    yield
                    board.lay_cards()
                    yield from self._turn_to("practice" if practice else "game")
                case do.RevealCard(position=position, card=card):
                    screens.board.reveal(position, card)
                    screens.avatar.feel(None)
                    self._watch_card(position)
                case do.HideCards(positions=positions):
                    screens.board.hide(positions)
                case do.MarkMatched(positions=positions):
                    screens.board.mark_matched(positions)
                    screens.avatar.feel(Mood.HAPPY)
                    self._start_calming()
                case do.ShowProgress(pairs_found=pairs_found, moves=moves):
                    screens.board.show_progress(pairs_found, moves)
                case do.LockBoard(wait=wait):
                    screens.board.lock(wait)
                    if wait is BoardWait.TURNING_BACK:
                        screens.avatar.feel(Mood.THINKING)
                        self._start_calming()
                case do.UnlockBoard():
                    screens.board.lock(None)
                case do.HighlightHint(row=row, column=column):
                    screens.board.highlight(row, column)
                    if self._body is not None:
                        self._body.look_at(screens.board.place(row, column))
                case do.LookAt(row=row, column=column):
                    screens.board.looked_at = (row, column)
                    if self._body is not None:
                        self._body.look_at(screens.board.place(row, column))
                case do.ClearHighlight():
                    screens.board.clear_highlight()
                    if self._body is not None:
                        self._body.look_at(None)
                case do.Speak(utterance=utterance, sentence=sentence, advice=advice):
                    screens.avatar.feel(None)
                    screens.avatar.say(sentence, advice)
                    if self._body is not None:
                        self._body.say(utterance, sentence)
                case do.StopSpeaking():
                    if self._body is not None:
                        self._body.stop()
                case do.SwitchEmbodiment(embodiment=name):
                    if self.embodiments is not None:
                        self.embodiments.switch_to(name)
                case do.ClearBubble():
                    screens.avatar.say("")
                case do.SetExpression(mood=mood):
                    if self._body is not None:
                        self._body.express(mood)
                case do.ShowResult(pairs=pairs, moves=moves, time_ms=time_ms, hints=hints):
                    screens.result.show(pairs, moves, time_ms, hints, screens.board.found)
                    yield from self._turn_to("result")
                case do.ShowItems(items, number, of=pages, rates=rates, hidden=hidden, title=title, alike=alike):
                    self._let_be_rated(rated=rates)
                    screens.form.show(items, number, pages, hidden, title, alike)
                    yield from self._turn_to("form")
                case do.HideItems(items=hidden):
                    screens.form.hide(hidden)
                case do.ShowAnswer(item=item, value=value):
                    screens.form.show_answer(item, value)
                case do.ShowValidationErrors(names=names):
                    (screens.consent if screens.kiosk.shown == "consent" else screens.form).show_missing(names)
                case do.ShowDebrief(page=page):
                    screens.debrief.show(page)
                    yield from self._turn_to("debrief")
                case do.ShowThanks():
                    yield from self._turn_to("thanks")
                case do.ShowPause():
                    screens.kiosk.pause(paused=True)
                case do.HidePause():
                    screens.kiosk.pause(paused=False)
                case do.AskStillThere(wait_ms=wait_ms):
                    screens.kiosk.ask_still_there(asks=True, wait_ms=wait_ms)
                case do.HideStillThere():
                    screens.kiosk.ask_still_there(asks=False)
                case do.OfferBack(offered=offered):
                    screens.kiosk.offer_back(offered=offered)
                case do.SetLanguage(language=language):
                    self._set_language(language)
                case do.SetTextSize(size=size):
                    screens.kiosk.set_text_size(size)
                case do.SetSound(on=on):
                    screens.kiosk.set_sound(on=on)
                    if self.embodiments is not None:
                        self.embodiments.set_sound(on=on)
                case do.StartTimer(timer=timer, after_ms=after_ms):
                    self._stop_wait(timer)
                    # The wait may stay here when it is over: to cancel it then changes nothing.
                    self._waits[timer] = self._clock.after(after_ms, partial(self._timer_expired, timer))
                case do.StopTimer(timer=timer):
                    self._stop_wait(timer)
                case _ as unreachable:
                    assert_never(unreachable)

    def _turn_to(self, page: str) -> Iterator[None]:
        """Show a page that is filled."""
        yield from self._while_unseen(page)
        self.screens.kiosk.show(page, goes_back=self._back)

    def _while_unseen(self, page: str) -> Iterator[None]:
        """Yield between filling a page and showing it: together they would hold up the loop for two frames.

        A page that is on the screen already must not be seen half changed.
        """
        if self.screens.kiosk.shown != page:
            yield

    @property
    def body_name(self) -> EmbodimentName | None:
        """The name of the body that helps now."""
        return None if self._body is None else self._body.name

    @property
    def _body(self) -> Embodiment | None:
        """The body that helps now."""
        return None if self.embodiments is None else self.embodiments.current

    def _watch_card(self, position: Position) -> None:
        """Let the avatar nod if the hinted card was turned."""
        board = self.screens.board
        if board.is_marked(position):
            self.screens.avatar.gesture("nod")

    def _start_calming(self) -> None:
        """Let what the avatar feels about a move pass."""
        if self._calming is not None:
            self._calming.cancel()
        self._calming = self._clock.after(FEELING_MS, partial(self.screens.avatar.feel, None))

    def _let_be_rated(self, *, rated: bool) -> None:
        """Let the avatar turn its back and a robot look aside while they are rated; both come back."""
        if rated == self._is_rated:
            return
        self._is_rated = rated
        self.screens.avatar.leave(away=rated)
        if self._body is not None:
            self._body.look_at(ASIDE if rated else None)

    def _mind_screen(self) -> None:
        if self.screens.kiosk.shown != "form":
            self._let_be_rated(rated=False)

    def _set_language(self, language: str) -> None:
        translation = None if self._plan is None else self._plan.translation(language)
        if translation is not None:
            self.screens.set_language(translation.catalogue)
            if self.embodiments is not None:
                self.embodiments.set_language(language)

    def _start_input_guard(self) -> None:
        """Take no input for a moment: the second half of a double click belongs to what was shown before."""
        if self._input_guard is not None:
            self._input_guard.cancel()
        self._input_guard = self._clock.after(INPUT_GUARD_MS, self.screens.kiosk.end_input_guard)

    def _stop_wait(self, timer: Timer) -> None:
        wait = self._waits.pop(timer, None)
        if wait is not None:
            wait.cancel()
