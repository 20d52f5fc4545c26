"""The commands of the learning layer: one object with --json, one sentence and code 2 for bad input."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.assistance.policy import QTable
from kiosk.cli import learning
from kiosk.cli.main import recollect
from kiosk.config import POLICIES
from kiosk.training import policies
from tests.patience import PATIENCE_S


def run(*words: str) -> Result:
    """Call ``recollect`` with these words; UserInputError passes through, as it does to ``main``."""
    return CliRunner().invoke(recollect, list(words), catch_exceptions=False)


def told(*words: str) -> dict[str, Any]:
    """Return the one object that a command prints with --json, and nothing else."""
    result = run(*words, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    document: dict[str, Any] = json.loads(result.stdout)
    return document


def test_train_writes_a_table_that_can_be_loaded(tmp_path: Path) -> None:
    out = tmp_path / "mine.json"
    document = told("train", "--episodes", "30", "--seed", "4", "--out", str(out))
    table = QTable.load(out)
    assert (table.name, table.sha256) == (document["policy"], document["sha256"]) == ("mine", table.sha256)
    assert document["episodes"] == 30


@pytest.mark.parametrize(
    "words",
    [
        "--reward released --player memory --forgetting .3 --follow .9 --episodes 20 --seed 3",
        "--reward paper --player text --counting since_match --episodes 20 --alpha visits --averaging last_half",
        "--player chance --threshold .1 --episodes 20 --gate off --gamma .9 --target random --epsilon paper",
        "--player memory --forgetting .2:.3 --episodes 20 --decisions every_flip",
    ],
)
def test_the_command_in_a_file_makes_the_same_file_again(tmp_path: Path, words: str) -> None:
    first, second = tmp_path / "first.json", tmp_path / "second.json"
    told("train", *words.split(), "--out", str(first))
    command = str(QTable.load(first).training["command"]).split()
    assert command[0] == "recollect"
    told(*command[1:], "--out", str(second))
    assert second.read_bytes() == first.read_bytes()


def test_simulate_prints_every_measure() -> None:
    document = told("simulate", "--player", "memory", "--forgetting", ".2", "--games", "40", "--condition", "notom")
    for name in ("moves", "flips"):
        assert set(document[name]) == {"mean", "sd", "ci95"}
    for name in ("assistance_per_flip", "first_card_hints_per_game"):
        assert document[name] == document["spreads"][name]["mean"]
    assert set(document["hint_rate"]) == {"first", "second"}
    assert document["followed"] == document["followed_first_card"] == 1.0
    assert document["games"] == 40
    assert document["target"] == "random"
    assert document["policy_sha256"] == QTable.named("default").sha256
    assert "led_to_match" in document


def test_simulate_tells_the_same_in_words() -> None:
    words = run("simulate", "--player", "chance", "--policy", "none", "--games", "20").stdout
    assert "moves" in words
    assert "95 % interval" in words
    assert "no hints" in words


@pytest.mark.parametrize("policy", ["default", "study-like", "no-help", "none"])
def test_policies_are_taken_by_their_names(policy: str) -> None:
    assert told("simulate", "--policy", policy, "--games", "10")["policy"] == policy


def test_policy_show_prints_what_the_table_does_in_every_state() -> None:
    text = run("policy", "show", "default").stdout
    assert QTable.named("default").sha256 in text
    assert len(text.splitlines()) == 4 + 48
    document = told("policy", "show", "default")
    assert document["states"]["beginning/no_help/f_wrong"]["action"] == "sug_card"


@pytest.mark.parametrize("ending", ["png", "svg"])
def test_policy_show_draws_the_table(tmp_path: Path, ending: str) -> None:
    pytest.importorskip("matplotlib")
    figure = tmp_path / f"table.{ending}"
    assert run("policy", "show", "default", "--figure", str(figure)).exit_code == 0
    assert figure.stat().st_size > 5000


def test_policy_compare_names_the_states_that_differ() -> None:
    document = told("policy", "compare", "default", "no-help")
    assert len(document["different"]) == len(policies.helped(QTable.named("default")))
    assert "the same action in" in run("policy", "compare", "default", "default").stdout


def test_policy_card_measures_every_line_of_a_card() -> None:
    document = told("policy", "card", "default", "--games", "20")
    assert "memory 0.2, ToM" in document
    text = run("policy", "card", "default", "--games", "20").stdout
    assert text.count("\n|") == len(document) + 2


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("simulate --player memory --threshold .3", "the memory player has no --threshold"),
        ("simulate --player text --forgetting .1:.2", "the text player's --forgetting is one number, not a range"),
        ("simulate --player text --forgetting .3 --counting total", "never finishes a game"),
        ("simulate --player chance --threshold 2", "threshold must be a number from 0 to 1, not 2"),
        ("simulate --follow -1", "follow must be a number from 0 to 1, not -1"),
        ("simulate --games 0", "there must be at least 2 games, not 0"),
        ("simulate --policy nothing.json", "the policy file nothing.json cannot be read: No such file"),
        ("train --episodes -5 --out x.json", "the number of episodes must be 0 to 1,000,000,000, not -5"),
        ("train --episodes 5 --out no/where/x.json", "no/where/x.json cannot be written: there is no folder"),
        ("policy show default --figure x.pdf", "the figure x.pdf must end in .png or .svg"),
    ],
)
def test_bad_input_is_refused_in_one_sentence(
    words: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UserInputError) as refusal:
        run(*words.split())
    assert sentence in str(refusal.value)
    assert "\n" not in str(refusal.value)
    assert not list(tmp_path.iterdir())


def damaged(text: str) -> dict[str, str]:
    """Return a policy file, spoilt in several ways."""
    return {
        "truncated": text[: len(text) // 2],
        "edited": text.replace("0.8", "0.9", 1),
        "foreign": json.dumps({"hello": "world"}),
        "empty": "",
    }


@pytest.mark.parametrize("how", ["truncated", "edited", "foreign", "empty"])
def test_a_spoilt_policy_file_is_one_sentence_and_exit_code_2(tmp_path: Path, how: str) -> None:
    file = tmp_path / "spoilt.json"
    file.write_text(damaged((POLICIES / "default.json").read_text("utf-8"))[how], "utf-8")
    done = outside("policy", "show", str(file))
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("recollect: the policy file")
    assert len(done.stderr.splitlines()) == 1


def outside(*words: str, limit: int | None = None) -> subprocess.CompletedProcess[str]:
    """Call ``recollect`` in a process of its own, which may write ``limit`` bytes to a file at most."""
    command = [sys.executable, "-m", "kiosk", *words]
    if limit is not None:
        resource = pytest.importorskip("resource", reason="files can be limited on Unix only")
        command = [sys.executable, "-c", LIMITED.format(limit=limit, limits=resource.RLIMIT_FSIZE), *words]
    plain = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    return subprocess.run(command, capture_output=True, text=True, check=False, env=plain, timeout=PATIENCE_S)


LIMITED = """
import resource
resource.setrlimit({limits}, ({limit}, {limit}))
from kiosk.cli.main import main
main()
"""


def test_when_there_is_no_room_the_old_table_stays(tmp_path: Path) -> None:
    out = tmp_path / "table.json"
    told("train", "--episodes", "5", "--out", str(out))
    before = out.read_bytes()
    done = outside("train", "--episodes", "6", "--out", str(out), limit=1000)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"recollect: {out} cannot be written: File too large\n"
    assert out.read_bytes() == before
    assert list(tmp_path.iterdir()) == [out]


@pytest.mark.parametrize(("is_slow", "lines"), [(True, 2), (False, 0)])
def test_train_says_how_to_make_slow_games_faster(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, is_slow: bool, lines: int
) -> None:
    monkeypatch.setattr(learning, "is_slow", lambda: is_slow)
    said = run("train", "--episodes", "5", "--out", str(tmp_path / "table.json")).stderr.splitlines()
    assert len(said) == lines
    assert all("gcc" in line or "C compiler" in line for line in said)


def test_ctrl_c_leaves_a_usable_checkpoint_and_the_old_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "table.json"
    out.write_text("the old table", "utf-8")

    def interrupted(*_: object, hidden: bool) -> Any:  # noqa: ARG001 - as progress_bar
        class Bar:
            def __enter__(self) -> Any:
                return lambda _: signal.raise_signal(signal.SIGINT)

            def __exit__(self, *_: object) -> None:
                return None

        return Bar()

    monkeypatch.setattr("kiosk.cli.learning.progress_bar", interrupted)
    result = run("train", "--episodes", "4000", "--out", str(out))
    beside = tmp_path / "table.checkpoint.json"
    assert result.exit_code == 130
    assert f"a usable policy in {beside}" in result.stderr
    assert QTable.load(beside).training["stopped_after"] == 500
    assert out.read_text("utf-8") == "the old table"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="a pipe in the file system is a Unix thing")
def test_what_is_no_file_is_never_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(UserInputError, match="it is not a file"):
        run("train", "--episodes", "5", "--out", str(pipe))
    assert pipe.is_fifo()


def test_a_link_stays_a_link_and_its_file_is_replaced(tmp_path: Path) -> None:
    real, link = tmp_path / "real.json", tmp_path / "link.json"
    real.write_text("the old table", "utf-8")
    link.symlink_to(real)
    told("train", "--episodes", "5", "--out", str(link))
    assert link.is_symlink()
    assert QTable.load(real).training["episodes"] == 5


@pytest.mark.parametrize("condition", ["tom", "notom", "mentalised_unexplained", "random_explained", "no_assistance"])
def test_every_condition_can_be_simulated(condition: str) -> None:
    document = told("simulate", "--player", "memory", "--games", "20", "--condition", condition)
    assert (document["assistance_per_flip"] == 0) == (condition == "no_assistance")
