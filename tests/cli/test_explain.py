"""``recollect explain``: any decision can be laid open, and a case that cannot be is refused in one sentence."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate
from kiosk.cli.main import main
from kiosk.game import Board, Concentration
from tests.patience import PATIENCE_S
from tests.samples import ANIMALS, CATALOGUES, always

Case = dict[str, Any]
Explain = Callable[..., dict[str, Any]]

BOARD = [*ANIMALS, *ANIMALS]
"""Every card's mate lies two rows below it, twelve locations on."""
BEAR, BUTTERFLY, CAT, DUCK = range(4)


@pytest.fixture
def policy(tmp_path: Path) -> Path:
    """Return a policy that always points to a row, behind the gate."""
    file = tmp_path / "rows.json"
    file.write_text(always(ActionSpec.SUG_ROW, Gate()).to_json(), "utf-8")
    return file


@pytest.fixture
def case(policy: Path) -> Case:
    """Return a case in which the bear was seen three times, alone, and a first card may be helped."""
    flips = [BEAR, BUTTERFLY, BEAR, CAT, BEAR, DUCK, 4, 5, 6, 7]
    return {"board": BOARD, "flips": flips, "last_action": "no_help", "condition": "tom", "policy": str(policy),
            "language": "en"}  # fmt: skip


def run(*arguments: object) -> int:
    """Call the command line in this process; returns its exit code."""
    sys.argv = ["recollect", "explain", *map(str, arguments)]
    with pytest.raises(SystemExit) as ended:
        main()
    return ended.value.code if isinstance(ended.value.code, int) else 0


@pytest.fixture
def explain(tmp_path: Path, case: Case, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Explain:
    """Return the explanation of the case with some keys changed."""
    monkeypatch.setattr(sys, "argv", [])

    def explanation(**changes: Any) -> dict[str, Any]:
        file = tmp_path / "case.json"
        file.write_text(json.dumps(case | changes), "utf-8")
        assert run(file, "--json") == 0
        printed: dict[str, Any] = json.loads(capsys.readouterr().out)
        return printed

    return explanation


# What is printed


def test_every_step_is_there(explain: Explain) -> None:
    told = explain()
    sentences = told.pop("sentences")
    assert told == {
        "state": {"game": "beginning", "last": "no_help", "outcome": "f_wrong", "index": 1},
        "gate": {"open": True, "reason": "open"},
        "q": {"no_help": 0.0, "sug_col": 0.0, "sug_row": 1.0, "sug_card": 0.0},
        "action": "sug_row",
        "target": {"location": 12, "row": 3, "column": 1, "card": "bear"},
        "targets": [12],
        "counts": {"target": 0, "other": 3},
        "reason": "often-and-never",
    }
    assert len(set(sentences)) == 9
    assert all("bear" in sentence and "row 3" in sentence and "column" not in sentence for sentence in sentences)


def test_the_keys_come_in_the_order_of_the_steps(explain: Explain) -> None:
    assert list(explain()) == ["state", "gate", "q", "action", "target", "counts", "reason", "targets", "sentences"]


def test_behind_a_closed_gate_there_is_no_hint_but_the_rule_s_choice_is_told(explain: Explain) -> None:
    told = explain(flips=[BEAR, BUTTERFLY])
    assert told["gate"] == {"open": False, "reason": "the first flips of a game are the player's own"}
    assert told["action"] == "no_help"
    assert (told["target"], told["counts"], told["reason"], told["sentences"]) == (None, None, None, [])
    assert told["targets"] == [12, 13]


def test_an_action_of_one_s_own_takes_the_place_of_gate_and_table(explain: Explain) -> None:
    told = explain(flips=[], action="sug_card")
    assert told["gate"]["open"] is False
    assert (told["action"], told["overridden"], told["reason"]) == ("sug_card", True, "nothing-known")
    assert told["targets"] == list(range(24))


def test_nothing_is_overridden_unless_an_action_is_given(explain: Explain) -> None:
    assert "overridden" not in explain()
    assert explain(action="no_help")["overridden"] is True
    assert explain(action=None)["action"] == "sug_row"


def test_after_an_open_first_card_the_hint_is_about_its_mate(explain: Explain) -> None:
    told = explain(flips=[BEAR, BUTTERFLY, BEAR, CAT, DUCK, 4, BEAR], last_action="sug_col")
    assert told["state"] == {"game": "beginning", "last": "sug_col", "outcome": "s_wrong", "index": 7}
    assert (told["target"]["location"], told["targets"]) == (12, [12])
    assert (told["counts"], told["reason"]) == ({"target": 0, "other": 3}, "often-and-never")


def test_pairs_that_are_found_move_the_phase_on(explain: Explain) -> None:
    found = [location for pair in range(4) for location in (pair, pair + 12)]
    assert explain(flips=found)["state"] == {"game": "middle", "last": "no_help", "outcome": "f_correct", "index": 16}


def test_among_several_targets_the_seed_chooses(explain: Explain) -> None:
    chosen = {explain(flips=[0, 1, 2, 3, 4, 5, 6, 7, 8, 9], seed=seed)["target"]["location"] for seed in range(20)}
    assert len(chosen) > 3
    assert chosen <= set(range(12, 22))
    assert explain(seed=0) == explain()


def test_the_condition_decides_on_the_targets_and_the_reason(explain: Explain) -> None:
    assert explain(condition="mentalised_unexplained")["targets"] == [12]
    assert explain(condition="notom")["targets"] == list(range(24))
    assert len(explain(condition="notom")["sentences"]) == 3
    assert len(explain(condition="random_explained")["sentences"]) == 9


def test_the_target_rule_may_be_the_other_one(explain: Explain) -> None:
    assert explain(target_rule="most_recent")["targets"] == [19]


def test_where_nobody_helps_there_is_nothing_to_point_at(explain: Explain) -> None:
    told = explain(condition="no_assistance")
    assert (told["action"], told["target"], told["targets"], told["sentences"]) == ("no_help", None, [], [])


@pytest.mark.parametrize(("language", "said"), [("en", "bear"), ("it", "orso"), ("es", "oso")])
def test_the_sentences_are_in_the_language(explain: Explain, language: str, said: str) -> None:
    assert any(said in sentence for sentence in explain(language=language)["sentences"])


def test_cards_of_no_deck_can_be_explained_too(explain: Explain) -> None:
    letters = list("abcdefghijkl")
    assert explain(board=letters + letters)["target"]["card"] == "a"


@pytest.mark.parametrize("language", CATALOGUES)
def test_a_person_reads_each_step_on_its_line(
    tmp_path: Path, case: Case, capsys: pytest.CaptureFixture[str], language: str
) -> None:
    file = tmp_path / "case.json"
    file.write_text(json.dumps(case | {"language": language}), "utf-8")
    assert run(file) == 0
    printed = capsys.readouterr().out
    for line in (
        r"state      beginning/no_help/f_wrong, row 1 of the table",
        r"gate       open: the table is asked",
        r"q          no_help 0   sug_col 0   sug_row 1   sug_card 0",
        r"action     sug_row",
        r"targets    location 12",
        r"target     row 3, column 1 (location 12): bear",
        r"counts     turned up: the target 0 times, the other 3 times",
        r"reason     often-and-never",
    ):
        assert f"{line}\n" in printed
    assert len([line for line in printed.splitlines() if line.endswith(" 3.")]) == 9


def test_nothing_the_case_does_not_say_is_made_up(explain: Explain) -> None:
    """The same flips, counted here by hand on a game, give the counts in the explanation."""
    flips = [BEAR, BUTTERFLY, BEAR + 12, CAT, BEAR, DUCK, 20]
    game = Concentration(Board(4, 6, tuple(BOARD)))
    for location in flips:
        game.flip(game.board.position(location))
        game.turn_back()
    told = explain(flips=flips)
    assert FlipInMove.coming(game) is FlipInMove.SECOND
    assert told["target"]["location"] == 8
    assert told["counts"] == {"target": flips.count(8), "other": flips.count(20)}


# What is refused


@pytest.fixture
def refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], str]:
    """Return the sentence with which a case file of this content is refused."""
    monkeypatch.setattr(sys, "argv", [])

    def sentence(content: str) -> str:
        file = tmp_path / "case.json"
        file.write_text(content, "utf-8")
        assert run(file, "--json") == 2
        printed = capsys.readouterr()
        assert printed.out == ""
        assert printed.err.count("\n") == 1
        assert printed.err.startswith(f"recollect: the case {file}")
        return printed.err.removeprefix(f"recollect: the case {file}").removeprefix(": ").strip()

    return sentence


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"board": BOARD[:23]}, "a board of 4 x 6 needs 24 cards, not 23"),
        ({"board": [*BOARD, "owl"]}, "a board of 4 x 6 needs 24 cards, not 25"),
        ({"board": [*BOARD[:23], "bear"]}, "every card must lie on the board twice, but 'bear' lies there 3 time(s)"),
        ({"board": "owl"}, "board should be a valid list, but it is 'owl'"),
        ({"board": [*BOARD[:23], 7]}, "board, number 24 should be a valid string, but it is 7"),
        ({"flips": [24]}, "flips, number 1 should be less than 24, but it is 24"),
        ({"flips": [0, 1, -1]}, "flips, number 3 should be greater than or equal to 0, but it is -1"),
        ({"flips": [0, "3"]}, "flips, number 2 should be a valid integer, but it is '3'"),
        ({"flips": [0, 3.0]}, "flips, number 2 should be a valid integer, but it is 3.0"),
        ({"flips": [True]}, "flips, number 1 should be a valid integer, but it is True"),
        ({"flips": None}, "flips should be a valid list, but it is None"),
        ({"flips": [0, 12, 0]}, "flip 3 (location 0): the card at row 1, column 1 may not be flipped: already found"),
        ({"flips": [5, 5]}, "flip 2 (location 5): the card at row 1, column 6 may not be flipped: already open"),
        (
            {"flips": [place for pair in range(12) for place in (pair, pair + 12)]},
            "the game is finished after 24 flips, so there is no next flip to help with",
        ),
        (
            {"condition": "ToM"},
            "there is no condition 'ToM'; there are tom, notom, mentalised_unexplained, random_explained, "
            "no_assistance",
        ),
        ({"condition": 1}, "condition should be a valid string, but it is 1"),
        ({"language": "xx"}, "there is no language 'xx'; there are en, es, it"),
        ({"language": ""}, "there is no language ''; there are en, es, it"),
        (
            {"last_action": "row"},
            "there is no action 'row'; there are no_help, sug_col, sug_row, sug_card, encouragement, praise",
        ),
        (
            {"action": "SUG_ROW"},
            "there is no action 'SUG_ROW'; there are no_help, sug_col, sug_row, sug_card, encouragement, praise",
        ),
        ({"policy": "nowhere"}, "the policy file nowhere cannot be read: No such file or directory"),
        ({"target_rule": "best"}, "target_rule should be 'most_flipped' or 'most_recent', but it is 'best'"),
        ({"seed": "x"}, "seed should be a valid integer, but it is 'x'"),
        ({"colour": "red"}, "there is no key 'colour'"),
        (
            {"condition": "no_assistance", "action": "sug_row"},
            "in the condition no_assistance there is no help, so there is no action to explain",
        ),
    ],
)
def test_a_case_that_cannot_be_is_refused(
    refused: Callable[[str], str], case: Case, changes: Case, sentence: str
) -> None:
    assert refused(json.dumps(case | changes)) == sentence


@pytest.mark.parametrize("key", ["board", "flips", "last_action", "condition", "policy", "language"])
def test_a_missing_key_is_named(refused: Callable[[str], str], case: Case, key: str) -> None:
    del case[key]
    assert refused(json.dumps(case)) == f"the key {key!r} is missing"


@pytest.mark.parametrize("content", ["", "{", "[" * 100_000, '{"seed": ' + "9" * 5000 + "}"])
def test_what_is_not_json_is_refused(refused: Callable[[str], str], content: str) -> None:
    assert refused(content).startswith("is not JSON: ")


def test_a_list_is_no_case(refused: Callable[[str], str]) -> None:
    assert refused("[]").startswith("it should be a valid dictionary")


def test_a_key_said_twice_is_refused(refused: Callable[[str], str]) -> None:
    assert refused('{"flips": [], "flips": [1]}') == "is not JSON: it says 'flips' twice"


def test_a_file_that_is_not_there_is_refused(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", [])
    assert run("nowhere.json") == 2
    assert capsys.readouterr().err == "recollect: the case nowhere.json cannot be read: No such file or directory\n"


@pytest.mark.parametrize("arguments", [(), ("7", "--flip", "0"), ("7", "--flip", "x")])
def test_half_a_command_is_refused(
    arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", [])
    assert run(*arguments) == 2
    assert "Error: " in capsys.readouterr().err


def test_it_is_a_command_of_recollect(tmp_path: Path, case: Case) -> None:
    file = tmp_path / "case.json"
    file.write_text(json.dumps(case), "utf-8")
    command = [sys.executable, "-m", "kiosk", "explain", str(file), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, encoding="utf-8", timeout=PATIENCE_S)
    assert json.loads(done.stdout)["action"] == "sug_row"
    assert done.stderr == ""
