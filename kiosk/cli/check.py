"""Every preflight check, with a remedy on each line."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Self

import click
import psutil
from rich.table import Table
from rich.text import Text

from kiosk import UserInputError, __version__, program
from kiosk.assistance.policy import load_action
from kiosk.cli.composition import code_commit, code_made, read_settings
from kiosk.cli.log import LOG, LOG_BYTES, LOGS_KEPT
from kiosk.cli.options import ProgressCallback, progress_bar
from kiosk.cli.terminal import console
from kiosk.config import Settings
from kiosk.experiment.booth_status import FILE, BoothStatus
from kiosk.experiment.questionnaire import load_item
from kiosk.experiment.session_config import StudyConfig, kind_of
from kiosk.extensions import Extension, ExtensionGroup, find, installed
from kiosk.files import read_bytes
from kiosk.preflight import WHAT, Check, CheckResult, Severity, autostart_check
from kiosk.robots import lsl_worker, voice_program
from kiosk.robots import registry as robots_checks
from kiosk.robots.embodiment import Health
from kiosk.robots.registry import check_robot, load_driver
from kiosk.store import checks as store_checks
from kiosk.store.database import in_use
from kiosk.store.participants import checked_site
from kiosk.study import checks
from kiosk.study.loader import read_study
from kiosk.ui.checks import DRAWN_S, READY_S, CannotDraw, found_in_pictures, run_check_process
from kiosk.ui.fonts import WITHIN_S, missing_characters
from kiosk.units import MIB

MACHINE, PROGRAM, LOGGED = "machine", "program", "log"

LEAST_MIB = 400
"""At rest, at 1080p, the kiosk, its voice, the supervisor and the splash window took 328 MiB, 174 of them theirs
alone; a day adds nothing."""
BUSY = 1.0
"""Programs that wait for each processor, over the last five minutes; the kiosk itself needs 14 % of one."""

SHORT_COMMIT = 8
_DIRTY = "-dirty"


@dataclass(frozen=True)
class Load:
    """What is left of the machine."""

    free_mib: int
    processors: int
    waiting: float
    """Programs that ran or waited for a processor, on average over five minutes."""

    @classmethod
    def now(cls) -> Self:
        """As it is."""
        _, waiting, _ = psutil.getloadavg()
        return cls(psutil.virtual_memory().available // MIB, psutil.cpu_count() or 1, waiting)


def machine_check(load: Load) -> Iterator[CheckResult]:
    """Whether the kiosk will have the memory and the time that it needs."""
    processors = "1 processor" if load.processors == 1 else f"{load.processors} processors"
    words = f"{load.free_mib:,} MiB of memory are free; {processors} with a load of {load.waiting:.1f}"
    if load.free_mib < LEAST_MIB:
        yield CheckResult.warning(MACHINE, words, f"end other programs: the kiosk needs {LEAST_MIB} MiB")
    elif load.waiting > BUSY * load.processors:
        yield CheckResult.warning(MACHINE, words, "end other programs: they take the time that frames and sounds need")
    else:
        yield CheckResult.ok(MACHINE, words)


def program_check(commit: str) -> Iterator[CheckResult]:
    """Which Recollect this is; what was changed since its commit cannot be named in the data."""
    words = f"{__version__}, {commit.removesuffix(_DIRTY)[:SHORT_COMMIT]}"
    if commit.endswith(_DIRTY):
        remedy = "commit the changes, or undo them, before people come: the data name the commit"
        yield CheckResult.warning(PROGRAM, f"{words}, and changed since", remedy)
    else:
        yield CheckResult.ok(PROGRAM, words)


def log_check(folder: Path) -> Iterator[CheckResult]:
    """Whether faults can be written down, and how much there is."""
    file = folder / LOG
    size = sum(each.stat().st_size for each in folder.glob(f"{LOG}*")) if folder.is_dir() else 0
    if file.exists() and not os.access(file, os.W_OK):
        yield CheckResult.error(LOGGED, f"{file} cannot be written", "give it to the user who runs the kiosk")
    elif size > LOG_BYTES * (LOGS_KEPT + 2):
        words = f"{size / MIB:.1f} MiB; it should be renewed at {LOG_BYTES / MIB:.0f} MiB"
        yield CheckResult.warning(LOGGED, words, f"look into {file}, then remove it while no kiosk is open")
    else:
        yield CheckResult.ok(LOGGED, f"{size / MIB:.1f} MiB in {LOG}" if size else "nothing was logged yet")


_TICK_S = 0.1
_LATE = "start the machine again, if it stays so"


@dataclass(frozen=True)
class _Outcome:
    """What became of the probe of a number: what it found, or a fault of ours."""

    number: int
    found: tuple[CheckResult, ...]
    fault: Exception | None = None


def run_checks(probes: Sequence[Check], tell: ProgressCallback) -> tuple[CheckResult, ...]:
    """Return what all probes find, in their order; a fault of ours is raised when all have had their time."""
    begun = time.monotonic()
    heard: queue.SimpleQueue[_Outcome] = queue.SimpleQueue()
    for number, probe in enumerate(probes):
        # A thread that hangs must not keep the program from ending.
        threading.Thread(target=_look, args=(number, probe, heard), daemon=True).start()
    outcomes: dict[int, _Outcome] = {}
    while len(outcomes) < len(probes):
        tell(len(outcomes))
        try:
            outcome = heard.get(timeout=_TICK_S)
            outcomes.setdefault(outcome.number, outcome)
        except queue.Empty:
            outcomes |= _late(probes, outcomes, time.monotonic() - begun)
    tell(len(outcomes))
    for outcome in outcomes.values():
        if outcome.fault is not None:
            raise outcome.fault
    return tuple(result for number in range(len(probes)) for result in outcomes[number].found)


def _look(number: int, probe: Check, heard: queue.SimpleQueue[_Outcome]) -> None:
    try:
        heard.put(_Outcome(number, tuple(probe.look())))
    except Exception as fault:  # noqa: BLE001 - it is raised again in the thread that waits
        heard.put(_Outcome(number, (), fault))


def _late(probes: Sequence[Check], outcomes: dict[int, _Outcome], passed_s: float) -> dict[int, _Outcome]:
    """Return what is said of probes whose time is over."""
    over = ((n, probe) for n, probe in enumerate(probes) if n not in outcomes and passed_s > probe.within_s)
    return {
        number: _Outcome(
            number, (CheckResult(probe.what, probe.late, f"no answer within {probe.within_s:g} s", _LATE),)
        )
        for number, probe in over
    }


EXTENSIONS = "extensions"


def extensions_check() -> Iterator[CheckResult]:
    """List what other packages add, and import each, so that a broken one is found before it is needed."""
    added = [each for group in ExtensionGroup for each in installed(group) if not each.is_built_in]
    if not added:
        yield CheckResult.ok(EXTENSIONS, "none installed")
    for extension in added:
        what = f"{extension.group.noun} {extension.name}"
        try:
            find(extension.group, extension.name)
            _LOADERS[extension.group](extension)
        except UserInputError as error:
            remedy = f"mend the package {extension.package}, or remove it: pip uninstall {extension.package}"
            yield CheckResult.error(what, str(error), remedy)
        else:
            yield CheckResult.ok(what, f"{extension.package} {extension.version}")


_LOADERS: Mapping[ExtensionGroup, Callable[[Extension], object]] = {
    ExtensionGroup.ROBOTS: load_driver,
    ExtensionGroup.ITEMS: load_item,
    ExtensionGroup.ACTIONS: load_action,
}

_DISPLAY_S, _MARGIN_S = 14.0, 1.0
PICTURES = "pictures"
FONTS = "fonts"
SENTENCE = "introduction-help"
"""What every language has a sentence for."""


@dataclass(frozen=True)
class CheckTargets:
    """What is to be looked at; without ``settings``, or ``study``, whatever needs them is left out."""

    folder: Path
    site: str
    busy: bool
    """Whether a kiosk is open on the folder: nothing may then take the card or the robot from it."""
    file: Path | None
    """The study file, if one was named."""
    settings: Settings | None
    study: StudyConfig | None
    faults: tuple[str, ...]


def all_checks(booth: CheckTargets) -> Iterator[Check]:
    """Every look, in order."""
    yield from _study(booth)
    yield from _shown(booth)
    yield from _heard(booth)
    yield from _sent(booth)
    yield from _kept(booth)
    yield from _machine(booth.folder)
    yield Check(EXTENSIONS, extensions_check)


def _study(booth: CheckTargets) -> Iterator[Check]:
    if booth.faults:
        yield Check(checks.FILE, partial(checks.faults_check, booth.faults))
    if booth.study is not None:
        yield Check(checks.FILE, partial(checks.study_file_check, booth.study))
        yield Check(checks.LANGUAGES, partial(checks.languages_check, booth.study))
        yield Check("wording", partial(checks.wording_check, booth.study))
        yield Check(checks.POLICY, partial(checks.policy_check, booth.study))
    if booth.settings is not None:
        yield Check(checks.PIN, partial(checks.pin_check, booth.settings.experimenter))
        yield Check(checks.KEYS, partial(checks.shortcuts_check, booth.settings.shortcuts))


def _shown(booth: CheckTargets) -> Iterator[Check]:
    number = str(booth.settings.screen.display if booth.settings else 0)
    remedy = "see that the session has a screen, and run this in it"
    screens = partial(run_check_process, "screen", program("_display", "screens", number), _DISPLAY_S, remedy)
    yield Check("screen", screens, _DISPLAY_S + _MARGIN_S, Severity.ERROR)
    if booth.study is not None:
        yield Check(FONTS, partial(found_fonts, booth.study), WITHIN_S, Severity.WARNING)
    if booth.study is not None and booth.study.own_pictures:
        drawn = partial(found_pictures, booth.study)
        yield Check(PICTURES, drawn, READY_S + DRAWN_S * len(booth.study.own_pictures), Severity.ERROR)
    remedy = "install Recollect anew, with the system's packages that packaging/README.md names"
    study = () if booth.study is None or booth.file is None else ("--study", str(booth.file))
    frame = partial(run_check_process, "drawing", program("_display", "frame", *study), _DISPLAY_S, remedy)
    yield Check("drawing", frame, _DISPLAY_S + _MARGIN_S, Severity.ERROR)


def found_fonts(study: StudyConfig) -> Iterator[CheckResult]:
    """Look for a glyph of every character of every text."""
    try:
        missing = missing_characters(program("_display", "fonts"), study)
    except (OSError, ValueError, subprocess.SubprocessError) as error:
        yield CheckResult.warning(FONTS, f"they were not tried: {error}", "see what the other lines say of the screen")
        return
    yield from (CheckResult.warning(FONTS, str(each), each.remedy) for each in missing)
    if not missing:
        yield CheckResult.ok(FONTS, "every character of every text can be drawn")


def found_pictures(study: StudyConfig) -> Iterator[CheckResult]:
    """Draw the pictures that do not come with the program."""
    try:
        faults, cautions = found_in_pictures(study)
    except CannotDraw as error:
        yield CheckResult.warning(PICTURES, f"they were not tried: {error}", "see what is said of the drawing")
        return
    yield from (CheckResult.error(PICTURES, fault, "draw it anew, with plain shapes") for fault in faults)
    yield from (CheckResult.warning(PICTURES, caution, "choose another picture") for caution in cautions)
    if not faults:
        yield CheckResult.ok(PICTURES, f"{len(study.own_pictures)} of the study's own can be drawn")


def _heard(booth: CheckTargets) -> Iterator[Check]:
    settings = booth.settings
    if settings is None:
        return
    probe = voice_program(settings.voice_from_here, settings.language_codes[0], probe=True)
    within_s = robots_checks.WITHIN_S + _MARGIN_S
    told = _voice_of_kiosk(booth.folder) if booth.busy else None
    yield Check(robots_checks.SOUND, partial(robots_checks.sound_check, probe, busy=booth.busy, told=told), within_s)
    if not settings.voice.enabled:
        yield Check("voice", lambda: [CheckResult.ok("voice", "switched off in the study file")])
    elif booth.study is not None:
        for plan in booth.study.plans:
            command = voice_program(settings.voice_from_here, plan.language)
            say = partial(robots_checks.voice_check, command, plan.language, plan.catalogue.text(SENTENCE))
            yield Check(f"voice: {plan.language}", say, within_s)
    ask_robot = partial(robots_checks.robot_check, settings.robot, settings.language_codes, busy=booth.busy)
    yield Check(robots_checks.ROBOT, ask_robot, robots_checks.within_s(settings.robot))
    if settings.robot.pack:
        packs = partial(robots_checks.pack_check, settings.voice_from_here, settings.language_codes)
        yield Check(f"{robots_checks.ROBOT}: clips", packs)


def _voice_of_kiosk(folder: Path) -> Health | None:
    """Return what the kiosk that is open on a folder says of its voice; None if it says nothing."""
    try:
        status = BoothStatus.from_json(read_bytes(folder / FILE).decode("utf-8"))
    except (OSError, ValueError):
        return None
    if not status.is_alive(datetime.now(UTC)):
        return None
    return next((Health(part.ok, part.message) for part in status.parts if part.name == "voice"), None)


def _sent(booth: CheckTargets) -> Iterator[Check]:
    if booth.settings is not None and booth.settings.markers.lsl:
        yield Check(lsl_worker.CHECK, partial(lsl_worker.lsl_check, booth.settings.markers.stream))


def _kept(booth: CheckTargets) -> Iterator[Check]:
    folder, busy, now = booth.folder, booth.busy, datetime.now().astimezone()
    yield Check(store_checks.ROOM, partial(store_checks.free_space_check, folder), late=Severity.ERROR)
    yield Check(store_checks.FOLDER, partial(store_checks.access_check, folder), late=Severity.ERROR)
    yield Check(store_checks.WRITING, partial(store_checks.write_speed_check, folder), late=Severity.ERROR)
    yield Check(store_checks.DATABASE, partial(store_checks.database_check, folder, busy=busy), late=Severity.ERROR)
    yield Check(store_checks.SESSIONS, partial(store_checks.sessions_check, folder, busy=busy))
    yield Check(store_checks.COPY, partial(store_checks.backup_check, folder, now))
    if booth.settings is not None and booth.study is not None:
        kind = kind_of(booth.settings)
        yield Check(
            store_checks.LIST,
            partial(store_checks.allocation_check, folder, booth.site, booth.settings.randomisation, kind),
        )
        yield Check(store_checks.FORMS, partial(store_checks.forms, folder, booth.study.plans[0]))
    yield Check(store_checks.WHAT, partial(store_checks.clock_check, folder, now, code_made()))


def _machine(folder: Path) -> Iterator[Check]:
    load = Load.now()
    yield Check(MACHINE, partial(machine_check, load))
    yield Check(PROGRAM, lambda: program_check(code_commit()))
    yield Check(LOGGED, partial(log_check, folder))
    yield Check(WHAT, autostart_check)


NOT_READY = 1
"""The exit code when no session can be held."""

_MARKS = {Severity.OK: "OK", Severity.WARNING: "WARN", Severity.ERROR: "FAIL"}
_STYLES = {Severity.OK: "green", Severity.WARNING: "yellow", Severity.ERROR: "bold red"}
_FIRST = (Severity.ERROR, Severity.WARNING, Severity.OK)
LEAST_WIDTH = 100


def check_booth(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    say: bool,
    watch_s: float | None,
    as_json: bool,
) -> int:
    """Try everything that a booth needs, tell it, and return the exit code; ``watch_s`` is the time between two looks.

    Raises UserInputError for what is wrong in the study, after the results.
    """
    look = partial(_look_at_booth, data, checked_site(site), study, robot_host, robot_port)
    booth, found = look(as_json=as_json)
    if say:
        found = (*found, *say_all(booth))
    _tell(found, as_json=as_json)
    if watch_s is not None:
        click.echo(f"Looking again every {watch_s:g} s until Ctrl+C.", err=True)
    try:
        while watch_s is not None:
            _wait(watch_s)
            before, (booth, found) = found, look(as_json=as_json)
            if changed := _changes(before, found):
                _tell(found, as_json=as_json, changed=changed)
    except KeyboardInterrupt:
        # That is how it ends.
        click.echo(err=True)
    nouns = tuple(f"{group.noun} " for group in ExtensionGroup)
    broken = [each.message for each in found if each.severity is Severity.ERROR and each.name.startswith(nouns)]
    if booth.faults or broken:
        raise UserInputError(*dict.fromkeys((*booth.faults, *broken)))
    return 0 if is_ready(found) else NOT_READY


def is_ready(found: Iterable[CheckResult]) -> bool:
    """Whether a session can be held."""
    return all(result.severity is not Severity.ERROR for result in found)


def _look_at_booth(
    data: Path, site: str, study: Path | None, robot_host: str | None, robot_port: int | None, *, as_json: bool
) -> tuple[CheckTargets, tuple[CheckResult, ...]]:
    """Read the study file and try everything; what needs you comes first."""
    booth = booth_of(data, site, study, robot_host, robot_port)
    looks = tuple(all_checks(booth))
    with progress_bar("looking", len(looks), hidden=as_json) as tell:
        return booth, in_order_of_severity(run_checks(looks, tell))


def in_order_of_severity(found: Iterable[CheckResult]) -> tuple[CheckResult, ...]:
    """Return the results with the failures first, then the warnings; each kind stays in the order of the looks."""
    return tuple(sorted(found, key=lambda result: _FIRST.index(result.severity)))


def _wait(seconds: float) -> None:
    """Wait; Ctrl+C raises KeyboardInterrupt."""
    time.sleep(seconds)


def _changes(before: Iterable[CheckResult], now: Iterable[CheckResult]) -> list[str]:
    """Name what is better or worse than before, or new.

    Words alone do not count: how much memory is free changes all the time.
    """
    was = {(each.name, each.remedy): each.severity for each in before}
    names = {name: severity for (name, _), severity in was.items()}
    return [
        f"{each.name}: {_MARKS[names[each.name]] if each.name in names else 'new'} -> {_MARKS[each.severity]}"
        for each in now
        if was.get((each.name, each.remedy)) is not each.severity
    ]


def _tell(found: tuple[CheckResult, ...], *, as_json: bool, changed: Sequence[str] = ()) -> None:
    ready = is_ready(found)
    if as_json:
        rows = [asdict(result) | {"severity": result.severity.value} for result in found]
        click.echo(json.dumps({"ready": ready, "results": rows} | ({"changed": changed} if changed else {})))
        return
    if changed:
        click.echo(f"\n{datetime.now().astimezone():%H:%M:%S}  {', '.join(changed)}")
    show(found)


def say_all(booth: CheckTargets) -> Iterator[CheckResult]:
    """Say a sentence in every language, one after another, at the study's volume."""
    if booth.settings is None or booth.study is None:
        return
    for plan in booth.study.plans:
        command = voice_program(booth.settings.voice_from_here, plan.language)
        yield robots_checks.say_check(command, plan.language, plan.catalogue.text(SENTENCE))


def booth_of(data: Path, site: str, file: Path | None, host: str | None, port: int | None) -> CheckTargets:
    """Return what is to be looked at; what is wrong with the study file is among it."""
    if data.exists() and not data.is_dir():
        raise UserInputError(f"the data folder {data} cannot be used: it is a file")
    settings: Settings | None = None
    study: StudyConfig | None = None
    faults: tuple[str, ...] = ()
    try:
        settings = read_settings(file, host, port)
        study = read_study(settings)
        check_robot(settings)
    except UserInputError as refusal:
        faults = refusal.sentences
    return CheckTargets(data, site, in_use(data), file, settings, study, faults)


def show(found: tuple[CheckResult, ...]) -> None:
    """Print what was found as a table, and whether a session can be held."""
    drawn = console(least_width=LEAST_WIDTH)
    table = Table(box=None, show_header=False, pad_edge=False)
    for result in found:
        style = _STYLES[result.severity]
        words = result.message if result.is_ok else f"{result.message}\n-> {result.remedy}"
        table.add_row(Text(_MARKS[result.severity], style), result.name, words)
    drawn.print(table)
    bad, warnings = (sum(result.severity is state for result in found) for state in (Severity.ERROR, Severity.WARNING))
    drawn.print(_verdict(bad, warnings, ready=is_ready(found)))


def _verdict(bad: int, warnings: int, *, ready: bool) -> str:
    if not ready:
        return f"No session can be held until every {_MARKS[Severity.ERROR]} is fixed ({bad})."
    return f"A session can be held; warnings: {warnings or 'none'}."
