"""What ``python -m tests.ui.monkey`` takes for a fault, and how its monkey learns; the monkey itself takes minutes."""

from __future__ import annotations

from random import Random

import pytest

from tests.ui.monkey.verdict import ANSWER_S, LEAST_S, STEEPEST, WARM_S, Seen, Weighed, slope_mib_per_hour, troubles

HOUR_S = 3600


def weighed(process: int, start_mib: float, mib_per_hour: float, for_s: int = 1800, *, noise: int = 0) -> list[Weighed]:
    """Return the memory of a process that grows evenly, and jumps in its first minute."""
    chance = Random(noise)
    return [
        Weighed(
            at,
            process,
            start_mib + mib_per_hour * at / HOUR_S + (80 if at > WARM_S / 2 else 0) + noise * chance.random(),
        )
        for at in range(0, for_s, 5)
    ]


def test_memory_that_is_flat_after_the_start_has_no_slope() -> None:
    assert slope_mib_per_hour([*weighed(1, 100, 0), *weighed(2, 180, 0)]) == pytest.approx(0, abs=1e-6)


def test_processes_of_different_height_share_one_slope() -> None:
    both = [*weighed(1, 100, 30), *weighed(2, 180, 30, noise=1)]
    assert slope_mib_per_hour(both) == pytest.approx(30, abs=3)


def test_a_process_that_did_not_last_says_nothing() -> None:
    assert slope_mib_per_hour(weighed(1, 100, 900, for_s=int(WARM_S + LEAST_S) - 10)) is None


def test_a_run_without_trouble_has_no_fault() -> None:
    assert list(Seen(longest_silence_s=20, longest_away_s=9, most_kiosks=1).faults()) == []


def test_each_kind_of_trouble_is_a_fault() -> None:
    seen = Seen(
        longest_silence_s=ANSWER_S + 1, longest_away_s=99, most_kiosks=2, flaws=["x"], in_log=["y"], stuck=["z"]
    )
    seen.weights["kiosk"] = weighed(1, 100, 2 * STEEPEST)
    assert len(list(seen.faults())) == 7


def test_a_fault_of_ours_is_found_in_a_log() -> None:
    log = "WARNING kiosk: no sound\n1 CRITICAL kiosk.ui.app: a fault\nTraceback (most recent call last):\n  File x\n"
    assert len(troubles(log)) == 2
