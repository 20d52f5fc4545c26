"""Every sentence of an exported data set is true of its own tables, and a false one is found."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.export.truth import TOLD, Checker, Row, played


def any_hint(_: Row) -> bool:
    """Take the first hint."""
    return True


def other(picture: str) -> str:
    """Return another picture."""
    return "owl" if picture == "cat" else "cat"


WRONG: dict[str, tuple[Callable[[Row], bool], Callable[[Row], Row]]] = {
    "another row": (
        lambda h: "row 1" in h["sentence"],
        lambda h: {"sentence": h["sentence"].replace("row 1", "row 2")},
    ),
    "another column": (
        lambda h: "column 1" in h["sentence"],
        lambda h: {"sentence": h["sentence"].replace("column 1", "column 5")},
    ),
    "another picture": (
        lambda h: h["picture"] in h["sentence"],
        lambda h: {"sentence": h["sentence"].replace(h["picture"], other(h["picture"]))},
    ),
    "often instead of once": (
        lambda h: h["sentence"].startswith("You have seen the other") and "more" not in h["sentence"],
        lambda h: {"sentence": f"You have seen the other {h['picture']} card more than once."},
    ),
    "seen instead of unseen": (
        lambda h: h["move_card"] == "first" and h["seen"] == "0" and h["told_row"] + h["told_column"] == "",
        lambda h: {"sentence": f"You have seen both {h['picture']} cards."},
    ),
    "a place more": (lambda h: h["action"] == "sug_row" and h["told_row"] != "", lambda _: {"told_column": "1"}),
    "other counts": (any_hint, lambda h: {"seen": str(int(h["seen"]) + 1)}),
    "another picture in the table": (any_hint, lambda h: {"picture": other(h["picture"])}),
    "followed or not": (
        lambda h: h["followed"] != "",
        lambda h: {"followed": "false" if h["followed"] == "true" else "true"},
    ),
    "another card of the move": (
        any_hint,
        lambda h: {"move_card": "first" if h["move_card"] == "second" else "second"},
    ),
    "a sentence of no language": (any_hint, lambda _: {"sentence": "You are doing well, go on."}),
    "no reason where one is given": (
        lambda h: h["sentence"].startswith("You have seen") and ". " in h["sentence"],
        lambda h: {"sentence": h["sentence"].split(". ", 1)[1]},
    ),
}


@pytest.fixture(scope="module")
def checker(tmp_path_factory: pytest.TempPathFactory) -> Checker:
    """Return a session of every condition that helps, in each language."""
    return Checker(played(tmp_path_factory.mktemp("truth"), 3 * len(TOLD)))


def test_every_hint_of_a_data_set_is_read_and_true(checker: Checker) -> None:
    assert [(hint["sentence"], fault) for hint in checker.hints for fault in checker.faults(hint)] == []
    assert len(checker.hints) > 500
    assert {checker.people[hint["participant_id"]]["condition"] for hint in checker.hints} == set(TOLD)


@pytest.mark.parametrize("kind", WRONG)
def test_a_wrong_claim_that_is_put_in_is_found(checker: Checker, kind: str) -> None:
    fits, change = WRONG[kind]
    english = (hint for hint in checker.hints if checker.people[hint["participant_id"]]["language"] == "en")
    hint = next(hint for hint in english if fits(hint))
    assert list(checker.faults(hint | change(hint)))
