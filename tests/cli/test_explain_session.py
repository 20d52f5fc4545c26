"""A decision of a stored session comes out as it was decided then, from nothing but what was recorded."""

from __future__ import annotations

import json
import sqlite3
import sys
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from kiosk import UserInputError
from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate
from kiosk.cli.main import main
from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.events import AssistanceDecided, CardFlipped, HintGiven, MemoryEstimated, PolicyUpdated
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.session import Session
from kiosk.store.database import FILE
from kiosk.store.queries import DecisionExplainer, open_repository
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver, forgetful
from tests.samples import mixed, plan, whole

SEED = 5
HELPED = tuple(condition for condition in CONDITIONS if condition != Condition.NO_ASSISTANCE)


def stored(folder: Path, condition: Condition = Condition.TOM, **settings: Any) -> Driver:
    """Return a game played to its end, and on the disk."""
    driver = played(condition, json.dumps(settings))
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(driver.plan, SEED, "avatar", "unknown", kind=SessionKind.SIMULATED), driver.events)
    return driver


@cache
def played(condition: Condition, settings: str) -> Driver:
    """Return a game played to its end with these settings, which are JSON; tests only read it."""
    driver = Driver(plan(condition, mixed(SEED, Gate()), **json.loads(settings)), SEED)
    driver.to_the_game()
    driver.play(forgetful(SEED))
    return driver


@pytest.mark.parametrize("condition", HELPED)
def test_every_decision_comes_out_as_it_was_decided(tmp_path: Path, condition: Condition) -> None:
    driver = stored(tmp_path, condition)
    given = {hint.flip: hint for hint in driver.noted(HintGiven)}
    with open_repository(tmp_path) as sessions:
        explainer = DecisionExplainer(sessions, 1)
        for then in driver.noted(AssistanceDecided):
            now = explainer.explain(then.flip)
            assert (now.decision.action, now.decision.gate_decision) == (then.action, then.gate)
            assert (now.decision.state.game, now.decision.state.last) == (then.game, then.last)
            assert now.decision.state.outcome is then.outcome
            hint = given.get(then.flip)
            assert now.spoken == (hint.sentence if hint else None)
            assert hint is None or hint.target in now.candidates
            assert hint is None or hint.sentence in now.sentences
    assert len(given) > 10


def test_the_other_target_rule_is_followed_too(tmp_path: Path) -> None:
    driver = stored(tmp_path, assistance={"target_rule": "most_recent"})
    with open_repository(tmp_path) as sessions:
        explainer = DecisionExplainer(sessions, 1)
        for hint in driver.noted(HintGiven):
            assert explainer.explain(hint.flip).candidates == (hint.target,)


def test_a_table_that_went_on_learning_is_explained_as_it_stood_at_that_flip(tmp_path: Path) -> None:
    driver = stored(tmp_path, assistance={"step": 0.05})
    decisions = driver.noted(AssistanceDecided)
    with open_repository(tmp_path) as sessions:
        explainer = DecisionExplainer(sessions, 1)
        first, last = (explainer.explain(then.flip).decision for then in (decisions[0], decisions[-1]))
        for then in decisions:
            assert explainer.explain(then.flip).decision.action is then.action
    policy = driver.plan.policy
    assert first.q == policy.row(first.state)
    assert last.q != policy.row(last.state)


def test_what_a_table_came_to_is_recorded_and_the_table_it_began_as_is_unchanged(tmp_path: Path) -> None:
    before = plan(Condition.TOM, mixed(SEED, Gate())).policy.sha256
    driver = stored(tmp_path, assistance={"step": 0.05})
    (adapted,) = driver.noted(PolicyUpdated)
    assert driver.plan.policy.sha256 == before
    assert adapted.sha256 != before
    assert not stored(tmp_path / "frozen").noted(PolicyUpdated)


OWN = {"own": {"target_rule": "most_recent", "location": False, "praise": 0.5}}
"""A study's own condition: it reminds, and praises."""
MODELLED = {"memory_model": True}
BY_MODEL = {
    "timing": "model",
    "threshold_first": 0.3,
    "threshold_second": 0.6,
    "threshold_card": 0.0,
    "threshold_flips": 0,
}
EXPLORING = {"explore": 0.5, "step": 0.05}


@pytest.mark.parametrize(
    ("condition", "options"),
    [
        (Condition.TOM, MODELLED),
        (Condition.RANDOM_EXPLAINED, EXPLORING),
        *((condition, BY_MODEL) for condition in (*HELPED, Condition("own"))),
    ],
    ids=lambda each: each.name if isinstance(each, Condition) else "".join(each),
)
def test_decisions_by_memory_and_by_chance_come_out_as_they_were_decided(
    tmp_path: Path, condition: Condition, options: dict[str, Any]
) -> None:
    driver = stored(tmp_path, condition, assistance=options, conditions=OWN)
    memories = {memory.flip: memory.estimate for memory in driver.noted(MemoryEstimated)}
    with open_repository(tmp_path) as sessions:
        explainer = DecisionExplainer(sessions, 1)
        for then in driver.noted(AssistanceDecided)[1::5]:
            now = explainer.explain(then.flip).decision
            assert (now.action, now.greedy, now.probability) == (then.action, then.greedy, then.probability)
            assert now.memory == memories.get(then.flip)
    assert len(memories) == (0 if options is EXPLORING else len(driver.noted(AssistanceDecided)))


def test_a_model_of_memory_changes_nothing_but_what_is_recorded_of_it() -> None:
    without, modelled = (played(Condition.TOM, json.dumps({"assistance": each})) for each in ({}, MODELLED))
    assert [event for event in modelled.events if not isinstance(event, MemoryEstimated)] == list(without.events)


def test_help_by_the_model_comes_below_the_threshold_and_the_explanation_says_so(tmp_path: Path) -> None:
    driver = stored(tmp_path, assistance=BY_MODEL)
    memories = {memory.flip: memory for memory in driver.noted(MemoryEstimated)}
    opened = [then for then in driver.noted(AssistanceDecided) if then.gate.is_open]
    for then in opened:
        below = memories[then.flip].match_recalled < (0.3 if then.card is FlipInMove.FIRST else 0.6)
        assert then.action is (ActionSpec.SUG_COL if below else ActionSpec.NO_HELP)
    helped = next(then for then in opened if then.action is ActionSpec.SUG_COL and then.card is FlipInMove.SECOND)
    with open_repository(tmp_path) as sessions:
        told = DecisionExplainer(sessions, 1).explain(helped.flip).to_json()
    assert told["q"] == {}
    assert told["timing"] == {"first": 0.3, "second": 0.6, "card": 0.0, "flips": 0, "action": "sug_col"}
    assert told["memory"]["match_recalled"] < 0.6


def test_the_model_is_shown_as_a_board_of_chances(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    driver = stored(tmp_path, assistance=BY_MODEL)
    sys.argv = ["recollect", "explain", "1", "--flip", "20", "--data", str(tmp_path)]
    with pytest.raises(SystemExit):
        main()
    printed = capsys.readouterr().out
    recall = next(memory.recall for memory in driver.noted(MemoryEstimated) if memory.flip == 20)
    assert " ".join(f"{percent:3}" for percent in recall[:6]) in printed
    assert "the mate of the open card is recalled with the chance" in printed


def test_where_the_gate_is_open_any_action_may_be_drawn_and_its_probability_is_recorded() -> None:
    driver = played(Condition.TOM, json.dumps({"assistance": {"explore": 0.5}}))
    opened = [then for then in driver.noted(AssistanceDecided) if then.gate.is_open]
    shut = [then for then in driver.noted(AssistanceDecided) if not then.gate.is_open]
    assert {(then.action, then.probability, then.randomised) for then in shut} == {(ActionSpec.NO_HELP, 1.0, False)}
    assert all(then.probability == (0.625 if then.action is then.greedy else 0.125) for then in opened)
    assert len({then.action for then in opened}) == 4
    assert 0 < sum(then.action is not then.greedy for then in opened) < len(opened)


def test_the_plan_of_a_session_is_kept_whole(tmp_path: Path) -> None:
    driver = stored(tmp_path)
    with open_repository(tmp_path) as sessions:
        kept, seed = sessions.plan(1), sessions.seed(1)
    assert seed == SEED
    assert (kept.settings, kept.condition, kept.policy) == (
        *(driver.plan.settings, driver.plan.condition),
        driver.plan.policy,
    )
    assert (kept.questionnaires, kept.deck) == (driver.plan.questionnaires, driver.plan.deck)
    assert kept.catalogue.sources == driver.plan.catalogue.sources


def test_a_session_on_the_kept_plan_says_the_same_again(tmp_path: Path) -> None:
    driver = stored(tmp_path)
    with open_repository(tmp_path) as sessions:
        session = Session(sessions.plan(1), sessions.seed(1))
    again = [note for event in driver.world for note in session.handle(event).events]
    assert again == [note for step in driver.steps for note in step.outcome.events]


def test_where_nobody_helped_the_state_is_told_all_the_same(tmp_path: Path) -> None:
    stored(tmp_path, Condition.NO_ASSISTANCE)
    with open_repository(tmp_path) as sessions:
        told = DecisionExplainer(sessions, 1).explain(30).to_json()
        assert (told["action"], told["targets"], told["target"]) == ("no_help", [], None)
        with pytest.raises(UserInputError, match="nothing was decided about a flip 400"):
            DecisionExplainer(sessions, 1).explain(400)


def test_a_flip_that_never_came_is_refused(tmp_path: Path) -> None:
    flips = len(stored(tmp_path).noted(CardFlipped))
    with (
        open_repository(tmp_path) as sessions,
        pytest.raises(UserInputError, match=f"session 1 has {flips} flips; nothing was decided about a flip 400"),
    ):
        DecisionExplainer(sessions, 1).explain(400)


def test_a_session_without_a_game_is_refused(tmp_path: Path) -> None:
    followed = plan()
    driver = Driver(followed, SEED)
    driver.start()
    with Recorder(tmp_path) as recorder:
        recorder.begin(Provenance(followed, SEED, "avatar", "unknown", kind=SessionKind.SIMULATED), driver.events)
    with open_repository(tmp_path) as sessions, pytest.raises(UserInputError, match="in session 1 no game was dealt"):
        DecisionExplainer(sessions, 1).explain(1)


@pytest.mark.parametrize("condition", [Condition.TOM, Condition.NO_ASSISTANCE])
def test_a_practice_is_not_taken_for_the_game(tmp_path: Path, condition: Condition) -> None:
    followed = whole(condition)
    driver = Driver(followed, SEED)
    driver.to(Stage.PRACTICE)
    driver.flip(driver.view.closed[0])
    driver.end()
    with Recorder(tmp_path) as recorder:
        recorder.begin(Provenance(followed, SEED, "avatar", "unknown", kind=SessionKind.SIMULATED), driver.events)
    with open_repository(tmp_path) as sessions, pytest.raises(UserInputError, match="in session 1 no game was dealt"):
        DecisionExplainer(sessions, 1).explain(1)


def tamper(folder: Path, statement: str) -> None:
    """Change a record in spite of everything."""
    connection = sqlite3.connect(folder / FILE)
    with connection:
        connection.execute("DROP TRIGGER event_is_never_updated")
        connection.execute(statement)
    connection.close()


@pytest.mark.parametrize("change", ["'$.action', 'no_help'", "'$.gate', 'opening'", "'$.last', 'sug_card'"])
def test_a_record_that_does_not_follow_from_the_others_is_found_out(tmp_path: Path, change: str) -> None:
    flip = stored(tmp_path).noted(HintGiven)[0].flip
    tamper(
        tmp_path,
        f"UPDATE event SET payload = json_set(payload, {change}) "  # noqa: S608 - a test's own words
        f"WHERE type = 'AssistanceDecided' AND payload ->> '$.flip' = {flip}",
    )
    with (
        open_repository(tmp_path) as sessions,
        pytest.raises(UserInputError, match=f"flip {flip} of session 1 comes out otherwise"),
    ):
        DecisionExplainer(sessions, 1).explain(flip)


@pytest.mark.parametrize("change", ["'$.seen', 9", "'$.sentence', 'Look there.'", "'$.reason', 'nothing-known'"])
def test_a_hint_that_does_not_follow_from_the_flips_is_found_out(tmp_path: Path, change: str) -> None:
    flip = stored(tmp_path).noted(HintGiven)[0].flip
    tamper(tmp_path, f"UPDATE event SET payload = json_set(payload, {change}) WHERE type = 'HintGiven'")  # noqa: S608
    with (
        open_repository(tmp_path) as sessions,
        pytest.raises(UserInputError, match=f"flip {flip} of session 1 comes out otherwise"),
    ):
        DecisionExplainer(sessions, 1).explain(flip)


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    """Call the command line in this process; returns its exit code."""
    monkeypatch.setattr(sys, "argv", ["recollect", "explain", *map(str, arguments)])
    with pytest.raises(SystemExit) as ended:
        main()
    return ended.value.code if isinstance(ended.value.code, int) else 0


def test_the_command_line_tells_a_stored_decision(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    hint = stored(tmp_path).noted(HintGiven)[0]
    assert run(monkeypatch, 1, "--flip", hint.flip, "--data", tmp_path, "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert told["said"] == hint.sentence
    assert told["target"]["location"] == 6 * hint.target.row + hint.target.column
    assert told["counts"] == {"target": hint.seen, "other": hint.mate_seen}
    assert run(monkeypatch, 1, "--flip", hint.flip, "--data", tmp_path) == 0
    assert f"said       {hint.sentence}\n" in capsys.readouterr().out


def test_without_a_flip_every_decision_is_told_with_its_board(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    driver = stored(tmp_path)
    decisions, hints = driver.noted(AssistanceDecided), driver.noted(HintGiven)
    assert run(monkeypatch, 1, "--data", tmp_path, "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert [each["flip"] for each in told["decisions"]] == [then.flip for then in decisions]
    assert [each["action"] for each in told["decisions"]] == [then.action.label for then in decisions]
    flips = driver.noted(CardFlipped)
    for each in told["decisions"]:
        before = [flip for flip in flips if flip.number < each["flip"]]
        assert sum(each["turned"].values()) == len(before)
        assert len(each["found"]) == 2 * sum(flip.matched is True for flip in before)
        assert (each["open"] is None) is (each["flip"] % 2 == 1)
    assert run(monkeypatch, 1, "--data", tmp_path) == 0
    text = capsys.readouterr().out
    assert text.count("\nflip ") == len(decisions)
    hint = hints[-1]
    drawn = text.split(f"\nflip {hint.flip} ")[1].splitlines()[1:5]
    marked = [cell.strip(">") for cell in drawn[hint.target.row].split() if cell.startswith(">")]
    card = told["cards"][6 * hint.target.row + hint.target.column]
    assert marked in ([f"{card}<"], ["\N{MIDDLE DOT}<"])
    assert f"said       {hint.sentence}\n" in text


def test_the_boards_are_drawn_as_a_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    decisions = stored(tmp_path).noted(AssistanceDecided)
    picture = tmp_path / "boards.svg"
    assert run(monkeypatch, 1, "--data", tmp_path, "--picture", picture, "--json") == 0
    json.loads(capsys.readouterr().out)
    drawing = ET.fromstring(picture.read_text("utf-8"))  # noqa: S314 - our own
    titles = [text.text for text in drawing.iter("{http://www.w3.org/2000/svg}text") if text.get("font-weight")]
    assert titles == [f"flip {then.flip}: {then.action.label}" for then in decisions]
    cells = len(list(drawing.iter("{http://www.w3.org/2000/svg}rect"))) - 1
    assert cells == 24 * len(decisions)


def test_a_decision_that_comes_out_otherwise_is_marked_among_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    flip = stored(tmp_path).noted(HintGiven)[0].flip
    tamper(
        tmp_path,
        "UPDATE event SET payload = json_set(payload, '$.gate', 'opening') "  # noqa: S608 - a test's own words
        f"WHERE type = 'AssistanceDecided' AND payload ->> '$.flip' = {flip}",
    )
    assert run(monkeypatch, 1, "--data", tmp_path, "--json") == 1
    differing = [each["flip"] for each in json.loads(capsys.readouterr().out)["decisions"] if "differs" in each]
    assert differing == [flip]


def test_where_nobody_helped_every_flip_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    flips = stored(tmp_path, Condition.NO_ASSISTANCE).noted(CardFlipped)
    assert run(monkeypatch, 1, "--data", tmp_path, "--json") == 0
    told = json.loads(capsys.readouterr().out)["decisions"]
    assert [each["flip"] for each in told] == [flip.number for flip in flips]


@pytest.mark.parametrize(
    ("session", "sentence"),
    [("2", "there is no session 2"), ("one", "a stored session goes by its number, not by 'one'")],
)
def test_a_session_that_is_not_there_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], session: str, sentence: str
) -> None:
    stored(tmp_path)
    assert run(monkeypatch, session, "--flip", 1, "--data", tmp_path) == 2
    assert capsys.readouterr().err == f"recollect: {sentence}\n"


def test_a_folder_without_a_database_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, 1, "--flip", 1, "--data", tmp_path) == 2
    assert capsys.readouterr().err == f"recollect: there is no database in {tmp_path}\n"
