"""A test that waits for a program without an end fails in words, and leaves nothing running."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

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


def without_a_limit(tree: ast.AST) -> Iterator[int]:
    """Yield the lines of a module that start a program and may wait for it without an end."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Attribute(value=ast.Name("subprocess"), attr=attr), keywords=given):
                if attr in WAITING and "timeout" not in {each.arg for each in given}:
                    yield node.lineno
            case ast.With(items=[*items]):
                opened = [each.context_expr.func for each in items if isinstance(each.context_expr, ast.Call)]
                names = {each.attr if isinstance(each, ast.Attribute) else ast.unparse(each) for each in opened}
                if "Popen" in names and "limited" not in names:
                    yield node.lineno


WAITING = {"run", "call", "check_call", "check_output"}


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("subprocess.run(command, check=True)", [1]),
        ("subprocess.check_output(command, timeout=3)", []),
        ("with subprocess.Popen(command) as program: pass", [1]),
        ("with Popen(command) as program, open(file): pass", [1]),
        ("with subprocess.Popen(command) as program, limited(program): pass", []),
        ("with started(command) as program: pass", []),
    ],
)
def test_a_wait_without_a_limit_is_found(line: str, found: list[int]) -> None:
    assert list(without_a_limit(ast.parse(line))) == found


def test_no_test_waits_for_a_program_without_a_limit() -> None:
    here = Path(__file__).parent
    trees = {file: ast.parse(file.read_text("utf-8")) for file in here.rglob("*.py")}
    found = [f"{file.relative_to(here)}:{line}" for file, tree in trees.items() for line in without_a_limit(tree)]
    assert found == []
