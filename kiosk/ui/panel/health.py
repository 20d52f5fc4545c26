"""How everything is, in words for the experimenter: one line for each thing that can fail, and one for all of them."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from kiosk.assistant.wording import Catalogue
from kiosk.robot.body import Health
from kiosk.store.care.disk import Level, Room
from kiosk.study.plan import Study
from kiosk.ui.panel.upkeep import Copied
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

SHORT_SHA = 8
MS_PER_HOUR = 60 * MS_PER_MINUTE
DRIFT_MS = 60_000
"""So far may the wall's clock go from one that nobody can set, or stand before what was last written."""

MIB_PER_GIB = 1024


@dataclass(frozen=True)
class Line:
    """How one thing is; ``name`` says what it is."""

    name: str
    words: str
    well: bool = True


@dataclass(frozen=True)
class Clocks:
    """The wall's clock, in ms since 1970: now, when the program began, and when anything was last written before that.

    ``run_ms`` is how long the program has run by a clock that nobody can set.
    """

    now_ms: int
    began_ms: int
    run_ms: int
    written_ms: int

    @property
    def set_back_ms(self) -> int:
        """How far the program began before what was written already."""
        return max(0, self.written_ms - self.began_ms)

    @property
    def jump_ms(self) -> int:
        """How far the clock was set since the program began."""
        return self.now_ms - self.began_ms - self.run_ms


@dataclass(frozen=True)
class State:
    """Everything that health is told from."""

    robot: Health | None
    """None if there is none."""
    voice: Health
    quiet: bool
    room: Room | None
    copied: Copied | None
    trouble: str
    """What the disk did not take last; empty if it took everything since."""
    clocks: Clocks
    has_pin: bool
    screen: str
    screen_well: bool


def lines(state: State, study: Study, catalogue: Catalogue) -> tuple[Line, ...]:
    """Every line, in the order in which a person looks."""
    told = catalogue.text
    return (
        _robot(state, catalogue),
        _voice(state, catalogue),
        _disk(state, catalogue),
        _database(state, catalogue),
        _clock(state.clocks, catalogue),
        Line(told("desk-policy"), _policy(study)),
        Line(told("desk-study"), f"{study.settings.title} · {study.settings.sha256[:SHORT_SHA]}"),
        Line(told("desk-pin-line-name"), told("desk-pin-set" if state.has_pin else "desk-pin-none"), state.has_pin),
        Line(told("desk-screen"), state.screen, state.screen_well),
    )


def summary(found: tuple[Line, ...], catalogue: Catalogue) -> Line:
    """One line for all."""
    ill = [line for line in found if not line.well]
    if not ill:
        return Line("", catalogue.text("desk-all-well"))
    return Line("", "  ·  ".join(f"{line.name}: {line.words}" for line in ill), well=False)


def _robot(state: State, catalogue: Catalogue) -> Line:
    name = catalogue.text("desk-robot")
    if state.robot is None:
        return Line(name, catalogue.text("desk-robot-none"))
    return Line(name, state.robot.words, state.robot.well)


def _voice(state: State, catalogue: Catalogue) -> Line:
    name = catalogue.text("desk-voice")
    if state.quiet:
        return Line(name, catalogue.text("desk-voice-quiet"), well=False)
    return Line(name, state.voice.words, state.voice.well)


def _disk(state: State, catalogue: Catalogue) -> Line:
    name = catalogue.text("desk-disk")
    if state.room is None:
        return Line(name, catalogue.text("desk-disk-unknown"), well=False)
    free = state.room.free_mib
    size = f"{free / MIB_PER_GIB:.1f} GiB" if free >= MIB_PER_GIB else f"{free} MiB"
    message = {
        Level.ENOUGH: "desk-disk-free",
        Level.WARN: "desk-disk-warn",
        Level.REFUSE: "desk-disk-refuse",
    }[state.room.level]
    return Line(name, catalogue.text(message, free=size), state.room.level is Level.ENOUGH)


def _database(state: State, catalogue: Catalogue) -> Line:
    name, told = catalogue.text("desk-database"), catalogue.text
    if state.trouble:
        return Line(name, state.trouble, well=False)
    if state.copied is None:
        return Line(name, told("desk-backup-none"))
    if state.copied.file is None:
        return Line(name, told("desk-backup-failed", why=state.copied.why), well=False)
    minutes = max(0, state.clocks.now_ms - state.copied.at_ms) // MS_PER_MINUTE
    return Line(name, told("desk-backup-made", ago=ago(minutes, catalogue)))


def ago(minutes: int, catalogue: Catalogue) -> str:
    """So many minutes, in words of the size that matters."""
    if minutes < _MINUTES_PER_HOUR:
        return catalogue.text("desk-minutes", minutes=minutes)
    if minutes < _MINUTES_PER_DAY:
        return catalogue.text("desk-hours", hours=minutes // _MINUTES_PER_HOUR)
    return catalogue.text("desk-days", days=minutes // _MINUTES_PER_DAY)


_MINUTES_PER_HOUR = 60
_MINUTES_PER_DAY = 24 * 60


def _clock(clocks: Clocks, catalogue: Catalogue) -> Line:
    name = catalogue.text("desk-clock")
    if clocks.set_back_ms > DRIFT_MS:
        # A clock that is wrong is wrong by hours; one that is off by less is so by at most one.
        hours = ceil(clocks.set_back_ms / MS_PER_HOUR)
        return Line(name, catalogue.text("desk-clock-behind", hours=hours), well=False)
    if abs(clocks.jump_ms) > DRIFT_MS:
        return Line(
            name, catalogue.text("desk-clock-jumped", seconds=round(clocks.jump_ms / MS_PER_SECOND)), well=False
        )
    return Line(name, catalogue.text("desk-clock-well"))


def _policy(study: Study) -> str:
    policy = study.plans[0].policy
    return f"{policy.name} · {policy.sha256[:SHORT_SHA]}"
