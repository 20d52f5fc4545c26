"""A policy file is read whole or refused in a sentence, and the table that comes of it never changes."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import FrozenInstanceError
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.assistance.policy import ACTIONS, STATES, ActionSpec, Gate, PolicyError, QTable, State
from kiosk.config import POLICIES
from tests.samples import mixed

Document = dict[str, Any]

NUMBERS = st.floats(-1e6, 1e6)
TABLES = st.lists(st.lists(NUMBERS, min_size=4, max_size=4), min_size=48, max_size=48)
LABELS = [state.label for state in STATES]


@pytest.fixture
def table() -> QTable:
    """Return a table with a number of its own in every place, and a gate unlike the default."""
    values = [[index + column / 10 for column in range(4)] for index in range(48)]
    return QTable.freeze("numbers", Gate(1, 2, 3), values, {"seed": 7, "players": ["memory", "chance"], "d": 0.25})


@pytest.fixture
def document(table: QTable) -> Document:
    """Return what stands in the file of that table."""
    content: Document = json.loads(table.to_json())
    return content


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Where a policy file would be."""
    return tmp_path / "policy.json"


def signed(document: Document) -> Document:
    """Return the document with the hash that fits its content."""
    content = {key: value for key, value in document.items() if key != "sha256"}
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return content | {"sha256": hashlib.sha256(canonical.encode()).hexdigest()}


def refusal(file: Path) -> str:
    """Return the sentence with which a file is refused; it names the file, and is one line."""
    with pytest.raises(PolicyError) as refused:
        QTable.load(file)
    sentence = str(refused.value)
    assert str(file) in sentence
    assert "\n" not in sentence
    assert isinstance(refused.value, UserInputError)
    return sentence


# What a table is


def test_a_table_comes_back_from_its_file_as_it_was(table: QTable, file: Path) -> None:
    file.write_text(table.to_json(), "utf-8")
    loaded = QTable.load(file)
    assert loaded == table
    assert (loaded.name, loaded.gate) == ("numbers", Gate(1, 2, 3))
    assert loaded.training == {"seed": 7, "players": ["memory", "chance"], "d": 0.25}


@given(TABLES)
def test_any_table_comes_back_as_it_was_frozen(tmp_path_factory: pytest.TempPathFactory, values: Any) -> None:
    file = tmp_path_factory.getbasetemp() / "any.json"
    frozen = QTable.freeze("any", Gate(), values, {})
    file.write_text(frozen.to_json(), "utf-8")
    assert QTable.load(file) == frozen
    assert QTable.load(file).to_json() == frozen.to_json()


def test_the_hash_in_the_file_is_the_hash_of_the_table(table: QTable, document: Document) -> None:
    assert document["sha256"] == table.sha256 == signed(document)["sha256"]


def test_a_person_can_read_the_file_one_line_per_state(table: QTable) -> None:
    lines = table.to_json().splitlines()
    rows = [line for line in lines if "/" in line]
    assert [line.split('"')[1] for line in rows] == LABELS
    assert [json.loads(line.split(":")[1].strip().rstrip(",")) for line in rows] == [list(row) for row in table.values]
    assert len({line.index("[") for line in rows}) == 1
    assert table.to_json().endswith("}\n")


def test_the_file_says_what_its_columns_are(document: Document) -> None:
    assert document["actions"] == ["no_help", "sug_col", "sug_row", "sug_card"]
    assert list(document) == ["format", "name", "gate", "training", "actions", "values", "sha256"]


def test_a_row_is_the_state_s_own(table: QTable) -> None:
    assert [table.row(state) for state in STATES] == list(table.values)
    assert table.row(State.at(13)) == (13.0, 13.1, 13.2, 13.3)


def test_the_greedy_action_has_the_highest_value() -> None:
    for action in ACTIONS:
        values = [[float(column == int(action)) for column in range(4)]] * 48
        table = QTable.freeze("t", Gate(), values, {})
        assert {table.action(state) for state in STATES} == {action}


@pytest.mark.parametrize(
    ("row", "action"),
    [
        ([0, 0, 0, 0], ActionSpec.NO_HELP),
        ([1, 2, 2, 0], ActionSpec.SUG_COL),
        ([-3, -2, -1, -1], ActionSpec.SUG_ROW),
        ([-1, -2, -3, -4], ActionSpec.NO_HELP),
    ],
)
def test_a_tie_goes_to_the_action_that_helps_less(row: list[float], action: ActionSpec) -> None:
    assert QTable.freeze("t", Gate(), [row] * 48, {}).action(STATES[5]) is action


def test_values_are_frozen_to_six_decimals_and_a_zero_has_no_sign() -> None:
    table = QTable.freeze("t", Gate(), [[0.12345649, -0.0, -0.0000001, 1]] * 48, {})
    assert [repr(value) for value in table.values[0]] == ["0.123456", "0.0", "0.0", "1.0"]


def test_a_frozen_table_cannot_be_changed(table: QTable) -> None:
    with pytest.raises(FrozenInstanceError):
        table.values = ()  # type: ignore[misc]
    with pytest.raises(TypeError):
        table.values[0][0] = 9.0  # type: ignore[index]
    with pytest.raises(FrozenInstanceError):
        table.gate.opening = 0  # type: ignore[misc]


def test_asking_a_table_changes_nothing() -> None:
    table = mixed()
    before = table.to_json()
    for state in STATES:
        table.action(state)
    assert table.to_json() == before


def test_every_policy_that_is_shipped_can_be_used() -> None:
    for shipped in sorted(POLICIES.glob("*.json")):
        policy = QTable.load(shipped)
        assert policy.training, f"{shipped.name} does not say how it was made"
        assert policy.to_json() == shipped.read_text("utf-8")


# What a file is refused for


def test_a_file_that_is_not_there_is_refused(file: Path) -> None:
    assert "cannot be read: " in refusal(file)


def test_a_folder_is_refused(tmp_path: Path) -> None:
    assert "cannot be read: " in refusal(tmp_path)


@pytest.mark.parametrize("content", [b"", b"hello", b"{", b"\xff\xfe\x00", b'{"a": 1,}'])
def test_a_file_that_is_not_json_is_refused(file: Path, content: bytes) -> None:
    file.write_bytes(content)
    assert "is not JSON" in refusal(file)


def test_a_file_that_is_nested_too_deeply_is_refused(file: Path) -> None:
    file.write_text("[" * 100_000)
    assert "is not JSON" in refusal(file)


@pytest.mark.parametrize("kept", [0.1, 0.5, 0.9, 0.99])
def test_a_file_that_was_cut_off_is_refused(table: QTable, file: Path, kept: float) -> None:
    text = table.to_json()
    file.write_text(text[: int(len(text) * kept)], "utf-8")
    assert "is not JSON" in refusal(file)


@pytest.mark.parametrize("content", ["[]", "null", "5", '"policy"', "{}", '{"format": 1}'])
def test_json_of_another_kind_is_refused(file: Path, content: str) -> None:
    file.write_text(content)
    assert 'it is not of the format "recollect-policy-1"' in refusal(file)


@pytest.mark.parametrize("other", ["recollect-policy-2", "", None, ["recollect-policy-1"]])
def test_another_format_is_refused_even_if_it_fits_its_hash(document: Document, file: Path, other: Any) -> None:
    file.write_text(json.dumps(signed(document | {"format": other})))
    assert 'it is not of the format "recollect-policy-1"' in refusal(file)


@pytest.mark.parametrize("key", ["name", "gate", "training", "actions", "values", "sha256"])
def test_a_missing_key_is_named(document: Document, file: Path, key: str) -> None:
    del document[key]
    file.write_text(json.dumps(document))
    assert refusal(file).endswith(f"it lacks {key}")


def test_all_missing_keys_are_named(document: Document, file: Path) -> None:
    file.write_text(json.dumps({"format": document["format"], "values": {}, "actions": [], "sha256": ""}))
    assert refusal(file).endswith("it lacks gate and name and training")


@pytest.mark.parametrize(
    ("actions", "sentence"),
    [
        (["no_help", "sug_col", "sug_row"], "it names a state that does not exist: 'beginning/sug_card/f_correct'"),
        (["no_help", "sug_col", "sug_row", "sug_pair"], "there is no action 'sug_pair'; there are no_help, sug_col"),
        (["sug_col", "no_help", "sug_row", "sug_card"], "but the first must be 'no_help', and none may stand twice"),
        (["no_help", "sug_col", "sug_row", "sug_row"], "but the first must be 'no_help', and none may stand twice"),
        ([], "but the first must be 'no_help', and none may stand twice"),
        ("no_help", "its actions must be a list of names, not 'no_help'"),
        (None, "its actions must be a list of names, not None"),
    ],
)
def test_unknown_actions_are_refused(document: Document, file: Path, actions: Any, sentence: str) -> None:
    file.write_text(json.dumps(signed(document | {"actions": actions})))
    assert sentence in refusal(file)


def test_the_order_of_the_columns_is_the_file_s(document: Document, file: Path) -> None:
    document["actions"] = ["no_help", "sug_card", "sug_col", "sug_row"]
    document["values"]["beginning/no_help/f_correct"] = [0.0, 1.0, 0.5, 0.25]
    file.write_text(json.dumps(signed(document)))
    table = QTable.load(file)
    assert table.action(STATES[0]) is ActionSpec.SUG_CARD
    assert QTable.from_json(table.to_json()) == table


def test_an_unknown_state_is_refused_by_name(document: Document, file: Path) -> None:
    document["values"]["beginning/no_help/f_maybe"] = document["values"].pop(LABELS[0])
    file.write_text(json.dumps(signed(document)))
    assert "it names a state that does not exist: 'beginning/no_help/f_maybe'" in refusal(file)


def test_one_state_too_many_is_refused_by_name(document: Document, file: Path) -> None:
    document["values"]["overtime/no_help/f_wrong"] = [0.0] * 4
    file.write_text(json.dumps(signed(document)))
    assert "it names a state that does not exist: 'overtime/no_help/f_wrong'" in refusal(file)


@pytest.mark.parametrize("label", [LABELS[0], LABELS[20], LABELS[47]])
def test_a_missing_state_is_refused_by_name(document: Document, file: Path, label: str) -> None:
    del document["values"][label]
    file.write_text(json.dumps(signed(document)))
    assert f"its table has 47 states, not 48: {label!r} is missing" in refusal(file)


@pytest.mark.parametrize("values", [[], [[0.0] * 4] * 48, "none", None, 0])
def test_values_that_are_not_given_by_state_are_refused(document: Document, file: Path, values: Any) -> None:
    file.write_text(json.dumps(signed(document | {"values": values})))
    assert "its values are not given by state" in refusal(file)


@pytest.mark.parametrize("row", [[1, 2, 3], [1, 2, 3, 4, 5], [], 7, None, "1234", {"no_help": 1}])
def test_a_state_without_four_values_is_refused_by_name(document: Document, file: Path, row: Any) -> None:
    document["values"][LABELS[20]] = row
    file.write_text(json.dumps(signed(document)))
    assert f"state {LABELS[20]!r} must have 4 values, one per action, not {row!r}" in refusal(file)


@pytest.mark.parametrize(
    "number", ["NaN", "Infinity", "-Infinity", "1e999", '"0.5"', "null", "true", "[0.5]", "1" + "0" * 400]
)
def test_a_value_that_is_not_a_finite_number_is_refused_by_place(document: Document, file: Path, number: str) -> None:
    document["values"][LABELS[33]][2] = "HERE"
    file.write_text(json.dumps(document).replace('"HERE"', number))
    sentence = refusal(file)
    assert f"the value of sug_row in state {LABELS[33]!r} is " in sentence
    assert "not a finite number" in sentence


@pytest.mark.parametrize("name", [5, None, True, ["default"], {}])
def test_a_name_that_is_not_text_is_refused(document: Document, file: Path, name: Any) -> None:
    file.write_text(json.dumps(signed(document | {"name": name})))
    assert f"its name must be text, not {name!r}" in refusal(file)


@pytest.mark.parametrize("training", [[], [["seed", 7]], None, "recollect train", 7])
def test_training_that_is_not_an_object_is_refused(document: Document, file: Path, training: Any) -> None:
    file.write_text(json.dumps(signed(document | {"training": training})))
    assert f"its training must say by name how it was made, not {training!r}" in refusal(file)


@pytest.mark.parametrize(
    "gate",
    [
        {},
        {"opening": 6, "patience": 4},
        {"opening": 6, "patience": 4, "first_patience": 10, "last_patience": 1},
        [6, 4, 10],
        None,
    ],
)
def test_a_gate_of_other_numbers_is_refused(document: Document, file: Path, gate: Any) -> None:
    file.write_text(json.dumps(signed(document | {"gate": gate})))
    assert "its gate must have the numbers opening, patience, first_patience" in refusal(file)


@pytest.mark.parametrize("number", [4.0, "4", True, None, [4]])
def test_a_gate_s_number_that_is_not_whole_is_refused(document: Document, file: Path, number: Any) -> None:
    document["gate"]["patience"] = number
    file.write_text(json.dumps(signed(document)))
    assert f"its gate's patience must be a whole number of flips, not {number!r}" in refusal(file)


def test_a_gate_s_number_below_zero_is_refused(document: Document, file: Path) -> None:
    document["gate"]["opening"] = -1
    file.write_text(json.dumps(signed(document)))
    assert "gate: opening must be 0 or more flips, not -1" in refusal(file)


def _edit_a_value(document: Document) -> None:
    document["values"][LABELS[47]][3] += 0.000001


def _swap_two_values(document: Document) -> None:
    document["values"][LABELS[3]].reverse()


def _edit_the_training(document: Document) -> None:
    document["training"]["seed"] = 8


def _add_to_the_training(document: Document) -> None:
    document["training"]["remark"] = ""


def _edit_the_gate(document: Document) -> None:
    document["gate"]["opening"] = 2


def _rename(document: Document) -> None:
    document["name"] = "other"


def _edit_the_hash(document: Document) -> None:
    document["sha256"] = document["sha256"][::-1]


def _shout_the_hash(document: Document) -> None:
    document["sha256"] = document["sha256"].upper()


def _lose_the_hash(document: Document) -> None:
    document["sha256"] = None


@pytest.mark.parametrize(
    "change",
    [
        _edit_a_value,
        _swap_two_values,
        _edit_the_training,
        _add_to_the_training,
        _edit_the_gate,
        _rename,
        _edit_the_hash,
        _shout_the_hash,
        _lose_the_hash,
    ],
)
def test_a_file_that_was_changed_by_hand_is_refused(
    document: Document, file: Path, change: Callable[[Document], None]
) -> None:
    change(document)
    file.write_text(json.dumps(document))
    assert "its sha256 does not fit its content, so it was changed after it was made" in refusal(file)


@pytest.mark.parametrize("place", [(index, column) for index in range(0, 48, 5) for column in range(4)])
def test_no_number_of_the_table_can_be_changed_unseen(document: Document, file: Path, place: tuple[int, int]) -> None:
    index, column = place
    document["values"][LABELS[index]][column] += 1
    file.write_text(json.dumps(document))
    assert "its sha256 does not fit its content" in refusal(file)


@pytest.mark.parametrize("honest", [True, False])
def test_an_unknown_key_is_refused(document: Document, file: Path, *, honest: bool) -> None:
    document["remark"] = "what else I wanted to say"
    file.write_text(json.dumps(signed(document) if honest else document))
    assert refusal(file).endswith("it has a key that no policy has: 'remark'")


@pytest.mark.parametrize("said", ['"name": "honest", ', '"gate": {}, '])
def test_a_key_that_stands_twice_is_refused(table: QTable, file: Path, said: str) -> None:
    """JSON takes the last of two; a person who reads the file takes the first."""
    file.write_text(table.to_json().replace("{", "{" + said, 1), "utf-8")
    assert "twice" in refusal(file)


def test_a_state_that_stands_twice_is_refused(table: QTable, file: Path) -> None:
    line = f'"{LABELS[0]}": [9, 9, 9, 9],'
    file.write_text(table.to_json().replace('"values": {', '"values": {' + line), "utf-8")
    assert f"it says {LABELS[0]!r} twice" in refusal(file)


def test_the_hash_of_a_loaded_table_is_the_one_in_its_file(document: Document, file: Path) -> None:
    """The records name a table by its hash: with values written as whole numbers it must be the file's all the same."""
    for label in LABELS:
        document["values"][label] = [1, 0, 0, 0]
    floats = document | {"values": {label: [1.0, 0.0, 0.0, 0.0] for label in LABELS}}
    file.write_text(json.dumps(document | {"sha256": signed(floats)["sha256"]}))
    assert QTable.load(file).sha256 == json.loads(file.read_text())["sha256"]
