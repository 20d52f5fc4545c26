"""How long visitors wait: before a robot is asked, until the avatar takes over, until the board is open.

``pytest -s tests/bench/test_embodiment.py`` prints medians and 99th percentiles. The fake robot runs in this process.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import quantiles
from time import monotonic
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.store.recorder import Recorder
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.robots.furhat_fake import FurhatFake
from tests.robots.furhat_fake import Mode as Fault
from tests.ui.headless import headless, short

SESSIONS = 5
LOSSES = 20
FAR_TOO_LONG_MS = 500
"""Well above what any machine needs, and below what any visitor would call waiting."""


@pytest.fixture(autouse=True)
def _nothing_else_runs(pytestconfig: pytest.Config) -> None:
    """Measure only where benches are asked for: beside other tests, the times are those of the tests."""
    if pytestconfig.getoption("benchmark_disable"):
        pytest.skip("benches are switched off")


@contextmanager
def kiosk(data: Path, pace: ClockMode, fake: FurhatFake) -> Iterator[App]:
    """Provide a kiosk with this robot, which is tried again soon after a loss."""
    robot = {"kind": "furhat", "host": "127.0.0.1", "port": fake.port, "backoff_initial_ms": 5, "backoff_max_ms": 5}
    with headless(short(robot=robot, voice={"device": "null"}), data, mode=RunMode(WindowMode.NOWHERE, pace)) as app:
        yield app


def told(what: str, times_ms: list[float]) -> None:
    """Print the middle and the slow end."""
    cuts = quantiles(times_ms, n=100, method="inclusive")
    print(f"\n{what}: {len(times_ms)} times, p50 {cuts[49]:.1f} ms, p99 {cuts[98]:.1f} ms")  # noqa: T201 - a bench
    assert cuts[49] < FAR_TOO_LONG_MS


def noting(call: Callable[..., Any], note: Callable[..., None]) -> Callable[..., Any]:
    """Return the same call, noted just before it is made."""

    def noted(*arguments: Any, **options: Any) -> Any:
        note(*arguments, **options)
        return call(*arguments, **options)

    return noted


def test_from_a_hint_to_the_robot_and_from_its_last_word_to_the_open_board(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    del qtbot  # the kiosk needs its application
    decided: dict[str, float] = {}
    ended: list[float] = []
    opened: list[float] = []
    asked: list[float] = []

    def decide(_: object, events: tuple[happened.Event, ...]) -> None:
        decided.update({event.sentence: monotonic() for event in events if isinstance(event, happened.HintGiven)})

    with FurhatFake(character_ms=0.2) as fake:
        answer = fake.answer

        def answered(*arguments: Any) -> Any:
            done = answer(*arguments)
            if arguments[0].path == "/furhat/say" and arguments[0].parameters["text"] in decided:
                asked.append(arguments[0].at - decided[arguments[0].parameters["text"]])
                ended.append(monotonic())
            return done

        monkeypatch.setattr(fake, "answer", answered)
        monkeypatch.setattr(Recorder, "append", noting(Recorder.append, decide))
        with kiosk(tmp_path, ClockMode.VIRTUAL, fake) as app:
            for seed in range(SESSIONS):
                rehearsal = Rehearsal(app, seed)
                watch = app.runner.on_event
                assert watch is not None

                def look(event: Any, outcome: Any, stage: Any, watch: Any = watch) -> None:
                    if isinstance(event, happened.SpeechFinished) and do.UnlockBoard() in outcome.effects:
                        opened.append(monotonic() - ended[-1])
                    watch(event, outcome, stage)

                app.runner.on_event = look
                rehearsal.run()
    told("hint decided to request at the robot", [1000 * seconds for seconds in asked])
    told("end of the robot's speech to board open", [1000 * seconds for seconds in opened])


def test_from_a_failure_to_the_avatars_voice(qtbot: QtBot, tmp_path: Path) -> None:
    lost: list[float] = []
    spoke: list[float] = []
    taken: list[float] = []
    with FurhatFake() as fake, kiosk(tmp_path, ClockMode.WALL, fake) as app:
        app.runner.robot_lost = noting(app.runner.robot_lost, lambda _: lost.append(monotonic()))  # type: ignore[method-assign]
        app.runner.speech_started = noting(  # type: ignore[method-assign]
            app.runner.speech_started, lambda _: spoke.append(monotonic())
        )
        for _ in range(LOSSES):
            fake.mode = Fault.WELL
            qtbot.waitUntil(
                lambda: (
                    app.embodiments.current is not None
                    and app.embodiments.current.name == EmbodimentName.robot("furhat")
                ),
                timeout=10_000,
            )
            fake.mode = Fault.RESET
            lost.clear()
            app.screens.attract.start("en")
            qtbot.waitUntil(lambda: bool(lost and spoke and spoke[-1] > lost[-1]), timeout=10_000)
            taken.append(spoke[-1] - lost[-1])
            app.runner.close()
    told("failure noticed to avatar speaking", [1000 * seconds for seconds in taken])
