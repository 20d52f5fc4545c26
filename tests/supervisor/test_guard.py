"""A process that stands still, swells or does not end when asked is ended from outside, and the reason is said."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from contextlib import AbstractContextManager
from pathlib import Path

import psutil
import pytest

from kiosk import guard
from kiosk.guard import Limits, _Watch, guarded
from tests.patience import Program, started

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="it cannot fork")

KILLED = -9
BEAT = b"\0"
TERM = bytes([signal.SIGTERM])
STUCK_S = 60.0


def guarded_process(act: str, memory_mib: int = 4096) -> AbstractContextManager[Program]:
    """Return a guarded process that does this."""
    environment = {name: value for name, value in os.environ.items() if name != "NOTIFY_SOCKET"}
    return started(
        [sys.executable, "-m", "tests.supervisor.guarded", act, str(memory_mib)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_a_process_that_holds_pythons_lock_and_stands_still_is_ended_in_words() -> None:
    with guarded_process("burn") as process:
        _, said = process.communicate()
    assert process.returncode == KILLED
    assert said == "recollect: the interface stood still for 1 s, so it was ended\n"


def test_a_process_that_never_begins_is_ended_as_well() -> None:
    with guarded_process("begin never") as process:
        _, said = process.communicate()
    assert process.returncode == KILLED
    assert "stood still" in said


def test_a_process_that_takes_too_much_memory_is_ended_in_words() -> None:
    with guarded_process("swell", memory_mib=200) as process:
        # Its input stays open, with whose end it would leave.
        said = process.stderr.read()
    assert process.returncode == KILLED
    assert "MiB of memory and may take 200, so it was ended" in said


def test_what_a_process_held_before_it_was_guarded_does_not_count() -> None:
    with guarded_process("live large", memory_mib=200) as process:
        _, said = process.communicate(" " * 20)
    assert (process.returncode, said) == (0, "")


def test_a_process_that_is_asked_to_end_ends_although_it_stands_still() -> None:
    with guarded_process("be asked while burning") as process:
        assert process.stdout.readline() == "ready\n"
        process.terminate()
        _, said = process.communicate()
    assert process.returncode == KILLED
    assert said == "recollect: it was asked to end and did not, so it was ended\n"


def test_a_process_that_takes_notice_may_take_longer_to_close() -> None:
    with guarded_process("be asked") as process:
        assert process.stdout.readline() == "ready\n"
        process.terminate()
        told, said = process.communicate()
    assert (process.returncode, told, said) == (0, "left\n", "")


@pytest.mark.parametrize(("act", "code"), [("live", 0), ("kill itself", KILLED)])
def test_the_guard_ends_with_the_process_and_says_nothing(act: str, code: int) -> None:
    with guarded_process(act) as process:
        # The guard holds the other end of the errors: they end when it has ended too.
        _, said = process.communicate()
    assert (process.returncode, said) == (code, "")


def test_a_guard_that_is_stuck_is_not_waited_for(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    stuck = tmp_path / "stuck"

    def be_stuck(*_: object) -> None:
        stuck.write_text(str(os.getpid()))
        time.sleep(STUCK_S)
        os._exit(0)

    monkeypatch.setattr(guard, "_guard", be_stuck)
    began = time.monotonic()
    with guarded(environment={}):
        while not (stuck.exists() and stuck.read_text()):
            time.sleep(0.01)
    assert time.monotonic() - began < STUCK_S
    assert not psutil.pid_exists(int(stuck.read_text()))


def test_what_a_supervisor_guards_has_no_other_guard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "fork", lambda: pytest.fail("it has"))
    with guarded(environment={"NOTIFY_SOCKET": "somewhere", "WATCHDOG_USEC": "5000000"}) as beat:
        beat()


# What the guard makes of what it hears

LIMITS = Limits(start=30, silence=10, end=10, stuck=3, memory_mib=100)


def looks(*told: bytes, every_s: float = 1.0, taken_mib: int = 50) -> list[str]:
    """Return what is found wrong at each look."""
    watch = _Watch(LIMITS)
    return [watch.look(every_s, each, taken_mib) for each in told]


def test_silence_counts_from_the_last_beat() -> None:
    found = looks(BEAT, *[b""] * 9, BEAT, *[b""] * 10)
    assert found == [*[""] * 20, "the interface stood still for 10 s"]


def test_a_process_that_waits_for_a_processor_is_silent_only_for_what_it_had() -> None:
    watch = _Watch(LIMITS)
    watch.look(1, BEAT, 50)
    found = [watch.look(1, b"", 50, silent_s=0.25) for _ in range(40)]
    assert found == [*[""] * 39, "the interface stood still for 10 s"]


def test_there_is_long_patience_before_the_first_beat() -> None:
    assert looks(*[b""] * 30) == [*[""] * 29, "the interface stood still for 30 s"]


def test_whoever_answers_the_request_to_end_has_longer() -> None:
    assert looks(BEAT, TERM, *[b""] * 3)[-1] == "it was asked to end and did not"
    answered = looks(BEAT, TERM + BEAT, *[b""] * 9, BEAT)
    assert answered == [*[""] * 11, "it was asked to end and did not"]


def test_a_second_request_does_not_begin_the_time_anew() -> None:
    assert looks(BEAT, TERM, TERM, TERM, TERM)[-1] == "it was asked to end and did not"


def test_other_signals_ask_for_nothing() -> None:
    assert looks(BEAT, *[bytes([signal.SIGCHLD]) + BEAT] * 50)[-1] == ""


def test_memory_counts_from_before_the_guard_began() -> None:
    """A guard that begins late, as on a busy machine, would take what was taken meanwhile for what was there before."""
    reader, writer = os.pipe()
    fault = guard._watch(os.getpid(), reader, Limits(memory_mib=1), held_mib=0)
    for end in (reader, writer):
        os.close(end)
    assert fault.endswith("MiB of memory and may take 1")
