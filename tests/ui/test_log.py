"""What is logged of a session in which everything fails: that it failed, and nothing that is the visitor's."""

from __future__ import annotations

import errno
import logging
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from kiosk.cli.log import LOG, LOGS_KEPT, log_file
from kiosk.config import Settings
from kiosk.config import VoiceConfig as VoiceSettings
from kiosk.experiment.outcomes import Stage
from kiosk.ui.voice import EngineVoice
from tests.robots.furhat_fake import FurhatFake, Mode
from tests.ui.conftest import MakeBooth
from tests.ui.sabotage import Moment, Sabotage
from tests.ui.small_disk import SmallDisk
from tests.ui.test_full_disk import write_until
from tests.ui.test_nothing_is_left import Memory

SMALL = {
    "game": {"rows": 2, "columns": 3},
    "practice": {"rows": 2, "columns": 2},
    "questionnaires": ["gallery"],
}
TALKS_NONSENSE = "import sys; print('no line of ours', flush=True); sys.exit(3)"


@contextmanager
def logging_into(folder: Path) -> Iterator[Path]:
    """Log as a kiosk does, and more than it does: down to what only developers need."""
    root, handler = logging.getLogger(), log_file(folder)
    before = root.level
    root.addHandler(handler)
    root.setLevel(logging.DEBUG)
    try:
        yield folder / LOG
    finally:
        root.setLevel(before)
        root.removeHandler(handler)
        handler.close()


def raise_with(words: str) -> None:
    """Raise a fault of ours that repeats what it was given."""
    nothing: dict[str, str] = {}
    try:
        nothing[words]
    except KeyError as error:
        raise ValueError(f"{words!r} is no answer") from error


def test_nothing_that_a_visitor_typed_or_was_given_is_in_the_log_when_robot_voice_disk_and_we_fail(
    qtbot: QtBot, make_booth: MakeBooth, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    memory, disk = Memory(), SmallDisk()
    with logging_into(tmp_path / "log") as log, FurhatFake(character_ms=0.2) as fake:
        robot = {
            "kind": "furhat",
            "host": "127.0.0.1",
            "port": fake.port,
            "speech_deadline_ms_per_char": 1,
            "answer_deadline_ms": 300,
        }
        booth = make_booth(settings=Settings.model_validate(SMALL | {"robot": robot}), opened=disk.open)
        rehearsal = Sabotage(booth.app, 7, lambda: setattr(fake, "mode", Mode.RESET), Moment.GAME)
        check = booth.app.runner.on_event
        assert check is not None

        def watch(event: object, outcome: object, stage: Stage) -> None:
            memory.note(booth.app, event, outcome)  # type: ignore[arg-type]  # as the runner tells them
            check(event, outcome, stage)  # type: ignore[arg-type]
            if stage is Stage.THANKS:
                booth.app.quit()

        booth.app.runner.on_event = watch
        rehearsal.run()
        private = memory.typed | memory.codes
        assert memory.typed
        assert memory.codes
        disk.fill()
        write_until(booth, lambda: booth.screen == "pause")
        voice = EngineVoice(VoiceSettings(), "en", command=(sys.executable, "-c", TALKS_NONSENSE))
        with qtbot.waitSignal(voice.failed):
            voice.say(1, "A sentence.")
        voice.close()
        for words in private:
            try:
                raise_with(words)
            except ValueError as fault:
                booth.app.fault(type(fault), fault, fault.__traceback__)
        told = log.read_text("utf-8")
    for failure in (
        "the robot broke off",
        "disk full",
        "the voice",
        "a fault in Recollect",
        "raise_with",
        "KeyError",
    ):
        assert failure in told
    assert [words for words in private if words in told] == []
    caplog.clear()


def test_the_log_begins_anew_before_it_grows_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kiosk.cli.log.LOG_BYTES", 2_000)
    handler = log_file(tmp_path)
    for _ in range(200):
        handler.handle(logging.LogRecord("a", logging.WARNING, "a.py", 1, "the voice is gone", (), None))
    handler.close()
    files = list(tmp_path.iterdir())
    assert len(files) == 1 + LOGS_KEPT
    assert all(file.stat().st_size <= 2_000 for file in files)


def test_who_shares_a_log_writes_into_the_new_one_too(tmp_path: Path) -> None:
    supervisor = log_file(tmp_path, shared=True)
    record = logging.LogRecord("a", logging.WARNING, "a.py", 1, "start 1", (), None)
    supervisor.handle(record)
    (tmp_path / LOG).rename(tmp_path / f"{LOG}.1")
    supervisor.handle(record)
    assert "start 1" in (tmp_path / LOG).read_text("utf-8")


@pytest.mark.skipif(sys.platform == "win32", reason="modes are those of POSIX")
@pytest.mark.parametrize("shared", [True, False])
def test_a_log_is_for_its_owner_alone(tmp_path: Path, *, shared: bool) -> None:
    log_file(tmp_path, shared=shared).close()
    assert (tmp_path / LOG).stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("shared", [True, False])
def test_a_log_that_a_full_disk_does_not_take_stops_nothing_and_goes_on_when_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *, shared: bool
) -> None:
    record = logging.LogRecord("a", logging.WARNING, "a.py", 1, "start 1", (), None)

    def full(*_: object, **__: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(os, "open", full)
        log = log_file(tmp_path, shared=shared)
        log.handle(record)
    assert "could not be written: disk full" in capsys.readouterr().err
    log.handle(record)
    log.close()
    assert "start 1" in (tmp_path / LOG).read_text("utf-8")
