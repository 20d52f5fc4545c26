"""The attract screen: a game that plays itself, a helper, and a start for each language."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.effects import Mood
from kiosk.ui.event_loop import Clock
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.shell import KioskScreen

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

MOST_PAIRS = 4
"""More cards could not be made out from three metres away."""


@QmlElement
class AttractScreen(QObject):
    """A small board, a title in one language after another, and a way in for each of them."""

    changed = Signal()
    dealt = Signal()
    """Other cards lie on the board, all of them closed."""
    turned = Signal(int)
    """This card was turned up."""
    started = Signal(str)
    """A visitor begins, in this language."""

    def __init__(self, pictures: Sequence[str], catalogues: Sequence[Catalogue], parent: QObject | None = None) -> None:
        """Show these pictures; the first of the languages is shown first."""
        super().__init__(parent)
        self._pictures = list(pictures)
        self._catalogues = tuple(catalogues)
        # QML asks for it at every item of the list that it looks at.
        self._ways = [
            {
                "language": catalogue.language,
                "name": catalogue.text("language-name"),
                "start": catalogue.text("attract-start"),
            }
            for catalogue in self._catalogues
        ]
        self._language = self._first = 0
        self._trial: str | None = None
        self._cards = self._at_rest = 2 * self._pictures[:MOST_PAIRS]
        self._up: list[int] = []
        self._found: list[int] = []
        self.clear()

    def show_trial(self, shortcut: str) -> None:
        """Say that this is a trial, and by which shortcut it is left; it may have none."""
        self._trial = shortcut
        self.changed.emit()

    @property
    def resting(self) -> Catalogue:
        """The language while no visitor is there."""
        return self._catalogues[self._first]

    def rest_in(self, language: str) -> None:
        """Show this language first, from the end of the next session on."""
        self._first = [catalogue.language for catalogue in self._catalogues].index(language)

    def deal(self, rng: Random) -> None:
        """Lay out the cards anew, all closed."""
        self._up, self._found = [], []
        self._cards = rng.sample(self._at_rest, len(self._at_rest))
        self.dealt.emit()
        self.changed.emit()

    def turn(self, card: int) -> None:
        """Turn a card up."""
        self._up.append(card)
        self.changed.emit()
        self.turned.emit(card)

    def close(self) -> None:
        """Turn back whatever is up; of a pair that was found, too, once there is no other card."""
        if self.closed:
            self._up = list(self._found)
        else:
            self._up, self._found = [], []
        self.changed.emit()

    def keep(self) -> None:
        """Keep the cards that are up as found."""
        self._found = list(self._up)
        self.changed.emit()

    @property
    def cards(self) -> tuple[str, ...]:
        """Which picture lies where."""
        return tuple(self._cards)

    @property
    def closed(self) -> tuple[int, ...]:
        """Where closed cards lie."""
        return tuple(place for place in range(len(self._cards)) if place not in self._up)

    @property
    def language(self) -> str:
        """The language of the moment, by its code."""
        return self._catalogues[self._language].language

    def next_language(self) -> None:
        """Show the title in the next language."""
        self._language = (self._language + 1) % len(self._catalogues)
        self.changed.emit()

    @property
    def greetings(self) -> tuple[str, ...]:
        """What may be shown to people who pass, in the language of the moment."""
        return self._catalogues[self._language].wordings("attract-greeting")

    def clear(self) -> None:
        """Begin anew in the first language, with a found pair, so that a still screen shows one."""
        self._language = self._first
        self._cards = self._at_rest
        self._up = self._found = [1, 1 + len(self._at_rest) // 2] if len(self._at_rest) > 2 else []  # noqa: PLR2004 - one pair
        self.dealt.emit()
        self.changed.emit()

    @Property(list, constant=True)
    def pictures(self) -> list[str]:
        """Where the pictures of the cards are, as addresses."""
        return self._pictures

    @Property(list, notify=dealt)
    def layout(self) -> list[str]:
        """Return the pictures in the order of the places on the board, as addresses."""
        return list(self._cards)

    @Property(list, notify=changed)
    def up(self) -> list[int]:
        """Which places show their pictures."""
        return list(self._up)

    @Property(list, notify=changed)
    def found(self) -> list[int]:
        """Which places show pairs that were found."""
        return list(self._found)

    @Property(str, notify=changed)
    def title(self) -> str:
        """Return the title, in the language of the moment."""
        return self._text("attract-title")

    @Property(str, notify=changed)
    def line(self) -> str:
        """Return the line below it, in the same language."""
        return self._text("attract-line")

    @Property(str, notify=changed)
    def promise(self) -> str:
        """Return what a visit takes and what it does not ask for; empty if nothing is promised."""
        return self._text("attract-promise")

    @Property(str, notify=changed)
    def trial(self) -> str:
        """Return that this is a trial, and how it is left; empty if it is none."""
        if self._trial is None:
            return ""
        text = self._catalogues[self._language].text
        return text("attract-trial", shortcut=self._trial) if self._trial else text("attract-trial-keyless")

    @Property(list, constant=True)
    def ways(self) -> list[dict[str, str]]:
        """Return the ways in, one for each language: its code, its name, and "start" in it."""
        return self._ways

    @Slot(str)
    def start(self, language: str) -> None:
        """Begin for a visitor, in this language."""
        self.started.emit(language)

    def _text(self, message: str) -> str:
        return self._catalogues[self._language].text(message)


REST_MS = (700, 1_600)
"""Between two acts without a session."""
PLAYING_PAUSE_MS = (2_500, 6_000)
"""The same during a session."""
BLINK_MS = 120
GLANCE_MS = 900
GLANCE_FAR = 0.3
LOOK_MS = 1_100
"""How long a card is looked at before anything else is done."""
TURN_MS = 600
FEEL_MS = 1_500
REJOICE_MS = 2_600
MOVES_PER_LANGUAGE = 2
"""Each language stays for about ten seconds."""
MEMORY = 0.8
LUCK = 0.3
"""How often the one who plays finds the mate of a card, seen before or not: a pair comes every two or three moves."""

Waits = Iterator[int]
"""Does one thing after another, and says how long each takes, in ms."""


class IdleLife:
    """Keeps the screen alive: plays a game while no visitor is there, and blinks while one is."""

    def __init__(
        self, kiosk: KioskScreen, avatar: AvatarScreen, attract: AttractScreen, clock: Clock, rng: Random
    ) -> None:
        """Begin at once, and never end."""
        self._kiosk = kiosk
        self._avatar = avatar
        self._attract = attract
        self._clock = clock
        self._rng = rng
        self._greeting = ""
        self._alone = self._nobody_plays
        self._acts = self._begin()
        kiosk.screen_changed.connect(self._mind_visitor)
        self._step()

    @property
    def _nobody_plays(self) -> bool:
        return self._kiosk.shown == "attract"

    def _begin(self) -> Waits:
        return self._play() if self._alone else self._live()

    def _step(self) -> None:
        """Do what comes next; there is always a next one, whatever became of the screen meanwhile."""
        self._clock.after(next(self._acts), self._step)

    def _mind_visitor(self) -> None:
        """Begin anew when a visitor has come or gone; what was shown to the others goes."""
        if self._alone == self._nobody_plays:
            return
        self._alone = self._nobody_plays
        self._take_greeting_away()
        self._avatar.feel(None)
        self._avatar.blink(shut=False)
        self._avatar.glance(0, 0)
        self._acts = self._begin()

    def _live(self) -> Waits:
        """Blink, and glance aside now and then."""
        while True:
            yield self._rng.randint(*PLAYING_PAUSE_MS)
            yield from self._rng.choice((self._blink, self._blink, self._glance))()

    def _play(self) -> Waits:
        """Play one game after another, and greet in one language after another."""
        yield LOOK_MS
        yield from self._greet()
        moves = 0
        while True:
            self._attract.close()
            yield TURN_MS
            self._attract.deal(self._rng)
            seen: set[int] = set()
            while self._attract.closed:
                yield from self._move(seen)
                moves += 1
                if moves % MOVES_PER_LANGUAGE == 0:
                    self._change_language()
                    yield from self._greet()
            self._avatar.gesture("wave")
            yield REJOICE_MS

    def _move(self, seen: set[int]) -> Waits:
        """Turn two cards; ``seen`` are the places that the one who plays has seen."""
        attract = self._attract
        yield self._rng.randint(*REST_MS)
        yield from self._rng.choice((self._blink, self._blink, self._glance))()
        first = self._rng.choice(attract.closed)
        attract.turn(first)
        yield LOOK_MS
        picture = attract.cards[first]
        mate = next(place for place in attract.closed if attract.cards[place] == picture)
        finds = self._rng.random() < (MEMORY if mate in seen else LUCK)
        second = mate if finds else self._rng.choice(attract.closed)
        attract.turn(second)
        yield LOOK_MS
        if attract.cards[second] == picture:
            attract.keep()
            yield TURN_MS
            self._avatar.feel(Mood.HAPPY)
            yield FEEL_MS
        else:
            seen |= {first, second}
            self._avatar.feel(Mood.THINKING)
            yield FEEL_MS
            attract.close()
            yield TURN_MS
        self._avatar.feel(None)
        yield TURN_MS

    def _blink(self) -> Waits:
        self._avatar.blink(shut=True)
        yield BLINK_MS
        self._avatar.blink(shut=False)
        yield BLINK_MS

    def _glance(self) -> Waits:
        self._avatar.glance(self._rng.uniform(-GLANCE_FAR, GLANCE_FAR), self._rng.uniform(-GLANCE_FAR, GLANCE_FAR))
        yield GLANCE_MS
        self._avatar.glance(0, 0)
        yield BLINK_MS

    def _greet(self) -> Waits:
        """Show a word to people who pass, which is never said; it stays until the language changes."""
        self._greeting = self._rng.choice(self._attract.greetings)
        self._avatar.say(self._greeting)
        yield LOOK_MS

    def _change_language(self) -> None:
        self._take_greeting_away()
        self._attract.next_language()

    def _take_greeting_away(self) -> None:
        greeting, self._greeting = self._greeting, ""
        if greeting and self._avatar.property("bubble") == greeting:
            self._avatar.say("")
