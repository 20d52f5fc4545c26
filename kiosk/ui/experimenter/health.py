"""The health of the booth, in lines of the panel and parts of status.json."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from math import ceil

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.booth_status import PartStatus
from kiosk.experiment.experimenter import Action
from kiosk.experiment.session_config import StudyConfig
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.embodiment import Health
from kiosk.store.maintenance import FreeSpace, SpaceLevel
from kiosk.ui.experimenter.maintenance import BackupOutcome
from kiosk.units import MS_PER_HOUR, MS_PER_MINUTE, MS_PER_SECOND

SHORT_SHA = 8
DRIFT_MS = 60_000
"""How far the wall's clock may differ from one that cannot be set, or stand before what was last written."""

MIB_PER_GIB = 1024


@dataclass(frozen=True)
class HealthLine:
    """How one thing is; ``name`` says what it is."""

    name: str
    message: str
    is_ok: bool = True
    remedy: str = ""
    """What the experimenter can do about it, where the message does not say so."""
    command: str = ""
    """What is to be typed for that, away from the kiosk."""
    action: str = ""
    """The action of the panel that does it; empty if it is done elsewhere."""
    button: str = ""
    """What the button says that does that action, or shows that command."""
    is_used: bool = True
    """False for what is not set up, or off on purpose: it is no fault, but nothing is in order there either."""
    is_due: bool = False
    """Whether the experimenter has something to do about it, though nothing is wrong."""


@dataclass(frozen=True)
class Clocks:
    """The wall's clock, in ms since 1970: now, when the program began, and when anything was last written before that.

    ``run_ms`` is how long the program has run by a clock that cannot be set.
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

    @property
    def wrong_ms(self) -> int:
        """How far the clock was set, or stood behind the records at the start; 0 for mere drift."""
        for wrong_ms in (self.set_back_ms, self.jump_ms):
            if abs(wrong_ms) > DRIFT_MS:
                return wrong_ms
        return 0


@dataclass(frozen=True)
class HealthInputs:
    """Everything that the health lines are made from."""

    robot: Health | None
    """None if there is none."""
    voice: Health
    muted: bool
    free_space: FreeSpace | None
    last_backup: BackupOutcome | None
    audit_error: str
    """What the disk did not take last; empty if it took everything since."""
    clocks: Clocks
    has_pin: bool
    screen: str
    screen_well: bool
    supervised: bool = False
    remote: str | None = None
    """Why the status is not published; empty if it is, None if that is switched off."""
    copy: str = ""
    """What becomes of a copy that was asked for; empty if none was."""
    pack_changed: bool = False
    """Whether the pack of clips is not the one of earlier sessions."""


def health_lines(state: HealthInputs, catalogue: Catalogue) -> tuple[HealthLine, ...]:
    """Return what the first page tells, in the order in which a person looks."""
    return (
        _robot(state, catalogue),
        _voice(state, catalogue),
        _disk(state, catalogue),
        _database(state, catalogue),
        _clock(state.clocks, catalogue),
        # Before the supervisor, which starts no study without a PIN.
        _pin(state, catalogue),
        _supervisor(state, catalogue),
    )


def _pin(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name, there = catalogue.text("console-pin-line-name"), catalogue.text("console-pin-set")
    return HealthLine(name, there) if state.has_pin else _missing(name, "pin", "recollect study set-pin", catalogue)


def _supervisor(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name, there = catalogue.text("console-supervisor"), catalogue.text("console-supervisor-there")
    if state.supervised:
        return HealthLine(name, there)
    return _missing(name, "supervisor", "recollect run --supervise", catalogue)


def _missing(name: str, part: str, command: str, catalogue: Catalogue) -> HealthLine:
    """Say that a part is missing, what to do, and which command does it."""
    missing, remedy, button = (catalogue.text(f"console-{part}-{what}") for what in ("none", "remedy", "how"))
    return HealthLine(name, missing, is_ok=False, remedy=remedy, command=command, button=button)


def booth_lines(state: HealthInputs, study: StudyConfig, catalogue: Catalogue) -> tuple[HealthLine, ...]:
    """Return what stays as it is all day."""
    translate = catalogue.text
    return (
        HealthLine(translate("console-policy"), _policy(study)),
        HealthLine(translate("console-study"), f"{study.settings.title} · {study.sha256[:SHORT_SHA]}"),
        HealthLine(translate("console-screen"), state.screen, state.screen_well),
        *_remote(state, catalogue),
    )


def _remote(state: HealthInputs, catalogue: Catalogue) -> Iterator[HealthLine]:
    if state.remote is not None:
        words = catalogue.text("console-remote-not", why=state.remote) if state.remote else ""
        name, there = catalogue.text("console-remote"), catalogue.text("console-remote-there")
        remedy = catalogue.text("console-remote-remedy") if words else ""
        yield HealthLine(name, words or there, is_ok=not words, remedy=remedy)


def health_parts(state: HealthInputs, catalogue: Catalogue) -> Iterator[PartStatus]:
    """Yield how the parts of the booth are that can fail, under names that are the same in every language."""
    lines = {
        "robot": _robot(state, catalogue),
        "voice": _voice(state, catalogue),
        "disk": _disk(state, catalogue),
        "database": _database(state, catalogue),
        "clock": _clock(state.clocks, catalogue),
        "screen": HealthLine("", state.screen, state.screen_well),
    }
    yield from (PartStatus(name, line.is_ok, line.message) for name, line in lines.items())


def _robot(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-robot")
    if state.robot is None:
        return HealthLine(name, catalogue.text("console-robot-absent"), is_used=False)
    remedy = "" if state.robot.is_ok else catalogue.text("console-robot-remedy")
    return HealthLine(name, state.robot.message, state.robot.is_ok, remedy=remedy)


def _voice(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-voice")
    if state.muted:
        return HealthLine(
            name,
            catalogue.text("console-voice-quiet"),
            is_ok=False,
            remedy=catalogue.text("console-voice-quiet-remedy"),
            action=Action.MUTE.value,
            button=catalogue.text("console-heard"),
        )
    if state.voice.is_ok and state.pack_changed:
        remedy = catalogue.text("console-voice-changed-remedy")
        changed = catalogue.text("console-voice-changed")
        button = catalogue.text("console-voice-changed-how")
        return HealthLine(name, changed, is_ok=False, remedy=remedy, command="recollect verify", button=button)
    remedy = "" if state.voice.is_ok else catalogue.text("console-voice-remedy")
    return HealthLine(name, state.voice.message, state.voice.is_ok, remedy=remedy, is_used=state.voice.is_used)


def is_pack_changed(pack: tuple[str, str], earlier: Iterable[tuple[str, str]]) -> bool:
    """Whether the pack of a language, by its hash, is another one than any that spoke it in earlier sessions."""
    language, sha256 = pack
    return bool(sha256) and any(spoken == language and each != sha256 for spoken, each in earlier)


def _disk(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-disk")
    if state.free_space is None:
        remedy = catalogue.text("console-disk-unknown-remedy")
        return HealthLine(name, catalogue.text("console-disk-unknown"), is_ok=False, remedy=remedy)
    free = state.free_space.free_mib
    size = f"{free / MIB_PER_GIB:.1f} GiB" if free >= MIB_PER_GIB else f"{free} MiB"
    message = {
        SpaceLevel.ENOUGH: "console-disk-free",
        SpaceLevel.WARN: "console-disk-warn",
        SpaceLevel.REFUSE: "console-disk-refuse",
    }[state.free_space.level]
    is_enough = state.free_space.level is SpaceLevel.ENOUGH
    remedy = "" if is_enough else catalogue.text(f"{message}-remedy")
    return HealthLine(name, catalogue.text(message, free=size), is_enough, remedy=remedy)


def database_fault(why: str, catalogue: Catalogue) -> HealthLine:
    """Return the line of a database that cannot be read, or takes nothing."""
    remedy = catalogue.text("console-database-remedy")
    return HealthLine(catalogue.text("console-database"), why, is_ok=False, remedy=remedy)


def _database(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name, translate = catalogue.text("console-database"), catalogue.text
    if state.audit_error:
        return database_fault(state.audit_error, catalogue)
    copying = partial(HealthLine, action=Action.BACKUP.value, button=translate("console-backup"))
    if state.last_backup is None:
        if state.copy:
            return HealthLine(name, state.copy, is_used=False)
        remedy = translate("console-backup-none-remedy")
        return copying(name, translate("console-backup-none"), remedy=remedy, is_due=True)
    if state.last_backup.file is None:
        failed = translate("console-backup-failed", why=state.last_backup.why)
        return copying(name, failed, is_ok=False, remedy=translate("console-backup-failed-remedy"))
    minutes = max(0, state.clocks.now_ms - state.last_backup.at_ms) // MS_PER_MINUTE
    return HealthLine(name, translate("console-backup-made", ago=ago(minutes, catalogue)))


def ago(minutes: int, catalogue: Catalogue) -> str:
    """Return a number of minutes in words: in minutes, hours or days."""
    if minutes < _MINUTES_PER_HOUR:
        return catalogue.text("console-minutes", minutes=minutes)
    if minutes < _MINUTES_PER_DAY:
        return catalogue.text("console-hours", hours=minutes // _MINUTES_PER_HOUR)
    return catalogue.text("console-days", days=minutes // _MINUTES_PER_DAY)


_MINUTES_PER_HOUR = 60
_MINUTES_PER_DAY = 24 * 60


def _clock(clocks: Clocks, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-clock")
    if clocks.set_back_ms > DRIFT_MS:
        # A clock that is wrong is wrong by hours; one that is off by less is so by at most one.
        hours = ceil(clocks.set_back_ms / MS_PER_HOUR)
        remedy = catalogue.text("console-clock-behind-remedy")
        return HealthLine(name, catalogue.text("console-clock-behind", hours=hours), is_ok=False, remedy=remedy)
    if abs(clocks.jump_ms) > DRIFT_MS:
        jumped = catalogue.text("console-clock-jumped", seconds=round(clocks.jump_ms / MS_PER_SECOND))
        return HealthLine(name, jumped, is_ok=False, remedy=catalogue.text("console-clock-jumped-remedy"))
    return HealthLine(name, catalogue.text("console-clock-well"))


def _policy(study: StudyConfig) -> str:
    policy = study.plans[0].policy
    return f"{policy.name} · {policy.sha256[:SHORT_SHA]}"
