"""A condition is two switches, and one place says which."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import pytest
from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.assistance.hint_sentences import PlainSentences, ReasonedSentences, Wording
from kiosk.assistance.mentaliser import Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.cli.study import summarised
from kiosk.config import ASSETS, PAPER_CONDITIONS, ConditionConfig, Settings, Timing
from kiosk.experiment import effects as do
from kiosk.experiment.condition import CONDITIONS, Condition, Help, help_in, target_rule
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.events import HintCue, HintGiven, HintHighlighted
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import measure
from kiosk.experiment.replay import first_difference, replay_events
from kiosk.experiment.session_state import SessionState
from kiosk.experiment.spoken_sentences import SentencePurpose
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.game import Concentration, Position
from kiosk.store.queries import DecisionExplainer, open_repository
from kiosk.study.loader import read_study
from tests.experiment.driver import Driver, at_random
from tests.export.conftest import rows_of
from tests.export.visitors import store
from tests.samples import ENGLISH, always, board_of, plan

MENTALISED = {Condition.TOM, Condition.MENTALISED_UNEXPLAINED}
EXPLAINED = {Condition.TOM, Condition.RANDOM_EXPLAINED}
HELPED = [condition for condition in CONDITIONS if condition != Condition.NO_ASSISTANCE]


def given_in(condition: Condition, rule: TargetRule = TargetRule.MOST_FLIPPED) -> Help:
    """Return the help of a condition with help."""
    given = help_in(condition.known, rule, Wording(ENGLISH, Random(1)), Random(2))
    assert given is not None
    return given


def test_the_conditions_are_the_four_cells_and_no_assistance() -> None:
    assert [condition.name for condition in CONDITIONS] == [
        "tom",
        "notom",
        "mentalised_unexplained",
        "random_explained",
        "no_assistance",
    ]


def test_without_assistance_nobody_helps() -> None:
    assert (
        help_in(Condition.NO_ASSISTANCE.known, TargetRule.MOST_FLIPPED, Wording(ENGLISH, Random(1)), Random(2)) is None
    )


@pytest.mark.parametrize("rule", [TargetRule.MOST_FLIPPED, TargetRule.MOST_RECENT])
@pytest.mark.parametrize("condition", HELPED)
def test_the_first_switch_chooses_the_target(condition: Condition, rule: TargetRule) -> None:
    game = Concentration(board_of("abc", "cab"))
    for row, column in ((0, 0), (0, 1), (0, 0), (0, 2)):
        game.flip(Position(row, column))
        game.turn_back()
    followed = rule if condition in MENTALISED else TargetRule.RANDOM
    expected = Mentaliser(followed, Random(0)).candidates(game)
    assert given_in(condition, rule).mentaliser.candidates(game) == expected


@pytest.mark.parametrize("condition", HELPED)
def test_the_second_switch_gives_or_withholds_the_reason(condition: Condition) -> None:
    kind = ReasonedSentences if condition in EXPLAINED else PlainSentences
    assert type(given_in(condition).sentences) is kind


@pytest.mark.parametrize("condition", HELPED)
def test_a_condition_shows_in_what_is_said(condition: Condition) -> None:
    driver = Driver(plan(condition, always(ActionSpec.SUG_CARD)))
    driver.to_the_game()
    driver.flip(Position(0, 0))
    for hint in driver.noted(HintGiven):
        where = ENGLISH.wordings(
            f"point-{hint.card.value}-card", row=hint.target.row + 1, column=hint.target.column + 1
        )
        assert (hint.sentence not in where) is (condition in EXPLAINED)
        assert hint.sentence.endswith(where)


@pytest.mark.parametrize("condition", CONDITIONS)
def test_a_condition_is_found_by_its_name(condition: Condition) -> None:
    assert Condition.from_name(condition.name) == condition


@pytest.mark.parametrize("name", ["", "ToM", "TOM", "both"])
def test_another_name_is_refused_with_all_that_there_are(name: str) -> None:
    with pytest.raises(
        UserInputError, match=f"there is no condition '{name}'; there are tom, notom, mentalised_unexpl"
    ):
        Condition.from_name(name)


@pytest.mark.parametrize("seed", range(5))
def test_every_condition_plays_the_same_board_on_the_same_seed(seed: int) -> None:
    dealt = set()
    for condition in CONDITIONS:
        driver = Driver(plan(condition), seed)
        driver.to_the_game()
        driver.play(at_random(seed))
        dealt.add(tuple(sorted(driver.view.up.items())))
    assert len(dealt) == 1


def test_the_two_conditions_differ_on_first_cards_and_agree_on_second_ones() -> None:
    """Both hint at every flip; the visitor flips the same cards whatever is said."""
    targets = {}
    for condition in (Condition.TOM, Condition.NOTOM):
        driver = Driver(plan(condition, always(ActionSpec.SUG_CARD)), 4)
        driver.to_the_game()
        driver.play(at_random(4))
        targets[condition] = driver.noted(HintGiven)
    tom, notom = targets.values()
    assert len(tom) == len(notom) > 40
    assert all(
        one.target == other.target for one, other in zip(tom, notom, strict=True) if one.card is FlipInMove.SECOND
    )
    assert any(
        one.target != other.target for one, other in zip(tom, notom, strict=True) if one.card is FlipInMove.FIRST
    )


REMIND = {"remind": {"location": False}}
"""A study's own condition: the explanation without the place."""


def reminding(seed: int = 4, **settings: Any) -> Driver:
    """Return a game in which every flip is preceded by a reminder."""
    driver = Driver(plan(Condition("remind"), always(ActionSpec.SUG_CARD), conditions=REMIND, **settings), seed)
    driver.to_the_game()
    driver.play(at_random(seed))
    return driver


def test_a_condition_can_remind_of_a_pair_and_name_no_place() -> None:
    driver = reminding()
    hints = driver.noted(HintGiven)
    assert len(hints) > 40
    assert not driver.noted(HintHighlighted)
    for hint in hints:
        card = ENGLISH.card(hint.name)
        assert hint.sentence in ENGLISH.wordings(f"remind-{hint.card.value}-{hint.reason.value}", **card)
        assert (hint.row, hint.column) == (None, None)
        assert not re.search(r"\d|row|column", hint.sentence)


def test_a_reminder_is_followed_by_a_card_of_its_pair_and_is_no_assistance_with_the_place() -> None:
    driver = reminding()
    (game,) = (board for board in SessionState.from_events(driver.events).boards if board.stage is Stage.GAME)
    for flip, hint in game.hints.items():
        assert game.followed(hint) is (game.flips[flip].event.card == hint.given.name)
    measured = measure(driver.events)
    assert (measured.hints, measured.assistance_per_flip) == (len(game.hints), 0)
    assert measured.followed == sum(game.followed(hint) is True for hint in game.hints.values()) / len(game.hints)


LOOK = {"look": {"gaze_only": True, "explanation": False}}
"""Another one: the helper looks toward the place, and says nothing."""


@cache
def looking() -> Driver:
    """Return a game in which every flip is preceded by a look; tests only read it."""
    driver = Driver(plan(Condition("look"), always(ActionSpec.SUG_CARD), conditions=LOOK), 4)
    driver.to_the_game()
    driver.play(at_random(4))
    return driver


def test_a_hint_can_be_a_look_that_says_nothing_and_marks_nothing() -> None:
    driver = looking()
    hints, looks = driver.noted(HintGiven), [each for each in driver.effects if isinstance(each, do.LookAt)]
    assert len(hints) > 40
    assert [(hint.row, hint.column) for hint in hints] == [(look.row, look.column) for look in looks]
    assert {(hint.sentence, hint.utterance, hint.cue) for hint in hints} == {("", 0, HintCue.GAZE)}
    state = SessionState.from_events(driver.events)
    assert not driver.noted(HintHighlighted)
    waits = {each.wait for each in driver.effects if isinstance(each, do.LockBoard)}
    assert waits == {BoardWait.LOOKING, BoardWait.TURNING_BACK}
    assert not [said for said in state.sentences if said.purpose is SentencePurpose.HINT]


def test_a_look_holds_the_board_for_its_time_and_counts_as_the_help_that_it_is() -> None:
    driver = looking()
    (game,) = (board for board in SessionState.from_events(driver.events).boards if board.stage is Stage.GAME)
    holds = {(hint.opened_ms or 0) - hint.given.at_ms for hint in game.hints.values()}
    assert holds == {driver.plan.timing.gaze_ms}
    assert measure(driver.events).assistance_per_flip == ActionSpec.SUG_CARD.level
    assert all(
        game.followed(hint) is (game.flips[flip].event.position == hint.given.target)
        for flip, hint in game.hints.items()
    )


def test_a_look_is_replayed_explained_and_exported(tmp_path: Path) -> None:
    driver = looking()
    assert first_difference(replay_events(driver.plan, 4, driver.events), driver.events) is None
    store(tmp_path / "data", [(driver, 4)])
    with open_repository(tmp_path / "data") as sessions:
        told = DecisionExplainer(sessions, 1).explain(7).to_json()
    assert (told["action"], told["sentences"], "said" in told) == ("sug_card", [], False)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    rows = rows_of(tmp_path / "out", "hints")
    assert {(row["cue"], row["sentence"], row["utterance"], row["marked_ms"]) for row in rows} == {("gaze", "", "", "")}
    assert all(row["told_column"] and row["opened_ms"] for row in rows)


@pytest.mark.parametrize("declared", [{"gaze_only": True}, {"gaze_only": True, "location": False}])
def test_a_look_explains_nothing_and_has_a_place(declared: dict[str, bool]) -> None:
    with pytest.raises(ValidationError, match="gaze_only needs a location and no explanation"):
        ConditionConfig.model_validate(declared)


def test_a_robot_that_looks_nowhere_cannot_give_hints_by_looking(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    declared = '[robot]\nkind = "furhat"\ngaze = {}\n[conditions.look]\ngaze_only = true\nexplanation = false\n'
    file.write_text(declared.format("false"), "utf-8")
    with pytest.raises(UserInputError, match=r"conditions\.look\.gaze_only.*robot\.gaze is false"):
        read_study(Settings.read(file))
    file.write_text(declared.format("true"), "utf-8")
    assert read_study(Settings.read(file)).settings.conditions["look"].gaze_only


def test_a_session_in_a_declared_condition_is_replayed_as_it_was() -> None:
    driver = reminding()
    assert first_difference(replay_events(driver.plan, 4, driver.events), driver.events) is None


def test_a_condition_has_its_own_table_and_times(tmp_path: Path) -> None:
    (tmp_path / "own.json").write_text(always(ActionSpec.SUG_ROW).to_json(), "utf-8")
    file = tmp_path / "study.toml"
    file.write_text(
        'languages = ["en"]\n[randomisation]\ntarget_n = { tom = 4, rows = 4 }\n'
        '[conditions.rows]\npolicy = "./own.json"\ntarget_rule = "most_recent"\ntiming = { hold_min_ms = 7000 }\n',
        "utf-8",
    )
    study = read_study(Settings.read(file))
    rows = study.plan("en", Condition("rows"))
    assert (rows.policy.sha256, rows.timing.hold_min_ms) == (always(ActionSpec.SUG_ROW).sha256, 7000)
    tom = rows.in_condition(Condition.TOM)
    assert (tom.policy.name, tom.timing) == ("default", Timing())
    assert target_rule(rows.cell, TargetRule.MOST_FLIPPED) is TargetRule.MOST_RECENT
    assert list(summarised(study)["conditions"]) == ["tom", "rows"]


WRONG = {
    "[conditions.mute]\nexplanation = false\nlocation = false": "conditions.mute: a hint without an explanation and",
    "[conditions.Remind]\nlocation = false": "'Remind' is no name of a condition",
    "[conditions.tom]\nlocation = false": "conditions: 'tom' has a meaning of its own",
    "[conditions.new]\ntiming = { hold_min = 3 }": "conditions.new.timing: there is no key 'hold_min'",
    "[conditions.new]\ntiming = { hold_min_ms = -1 }": "conditions.new.timing: hold_min_ms must be from 0 to 60000",
    '[conditions.new]\npolicy = "missing"': "conditions.new.policy: there is no",
    '[conditions.new]\ntarget_rule = "best"': "conditions.new.target_rule must be",
    '[assistance]\ncondition = "new"': "assistance.condition: there is no condition 'new'; there are tom, notom",
    "[randomisation]\ntarget_n = { tom = 2, new = 2 }\nblock_size = 2": "there is no condition 'new'",
    '[assistance]\ncondition = "nan"\n[conditions.nan]': "the condition 'nan' is taken for a missing value",
}


@pytest.mark.parametrize(("lines", "sentence"), WRONG.items(), ids=WRONG)
def test_a_condition_that_cannot_be_is_refused_in_a_sentence(lines: str, sentence: str, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(f'languages = ["en"]\n{lines}\n', "utf-8")
    with pytest.raises(UserInputError) as refused:
        read_study(Settings.read(file))
    assert sentence in refused.value.sentences[0]
    assert str(file) in refused.value.sentences[0]


def test_the_shipped_study_declares_the_papers_two() -> None:
    shipped = Settings.read(ASSETS / "studies" / "paper.toml")
    assert list(shipped.conditions) == list(shipped.randomisation.target_n) == ["tom", "notom"]
    assert shipped.conditions == PAPER_CONDITIONS
