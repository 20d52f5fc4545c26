"""The list of all that a booth needs, in the order in which a person sets it up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path

from kiosk import program
from kiosk.cli.booth.checking import machine
from kiosk.cli.wiring import code_commit, code_made
from kiosk.findings import Finding, Probe, State
from kiosk.keeping.kept import WHAT, kept
from kiosk.robot.player import player
from kiosk.robot.probes import robot, sound, voice
from kiosk.settings import Settings
from kiosk.store.care.backup import FOLDER
from kiosk.store.probes import clock, database, disk, forms
from kiosk.study.declared.checked import found
from kiosk.study.plan import Study
from kiosk.study.session_kind import kind_of
from kiosk.ui.probes.asked import ask
from kiosk.ui.probes.pictures import DRAWN_S, READY_S, CannotDraw, undrawn

_DISPLAY_S, _MARGIN_S = 14.0, 1.0
PICTURES = "pictures"
SENTENCE = "introduction-help"
"""What every language has a sentence for."""


@dataclass(frozen=True)
class Booth:
    """What is to be looked at; without ``settings``, or ``study``, whatever needs them is left out."""

    folder: Path
    site: str
    busy: bool
    """Whether a kiosk is open on the folder: nothing may then take the card or the robot from it."""
    file: Path | None
    """The study file, if one was named."""
    settings: Settings | None
    study: Study | None
    faults: tuple[str, ...]


def probes(booth: Booth) -> Iterator[Probe]:
    """Every look, in order."""
    yield from _study(booth)
    yield from _shown(booth)
    yield from _heard(booth)
    yield from _kept(booth)
    yield from _machine(booth.folder)


def _study(booth: Booth) -> Iterator[Probe]:
    if booth.faults:
        yield Probe(found.FILE, partial(found.faults, booth.faults))
    if booth.study is not None:
        yield Probe(found.FILE, partial(found.file, booth.study))
        yield Probe(found.LANGUAGES, partial(found.languages, booth.study))
        yield Probe(found.POLICY, partial(found.policy, booth.study))
    if booth.settings is not None:
        yield Probe(found.PIN, partial(found.pin, booth.settings.experimenter))
        yield Probe(found.KEYS, partial(found.keys, booth.settings.keys))


def _shown(booth: Booth) -> Iterator[Probe]:
    number = str(booth.settings.screen.number if booth.settings else 0)
    remedy = "see that the session has a screen, and run this in it"
    screens = partial(ask, "screen", program("display", "screens", number), _DISPLAY_S, remedy)
    yield Probe("screen", screens, _DISPLAY_S + _MARGIN_S, State.BAD)
    if booth.study is not None and booth.study.own_pictures:
        drawn = partial(found_pictures, booth.study.own_pictures)
        yield Probe(PICTURES, drawn, READY_S + DRAWN_S * len(booth.study.own_pictures), State.BAD)
    remedy = "install Recollect anew, with the system's packages that packaging/README.md names"
    study = () if booth.study is None or booth.file is None else ("--study", str(booth.file))
    frame = partial(ask, "drawing", program("display", "frame", *study), _DISPLAY_S, remedy)
    yield Probe("drawing", frame, _DISPLAY_S + _MARGIN_S, State.BAD)


def found_pictures(files: Sequence[Path]) -> Iterator[Finding]:
    """Draw the pictures that do not come with the program."""
    try:
        faults = tuple(undrawn(program("display", "pictures"), files))
    except CannotDraw as error:
        yield Finding.warning(PICTURES, f"they were not tried: {error}", "see what is said of the drawing")
        return
    yield from (Finding.bad(PICTURES, fault, "draw it anew, with plain shapes") for fault in faults)
    if not faults:
        yield Finding.good(PICTURES, f"{len(files)} of the study's own can be drawn")


def _heard(booth: Booth) -> Iterator[Probe]:
    settings = booth.settings
    if settings is None:
        return
    yield Probe(sound.WHAT, partial(sound.sound, player(), busy=booth.busy))
    if not settings.voice.enabled:
        yield Probe("voice", lambda: [Finding.good("voice", "switched off in the study file")])
    elif booth.study is not None:
        for plan in booth.study.plans:
            command = program("voice", plan.language, str(settings.voice.rate), str(settings.voice.volume))
            say = partial(voice.voice, command, plan.language, plan.catalogue.text(SENTENCE))
            yield Probe(f"voice: {plan.language}", say, voice.WITHIN_S + _MARGIN_S)
    ask_robot = partial(robot.robot, settings.robot, settings.language_codes, busy=booth.busy)
    yield Probe(robot.WHAT, ask_robot, robot.within_s(settings.robot))


def _kept(booth: Booth) -> Iterator[Probe]:
    folder, busy, now = booth.folder, booth.busy, datetime.now().astimezone()
    yield Probe(disk.ROOM, partial(disk.space, folder), late=State.BAD)
    yield Probe(disk.FOLDER, partial(disk.access, folder), late=State.BAD)
    yield Probe(disk.WRITING, partial(disk.writing, folder), late=State.BAD)
    yield Probe(database.DATABASE, partial(database.database, folder, busy=busy), late=State.BAD)
    yield Probe(database.SITTINGS, partial(database.sittings, folder, busy=busy))
    yield Probe(database.COPY, partial(database.copy, folder, folder / FOLDER, now))
    if booth.settings is not None and booth.study is not None:
        kind = kind_of(booth.settings)
        yield Probe(database.LIST, partial(database.allocation, folder, booth.site, booth.settings.allocation, kind))
        yield Probe(forms.WHAT, partial(forms.forms, folder, booth.study.plans[0]))
    yield Probe(clock.WHAT, partial(clock.clock, folder, now, code_made()))


def _machine(folder: Path) -> Iterator[Probe]:
    load = machine.Load.now()
    yield Probe(machine.MACHINE, partial(machine.machine, load))
    yield Probe(machine.PROGRAM, lambda: machine.program(code_commit()))
    yield Probe(machine.LOGGED, partial(machine.log, folder))
    yield Probe(WHAT, kept)
