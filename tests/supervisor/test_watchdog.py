"""Silence is counted in time in which the supervisor itself was awake."""

from __future__ import annotations

from dataclasses import dataclass, field

from kiosk.sd_notify import Notice
from kiosk.supervisor import Timeouts, Watchdog

PATIENCE = Timeouts(silence=5, start=30, tick=0.1)


@dataclass
class Program:
    """A program that tells what it is given to tell, on a clock that the test turns."""

    now: float = 0.0
    ended: bool = False
    step: float = 0.1
    to_tell: list[Notice] = field(default_factory=list)

    def hear(self, within_s: float) -> Notice:  # noqa: ARG002 - the clock is turned by the step
        """Return the next notice; time passes."""
        self.now += self.step
        return self.to_tell.pop(0) if self.to_tell else {}

    def dead(self) -> bool:
        """Whether it was made to end."""
        return self.ended


def watched(program: Program) -> Watchdog:
    """Return a watch over it."""
    return Watchdog(program, PATIENCE, lambda: program.now)


def seconds_until_over(watch: Watchdog, program: Program) -> float:
    """For how long it is borne with from now on."""
    began = program.now
    while not watch.over():
        watch.hear()
    return round(program.now - began, 1)


def test_a_program_has_long_until_its_first_frame_and_then_only_from_beat_to_beat() -> None:
    program = Program()
    watch = watched(program)
    assert not watch.up
    assert abs(seconds_until_over(watch, program) - PATIENCE.start) <= PATIENCE.tick
    program = Program(to_tell=[{}, {"READY": "1"}])
    watch = watched(program)
    watch.hear()
    watch.hear()
    assert watch.up
    assert abs(seconds_until_over(watch, program) - PATIENCE.silence) <= PATIENCE.tick


def test_every_beat_begins_the_silence_anew_and_a_status_does_not() -> None:
    program = Program(to_tell=[{"READY": "1"}, *[{"WATCHDOG": "1"}] * 500, *[{"STATUS": "game"}] * 40])
    watch = watched(program)
    assert seconds_until_over(watch, program) == 50.1 + PATIENCE.silence


def test_a_beat_before_the_first_frame_is_no_first_frame() -> None:
    program = Program(to_tell=[{"WATCHDOG": "1"}] * 400)
    assert abs(seconds_until_over(watched(program), program) - PATIENCE.start) <= PATIENCE.tick


def test_nobody_is_to_blame_while_the_whole_machine_stood_still() -> None:
    program = Program(to_tell=[{"READY": "1"}])
    watch = watched(program)
    watch.hear()
    program.step = 3_600
    watch.hear()
    assert not watch.over()


def test_the_dead_are_not_waited_for() -> None:
    program = Program(ended=True)
    assert watched(program).over()


def test_the_pause_grows_while_one_after_another_dies_young() -> None:
    assert [Timeouts().pause(died_young) for died_young in range(9)] == [0, 0, 1, 2, 4, 8, 16, 30, 30]
