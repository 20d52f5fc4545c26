"""``recollect robot`` tries a robot step by step and says what it found; ``rehearse`` plays a session with one."""

from __future__ import annotations

import json
import os
import queue
import signal
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.devices import greet
from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.robots.driver import SpokenClip
from kiosk.robots.voice_packs import PackClips
from tests.forked import LoadedProgram
from tests.patience import started
from tests.robots.furhat_fake import FurhatFake, Mode
from tests.robots.realtime_fake import RealtimeFake


def tried(*arguments: object) -> tuple[int, dict[str, Any]]:
    """Return the exit code and the object of ``recollect robot --json``."""
    result = CliRunner().invoke(recollect, ["robot", "--json", *map(str, arguments)])
    return result.exit_code, json.loads(result.stdout)


def steps(found: dict[str, Any]) -> dict[str, str]:
    """Return what every step found."""
    return {step["step"]: step["found"] for step in found["steps"]}


def test_a_pretended_furhat_takes_what_a_robot_takes_and_prints_it() -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = [sys.executable, "-u", "-m", "kiosk", "robot", "--pretend", "--port", str(port)]
    with started(command, stdout=subprocess.PIPE, text=True) as pretended:
        assert f"port {port}" in pretended.stdout.readline()
        code, found = tried("--host", "127.0.0.1", "--port", port, "--say", "Hi")
        pretended.send_signal(signal.SIGINT)
        said = pretended.stdout.read()
    assert (code, found["works"], pretended.returncode) == (0, True, 0)
    assert "text=Hi" in said
    assert "gesture     name=" in said


def test_a_pretended_robot_looks_again_and_again_whether_it_is_to_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl+C that comes just before a wait is heard at its end."""
    waits: list[float | None] = []

    class NoRequests(queue.SimpleQueue[object]):
        def get(self, block: bool = True, timeout: float | None = None) -> object:  # noqa: ARG002, FBT001, FBT002 - the base's signature
            waits.append(timeout)
            raise KeyboardInterrupt if len(waits) > 2 else queue.Empty

    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    with monkeypatch.context() as patch:
        patch.setattr(queue, "SimpleQueue", NoRequests)
        result = CliRunner().invoke(recollect, ["robot", "--pretend", "--port", str(port)])
    assert (result.exit_code, len(waits)) == (0, 3)
    assert all(wait is not None and wait <= 1 for wait in waits)


@pytest.mark.parametrize("other", ["--host=robot", "--kind=furhat", "--json"])
def test_a_pretended_robot_has_no_other_options(other: str) -> None:
    result = CliRunner().invoke(recollect, ["robot", "--pretend", other])
    assert str(result.exception) == "--pretend goes with --port alone"


def test_a_robot_that_is_well_does_every_step() -> None:
    with FurhatFake(character_ms=2) as fake:
        code, found = tried(
            "--host", "127.0.0.1", "--port", fake.port, "--language", "it", "--say", "Ciao & buongiorno"
        )
    assert (code, found["works"], found["kind"]) == (0, True, "furhat")
    assert steps(found)["a voice for it"] == "Bianca (it-IT)"
    assert steps(found)["people it sees"] == "1"
    assert "BigSmile" in steps(found)["its gestures"]
    assert fake.sentences == ["Ciao buongiorno"]
    assert fake.refusals == []
    said = next(step for step in found["steps"] if step["step"] == "says the sentence")
    assert said["ms"] >= 30


@pytest.mark.parametrize(
    ("fetches", "sentence", "words"),
    [
        (True, "Hello", "it played the clip of en-US"),
        (True, "Nothing", "with its own voice: no pack can say it"),
        (False, "Hello", "with its own voice: it did not fetch the clip, though it said that it played it"),
    ],
)
def test_a_clip_of_the_voice_pack_is_tried_as_well(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, fetches: bool, sentence: str, words: str
) -> None:
    clip = SpokenClip(b"RIFF", 10, {"engine": "pico", "voice": "en-US", "pack": "f00d"})
    monkeypatch.setattr(PackClips, "__call__", lambda _, __, text: clip if text == "Hello" else None)
    study = tmp_path / "study.toml"
    with FurhatFake() as fake:
        fake.fetches = fetches
        study.write_text(f'[robot]\nkind = "furhat"\nhost = "127.0.0.1"\nport = {fake.port}\npack = true\n')
        code, found = tried("--study", study, "--say", sentence)
    assert (code, steps(found)["says the sentence"]) == (0, words)
    assert fake.played == ([b"RIFF"] if words.startswith("it played") else [])


def test_it_is_told_for_people_as_well() -> None:
    with FurhatFake() as fake:
        result = CliRunner().invoke(recollect, ["robot", "--host", "127.0.0.1", "--port", str(fake.port)])
    assert result.exit_code == 0
    assert "OK   looks confused" in result.stdout


def test_a_robot_that_is_not_there_is_asked_nothing_further() -> None:
    with FurhatFake() as fake:
        pass
    code, found = tried("--host", "127.0.0.1", "--port", fake.port)
    assert (code, found["works"]) == (1, False)
    assert "cannot be reached" in steps(found)["is it there"]
    assert list(steps(found)) == ["is it there", "ready to speak"]


def test_a_robot_without_the_language_says_what_it_has() -> None:
    with FurhatFake() as fake:
        code, found = tried("--host", "127.0.0.1", "--port", fake.port, "--language", "fi")
    assert code == 1
    assert "has no voice of the language (fi: it has en-GB" in steps(found)["a voice for fi"]


def test_the_realtime_api_is_tried_as_well() -> None:
    with RealtimeFake() as fake:
        code, found = tried("--host", "127.0.0.1", "--port", fake.port, "--kind", "furhat-realtime", "--say", "Hello")
    assert (code, found["kind"]) == (0, "furhat-realtime")
    assert fake.sentences == ["Hello"]


def test_the_study_file_says_where_the_robot_is(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text("", "utf-8")
    result = CliRunner().invoke(recollect, ["robot", "--study", str(study)])
    assert "the study file names no robot" in str(result.exception)
    with FurhatFake() as fake:
        study.write_text(
            f'languages = ["es"]\n[robot]\nkind = "furhat"\nhost = "127.0.0.1"\nport = {fake.port}\n', "utf-8"
        )
        code, _ = tried("--study", study)
    assert (code, fake.voice) == (0, "Lucia")


@pytest.mark.parametrize(("mode", "changes"), [(Mode.WELL, 0), (Mode.RESET, 1)], ids=["well", "fails"])
def test_a_rehearsal_with_a_robot_tells_what_became_of_every_sentence(
    loaded_program: LoadedProgram, tmp_path: Path, mode: Mode, changes: int
) -> None:
    study = tmp_path / "study.toml"
    study.write_text('languages = ["en"]\nstages = ["introduction", "game", "result"]\n[game]\nrows = 2\ncolumns = 4\n')
    with FurhatFake(character_ms=0.2) as fake:
        fake.arm(mode, path="/furhat/say", after=2)
        robot = ["--robot-host", "127.0.0.1", "--robot-port", str(fake.port)]
        command = ["rehearse", "--headless", "--json", "--data", str(tmp_path), "--study", str(study), *robot]
        done = loaded_program.run(command, tmp_path, os.environ)
    assert (done.returncode, done.stderr) == (0, "")
    played = json.loads(done.stdout)
    assert (played["status"], played["embodiment"], played["embodiment_changes"]) == (
        "completed",
        "robot:furhat",
        changes,
    )
    counted = played["utterances"]
    assert counted["requested"] == counted["finished"] + counted["shown_only"]
    assert counted["failed"] == changes
    assert played["longest_gap_ms"] > 0


def test_a_rehearsal_with_a_robot_says_at_its_start_that_it_takes_minutes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def begin(*_: object, **__: object) -> None:
        raise UserInputError("it began")

    monkeypatch.setattr("kiosk.cli.rehearse.open_recorder", begin)
    command = ["rehearse", "--headless", "--data", str(tmp_path)]
    robot = ["--robot-host", "127.0.0.1"]
    said = {
        words: CliRunner().invoke(recollect, [*command, *words]).stderr
        for words in (tuple(robot), (*robot, "--sessions", "2"), ("--json", *robot), ())
    }
    assert ["takes minutes" in each for each in said.values()] == [True, True, False, False]


def test_a_rehearsal_with_a_robot_has_no_other_speed(tmp_path: Path) -> None:
    arguments = ["rehearse", "--headless", "--speed", "5", "--robot-host", "127.0.0.1", "--data", str(tmp_path)]
    result = CliRunner().invoke(recollect, arguments)
    assert "a robot speaks at its own speed" in str(result.exception)


@pytest.mark.parametrize(("there", "worked"), [(True, True), (False, False)])
def test_a_robot_says_hello_or_why_it_cannot(tmp_path: Path, *, there: bool, worked: bool) -> None:
    study = tmp_path / "study.toml"
    with FurhatFake(character_ms=2) as fake:
        study.write_text(f'[robot]\nkind = "furhat"\nhost = "127.0.0.1"\nport = {fake.port}\n')
        tried = greet(read_settings(study), "en", "Hello!") if there else None
    # Outside, nothing listens there any more.
    tried = tried or greet(read_settings(study), "en", "Hello!")
    assert tried is not None
    assert tried.worked is worked
    assert [said.rstrip("!") for said in fake.sentences] == (["Hello"] if there else [])


def test_where_no_robot_is_named_none_says_hello() -> None:
    assert greet(Settings(), "en", "Hello!") is None
