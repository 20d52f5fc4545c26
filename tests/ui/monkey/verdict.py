"""What is seen of a kiosk and its supervisor while the monkey is at it, and what of that must not be."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby

ANSWER_S = 60.0
"""A kiosk that is up and answers no input for so long is wedged: "still there?" alone would end a session before."""
BACK_S = 30.0
"""From the end of a kiosk to the first frame of the next one, on a machine that has other things to do."""
BY_ITSELF = frozenset(("TimerExpired", "SpeechStarted", "SpeechFinished", "SpeechFailed", "RobotDisconnected"))
"""Events that are no answer to an input."""
WARM_S = 1080.0
"""Fonts, pictures and pages are loaded when they are first needed, and a monkey comes late to some of them.

In 27 minutes without kills a kiosk grew in steps from 210 to 244 MiB, the last one after 17 minutes, and stayed there.
"""
LEAST_S = 240.0
"""A slope over less says nothing."""
DAY_H = 12
FREE_MIB = 1024 - 160
"""What a kiosk may grow before its supervisor ends it; all of that in a day would be a kiosk that is not flat."""
STEEPEST = FREE_MIB / DAY_H


@dataclass(frozen=True)
class Weighed:
    """The memory of a process at one moment."""

    at_s: float
    process: int
    mib: float


def slope_mib_per_hour(weighed: Sequence[Weighed]) -> float | None:
    """Return how fast memory grows, by least squares over all processes that lasted; None where none did.

    Each process has a height of its own, and one slope is shared.
    """
    upper = lower = 0.0
    for _, of_one in groupby(sorted(weighed, key=lambda each: (each.process, each.at_s)), lambda each: each.process):
        points = list(of_one)
        points = [each for each in points if each.at_s - points[0].at_s >= WARM_S]
        if not points or points[-1].at_s - points[0].at_s < LEAST_S:
            continue
        middle_s = sum(each.at_s for each in points) / len(points)
        middle_mib = sum(each.mib for each in points) / len(points)
        upper += sum((each.at_s - middle_s) * (each.mib - middle_mib) for each in points)
        lower += sum((each.at_s - middle_s) ** 2 for each in points)
    return upper / lower * 3600 if lower else None


@dataclass
class Seen:
    """All that was seen from outside."""

    screens: Counter[str] = field(default_factory=Counter)
    """How often each screen came."""
    stages: Counter[str] = field(default_factory=Counter)
    """How often each stage of a session was reached."""
    answers: Counter[str] = field(default_factory=Counter)
    """How often the session has handled an event of each kind."""
    inputs: Counter[str] = field(default_factory=Counter)
    ends: Counter[str] = field(default_factory=Counter)
    """What the supervisor told of its kiosks' ends."""
    robot: Counter[str] = field(default_factory=Counter)
    kills: int = 0
    supervisors_killed: int = 0
    left: int = 0
    """How often the supervisor was gone, as after it was killed, and was started again."""
    longest_silence_s: float = 0.0
    longest_away_s: float = 0.0
    most_kiosks: int = 0
    weights: dict[str, list[Weighed]] = field(default_factory=lambda: defaultdict(list))
    """Of the kiosk and of the supervisor."""
    in_log: list[str] = field(default_factory=list)
    flaws: list[str] = field(default_factory=list)
    """What ``recollect verify`` finds afterwards."""
    stuck: list[str] = field(default_factory=list)
    """Where it did not come back, or had to be helped."""

    def faults(self) -> Iterator[str]:
        """Yield what must not be."""
        yield from self.stuck
        if self.longest_silence_s > ANSWER_S:
            yield f"for {self.longest_silence_s:.0f} s no input was answered"
        if self.longest_away_s > BACK_S:
            yield f"the kiosk was away for {self.longest_away_s:.0f} s"
        if self.most_kiosks > 1:
            yield f"{self.most_kiosks} kiosks ran at once"
        for of, weighed in self.weights.items():
            slope = slope_mib_per_hour(weighed)
            if slope is not None and slope > STEEPEST:
                yield f"the {of} grew by {slope:.0f} MiB an hour"
        yield from (f"in the log: {line}" for line in self.in_log)
        yield from (f"verify: {flaw}" for flaw in self.flaws)


def troubles(log: str) -> list[str]:
    """Return the lines of a log, or of what a program said, that tell of a fault of ours."""
    return [line for line in log.splitlines() if "Traceback (most recent" in line or " CRITICAL " in line]
