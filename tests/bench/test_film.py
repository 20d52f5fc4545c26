"""How long a film takes to make: less than the session took."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import Any

import pytest

from kiosk.experiment.replay import replay_events
from kiosk.ui.film import write_film
from kiosk.ui.replay import Replay
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.experiment.driver import Driver, with_memory
from tests.samples import whole

SEED = 5


@pytest.mark.usefixtures("qapp")
def test_a_film_takes_less_time_than_the_session_took(benchmark: Any, tmp_path: Path) -> None:
    played = Driver(whole(), SEED)
    played.whole_session(with_memory(2))
    steps = replay_events(played.plan, SEED, played.events)

    def film() -> float:
        begun = monotonic()
        with Replay(RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL), played.plan, steps, "Session 1") as replay:
            seconds = write_film(replay, played.plan.catalogue, tmp_path / "film.webm", memory=True)
        return (monotonic() - begun) / seconds

    share = benchmark.pedantic(film, rounds=1, iterations=1)
    benchmark.extra_info["of_the_session"] = share
    assert share < 1
