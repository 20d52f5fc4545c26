"""A test that waits for a program without an end fails in words, and leaves nothing running."""

from __future__ import annotations

import subprocess
import sys

import psutil
import pytest

from tests.patience import end_all, limited, started

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there is no such shell")

SLEEPS = ("sh", "-c", "sleep 600 & echo $!; wait")
"""A program that says the number of its child, which holds its output as well, and then nothing more."""

ANSWERS = ("sh", "-c", "while read line; do echo $line; done")


def is_gone(process: int) -> bool:
    """Whether a process has ended, soon; one that was not waited for yet has as well."""
    try:
        psutil.Process(process).wait(10)
    except psutil.NoSuchProcess:
        return True
    except psutil.TimeoutExpired:
        return psutil.Process(process).status() == psutil.STATUS_ZOMBIE
    return True


def test_a_line_that_never_comes_ends_the_program_and_all_that_it_started_in_words() -> None:
    children = []

    def wait_for_a_line() -> None:
        with started(SLEEPS, within_s=1, stdout=subprocess.PIPE, text=True) as program:
            children.append(int(program.stdout.readline()))
            assert program.stdout.readline() == "a line"

    with pytest.raises(AssertionError, match=r"^this was not done within 1 s, so it was ended: sh -c sleep 600"):
        wait_for_a_line()
    (child,) = children
    assert is_gone(child)


def test_a_program_that_does_not_end_by_itself_fails_the_test() -> None:
    with pytest.raises(AssertionError, match="this was not done"), started(SLEEPS, within_s=0.2):
        pass


def test_a_test_that_fails_waits_for_nothing() -> None:
    with pytest.raises(ZeroDivisionError), started(SLEEPS) as program:
        raise ZeroDivisionError
    assert program.returncode < 0


def test_a_program_that_answers_in_time_goes_on() -> None:
    with started(ANSWERS, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as program:
        for word in ("one", "two"):
            with limited(program):
                program.stdin.write(f"{word}\n")
                assert program.stdout.readline() == f"{word}\n"
        program.stdin.close()
    assert program.returncode == 0


def test_a_program_that_has_ended_can_be_ended() -> None:
    with started(("true",)) as program:
        program.wait()
        end_all(program)
    assert program.returncode == 0
