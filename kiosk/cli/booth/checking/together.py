"""Many looks at once, each with a deadline of its own: whatever hangs is left behind, and said to hang."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass

from kiosk.cli.progress import Tell
from kiosk.findings import Finding, Probe

_TICK_S = 0.1
_LATE = "start the machine again, if it stays so"


@dataclass(frozen=True)
class _Outcome:
    """What became of the probe of a number: what it found, or a fault of ours."""

    number: int
    found: tuple[Finding, ...]
    fault: Exception | None = None


def look(probes: Sequence[Probe], tell: Tell) -> tuple[Finding, ...]:
    """What all probes find, in their order; a fault of ours is raised when all have had their time."""
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
    return tuple(finding for number in range(len(probes)) for finding in outcomes[number].found)


def _look(number: int, probe: Probe, heard: queue.SimpleQueue[_Outcome]) -> None:
    try:
        heard.put(_Outcome(number, tuple(probe.look())))
    except Exception as fault:  # noqa: BLE001 - it is raised again by whoever waits
        heard.put(_Outcome(number, (), fault))


def _late(probes: Sequence[Probe], outcomes: dict[int, _Outcome], passed_s: float) -> dict[int, _Outcome]:
    """What is said of probes whose time is over."""
    over = ((n, probe) for n, probe in enumerate(probes) if n not in outcomes and passed_s > probe.within_s)
    return {
        number: _Outcome(number, (Finding(probe.what, probe.late, f"no answer within {probe.within_s:g} s", _LATE),))
        for number, probe in over
    }
