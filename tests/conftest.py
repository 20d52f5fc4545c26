"""What every test has: a home for data of its own, so that no test sees what this machine's user has stored."""

from __future__ import annotations

import gc
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, settings

from kiosk.ui.qt_platform import remove_import_hook
from tests.forked import LoadedProgram

# A machine that is slow or has company must not fail a test.
settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")
settings.register_profile("fast", settings.get_profile("untimed"), max_examples=50)

SLOW = (
    *("ui", "packaging", "plugins", "analysis", "training", "bench", "supervisor", "export"),
    *("cli/test_readme.py", "cli/test_pages.py", "cli/test_supervise.py", "cli/test_output.py"),
    "cli/test_explain_session.py",
    *("cli/test_robot.py", "cli/test_check.py", "assistance/test_truth.py", "experiment/test_any_session.py"),
    *("experiment/test_replay.py", "experiment/test_stages.py", "experiment/test_two_conditions.py"),
    *("experiment/test_events.py", "store/maintenance/test_withdraw_cut_off.py", "store/test_hard_times.py"),
    "store/test_power_cut.py",
    *("study/test_forming.py", "study/test_imported.py", "robots/test_speech.py", "test_story.py"),
    *("study/test_any_study.py", "study/test_translations.py", "cli/test_backup.py", "test_remote.py"),
)
"""Folders and files of tests that open windows, start programs, train, or play hundreds of games."""

LONGEST = (
    *("cli/test_pages.py", "ui/test_every_language_fits.py", "packaging/test_builds.py", "cli/test_readme.py"),
    *("analysis/test_plan.py", "ui/test_faults.py", "ui/test_pages_settle.py", "ui/test_whole_session.py"),
    *("test_story.py", "ui/test_accessibility.py", "ui/test_resume.py", "ui/test_without_a_mouse.py"),
    *("ui/test_long_words.py", "store/maintenance/test_withdraw_cut_off.py", "cli/test_robot.py"),
    *("ui/experimenter/test_shortcuts.py", "ui/test_nothing_is_left.py", "ui/test_full_disk.py"),
    *("plugins/test_robot.py", "training/test_simulated_players.py", "cli/test_supervise.py", "export/test_export.py"),
    *("cli/test_study.py", "test_walls.py", "store/maintenance/test_merge.py", "experiment/test_session.py"),
)
"""Files that take longest. They begin first, so that no process works on alone at the end."""

CACHE = Path(__file__).parents[1] / ".pytest_cache"
FONTS = CACHE / "matplotlib"
"""Where a run leaves matplotlib's list of fonts, which each process would make anew in a second."""

RULES = CACHE / "rules"
"""Where a run leaves the compiled rules of the training for the next; the folder in it is named after their text."""

HOME = pytest.StashKey[TemporaryDirectory[str]]()


def pytest_configure(config: pytest.Config) -> None:
    """Keep the default data folder of this process, and of those that it starts, in a temporary directory.

    The commands read the folder when they are imported, so a fixture would come too late.
    """
    if config.option.markexpr == "not slow":
        # Half of the examples that all tests try.
        settings.load_profile("fast")
    config.stash[HOME] = TemporaryDirectory(prefix="recollect-tests-")
    os.environ["XDG_DATA_HOME"] = config.stash[HOME].name
    if "PYTEST_XDIST_WORKER" not in os.environ:
        # All workers share it: compiling the rules takes each of them half a minute.
        os.environ["XDG_CACHE_HOME"] = f"{config.stash[HOME].name}/cache"
        if RULES.is_dir():
            shutil.copytree(RULES, Path(config.stash[HOME].name) / "cache" / "recollect")
        FONTS.mkdir(parents=True, exist_ok=True)
        os.environ.setdefault("MPLCONFIGDIR", str(FONTS))
        # The matrices of the tests are small: further threads only wait for each other, at full speed.
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        # glibc reads it when a process begins. Windows of Qt take 8 % less time with their memory in large pages.
        os.environ.setdefault("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # A shell that runs the tests in the background lets them ignore it, and so every program that they start.
        signal.signal(signal.SIGINT, signal.default_int_handler)
    _keep_bytecode()
    if "PySide6" in sys.modules:
        # pytest-qt has loaded it: with its hook, a collection takes 8 % longer.
        remove_import_hook()


def _keep_bytecode() -> None:
    """Let this process, and those that it starts, keep compiled modules, also where the environment forbids it.

    The tests start the program some two hundred times, and each start would compile all of it anew.
    """
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave slow files unread when they are deselected: importing Qt and matplotlib takes longer than most tests."""
    return True if config.option.markexpr == "not slow" and _is_slow(_place(collection_path)) else None


@cache
def _place(path: Path) -> str:
    """Return where a file or folder lies below that of the tests."""
    here = Path(__file__).parent
    return path.relative_to(here).as_posix() if path.is_relative_to(here) else ""


def _is_slow(place: str) -> bool:
    return place in SLOW or place.partition("/")[0] in SLOW


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the slow tests, so that ``pytest -m "not slow"`` runs the other ones, and put the longest first."""
    paths = {item: _place(item.path) for item in items}
    for item, path in paths.items():
        if _is_slow(path):
            item.add_marker(pytest.mark.slow)
    items.sort(key=lambda item: LONGEST.index(paths[item]) if paths[item] in LONGEST else len(LONGEST))


@pytest.fixture(scope="session")
def loaded_program() -> Iterator[LoadedProgram]:
    """Provide the program, loaded once for all files of this process that run commands."""
    if sys.platform == "win32":
        pytest.skip("a process cannot be copied there")
    with LoadedProgram() as program:
        yield program


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Look for no garbage while the tests are collected, and later neither at what is in memory by then, nor often.

    Ten thousand tests are two million objects, of which nearly none are garbage, and every full collection would look
    at all of them. With Python's own thresholds, what the tests themselves leave behind takes a twentieth of a run.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(10_000, 10, 10)
        gc.enable()


def pytest_unconfigure(config: pytest.Config) -> None:
    """Delete that directory, but for the compiled rules."""
    if "PYTEST_XDIST_WORKER" not in os.environ:
        _keep_rules(Path(config.stash[HOME].name) / "cache" / "recollect")
    config.stash[HOME].cleanup()


def _keep_rules(cache: Path) -> None:
    """Keep the rules that were compiled last: compiling them takes 11 seconds, and they say whether they still hold."""
    made = max(cache.glob("rules-*"), key=lambda folder: folder.stat().st_mtime, default=None)
    if made is None:
        return
    whole = RULES.with_name(f"rules-{os.getpid()}")
    shutil.copytree(made, whole / made.name)
    shutil.rmtree(RULES, ignore_errors=True)
    # Another run may have put its own there meanwhile.
    with suppress(OSError):
        whole.rename(RULES)
    shutil.rmtree(whole, ignore_errors=True)
