"""Markers of what is recorded reach a recorder of the Lab Streaming Layer, with the moments they happened at."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any
from uuid import uuid4

import pytest
from PySide6.QtCore import QCoreApplication, QObject
from pytestqt.qtbot import QtBot

from kiosk.config import MarkersConfig
from kiosk.experiment.events import ContinuePressed, SessionEnded, StopPressed
from kiosk.experiment.outcomes import Status
from kiosk.preflight import Severity
from kiosk.robots import lsl_worker
from kiosk.ui.markers import MOST_WAITING, MarkerStream

PARTICIPANT = "A-012"


@pytest.fixture
def owner(qapp: QCoreApplication) -> QObject:
    """Own what a test starts."""
    return QObject(qapp)


def stream(owner: QObject, folder: Path, now_s: float = 100.0) -> tuple[MarkerStream, Path]:
    """Return a stream whose process writes what it is given into a file."""
    out = folder / "sent.jsonl"
    copy = f"import sys, shutil; shutil.copyfileobj(sys.stdin, open({str(out)!r}, 'w'))"
    command = (sys.executable, "-c", copy)
    return MarkerStream(MarkersConfig(lsl=True), "test", owner, now_s=lambda: now_s, command=command), out


def test_a_marker_says_what_happened_when_and_to_which_participant(owner: QObject, tmp_path: Path) -> None:
    markers, out = stream(owner, tmp_path)
    events = [StopPressed(at_ms=4_000), SessionEnded(at_ms=4_250, status=Status.WITHDRAWN)]
    markers.send(PARTICIPANT, events, now_ms=5_000)
    markers.close()
    assert [json.loads(line) for line in out.read_text().splitlines()] == [
        {"happened": 99.0, "event": "StopPressed", "participant": PARTICIPANT, "at_ms": 4_000},
        {"happened": 99.25, "event": "SessionEnded", "participant": PARTICIPANT, "at_ms": 4_250},
    ]


def test_a_process_that_takes_nothing_does_not_fill_the_memory(
    owner: QObject, caplog: pytest.LogCaptureFixture
) -> None:
    command = (sys.executable, "-c", "input(); input()")
    markers = MarkerStream(MarkersConfig(lsl=True), "test", owner, command=command)
    for _ in range(2 * MOST_WAITING // 80):
        markers.send(PARTICIPANT, [ContinuePressed(at_ms=1)], now_ms=1)
    assert markers._process.bytesToWrite() < MOST_WAITING + 200
    markers.close()
    assert "markers were dropped" in caplog.text


def test_a_process_that_ends_is_written_down_and_disturbs_nothing(
    owner: QObject, qtbot: QtBot, caplog: pytest.LogCaptureFixture
) -> None:
    markers = MarkerStream(MarkersConfig(lsl=True), "test", owner, command=("no-such-program",))
    qtbot.waitUntil(lambda: not markers.is_alive)
    markers.send(PARTICIPANT, [ContinuePressed(at_ms=1)], now_ms=1)
    markers.close()
    assert "the process that sends markers has ended" in caplog.text


def test_what_the_kiosk_cannot_have_written_is_left_out() -> None:
    lines = ["no JSON", "[]", '{"event": "X"}', '{"happened": "soon"}', '{"happened": 2.5, "event": "CardFlipped"}']
    assert list(lsl_worker._markers(lines)) == [('{"event": "CardFlipped"}', 2.5)]


def test_a_check_names_the_library_that_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lsl_worker, "find_spec", lambda _: None)
    (missing,) = lsl_worker.lsl_check("Recollect")
    assert missing.severity is Severity.ERROR
    assert "recollect[lsl]" in missing.remedy


@pytest.fixture(scope="module")
def pylsl(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the library, which is to look no further than this machine."""
    with pytest.MonkeyPatch.context() as patch:
        file = tmp_path_factory.mktemp("lsl") / "lsl_api.cfg"
        file.write_text("[multicast]\nResolveScope = machine\n[log]\nlevel = -3\n")
        patch.setenv("LSLAPICFG", str(file))
        yield pytest.importorskip("pylsl", reason="the Lab Streaming Layer is not installed")


def test_a_recorder_receives_the_markers_of_a_kiosk(pylsl: Any, owner: QObject) -> None:
    source = f"recollect-{uuid4()}"
    markers = MarkerStream(MarkersConfig(lsl=True, stream="Booth"), source, owner)
    (found,) = pylsl.resolve_byprop("source_id", source, timeout=60)
    assert (found.name(), found.type()) == ("Booth", "Markers")
    recorder = pylsl.StreamInlet(found)
    recorder.open_stream(timeout=60)
    before = pylsl.local_clock()
    markers.send(PARTICIPANT, [ContinuePressed(at_ms=2_000), StopPressed(at_ms=2_600)], now_ms=3_000)
    assert markers._process.waitForBytesWritten()
    (first,), at = recorder.pull_sample(timeout=60)
    (second,), later = recorder.pull_sample(timeout=60)
    recorder.close_stream()
    markers.close()
    assert json.loads(first) == {"event": "ContinuePressed", "participant": PARTICIPANT, "at_ms": 2_000}
    assert json.loads(second)["event"] == "StopPressed"
    assert later - at == pytest.approx(0.6, abs=1e-6)
    assert at == pytest.approx(before - 1, abs=0.5)


@pytest.mark.usefixtures("pylsl")
def test_the_worker_ends_with_its_input() -> None:
    lsl_worker.run_lsl_worker("Booth", f"recollect-{uuid4()}", io.StringIO("no JSON\n"))
