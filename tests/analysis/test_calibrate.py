"""Calibration: the likelihood against enumeration, recovery of a known population, and the command's files."""

from __future__ import annotations

import itertools
import json
import re
from pathlib import Path
from random import Random

import numpy as np
import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.analysis import memory_likelihood as ml
from kiosk.analysis.calibrate import GRID, STEP, Calibration, CredibleInterval, fit, read_games
from kiosk.analysis.calibration_checks import CalibrationChecks, RankCheck, calibration_page, check_calibration
from kiosk.analysis.memory_likelihood import FOLLOW, FREE, LAPSE, NO_FLIP, PlayedGame
from kiosk.analysis.plan import TEMPLATE
from kiosk.analysis.simulated_study import StudyCell, simulate_participants, write_dataset
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.cli.main import recollect
from kiosk.experiment.condition import Condition
from kiosk.training.simulated_players import MemoryPlayer, PopulationPlayer
from kiosk.training.simulation import record_games, simulate_games

PEOPLE = PopulationPlayer(-1.39, 0.5, 0.9, 0.02)


def write_study(folder: Path, each: int, player: PopulationPlayer = PEOPLE, seed: int = 5) -> Path:
    policy = QTable.named("default")
    cells = [StudyCell(Condition.TOM, each), StudyCell(Condition.NOTOM, each)]
    people = list(simulate_participants(policy, player, TargetRule.MOST_FLIPPED, cells, seed))
    write_dataset(folder, people, policy, TargetRule.MOST_FLIPPED, "Simulated")
    return folder


def enumerated(ages: list[int], move: tuple[int, int], d: float, one: set[int] | None, two: set[int] | None) -> float:
    """Return the chance of a move by going through every set of cards that may be recalled."""
    cards, (x, y), total = len(ages), move, 0.0
    chances = [(1 - d) ** age if age >= 0 else 0.0 for age in ages]
    for recalled in itertools.product((False, True), repeat=cards):
        p = float(np.prod([chances[c] if recalled[c] else 1 - chances[c] for c in range(cards)]))
        if one is None:
            p /= cards
        else:
            pairs = [c for c in one if recalled[c] and recalled[c ^ 1]]
            pool = pairs or [c for c in one if not recalled[c]] or list(one)
            p *= (x in pool) / len(pool)
        if y != NO_FLIP and two is None:
            p /= cards - 1
        elif y != NO_FLIP and two is not None:
            unknown = [c for c in two if not recalled[c]]
            p *= float(y == x ^ 1) if recalled[x ^ 1] else (y in unknown) / len(unknown)
        total += p
    return total


@pytest.mark.parametrize("seed", range(60))
def test_the_likelihood_of_a_move_is_the_sum_over_everything_that_may_be_recalled(seed: int) -> None:
    rng = Random(seed)
    cards = 2 * rng.choice([1, 2, 3, 4])
    ages = [rng.choice([-1, 0, 1, 3, 8]) for _ in range(cards)]
    x = rng.randrange(cards)
    y = rng.choice([x ^ 1, rng.choice([c for c in range(cards) if c != x]), NO_FLIP])
    line = set(rng.sample(range(cards), rng.randint(1, cards)))
    other = set(rng.sample([c for c in range(cards) if c != x], rng.randint(1, cards - 1))) | {x ^ 1}
    lines = ([c in line for c in range(cards)], [c in other and y != NO_FLIP for c in range(cards)])
    moves = ml._Moves([0], [ages], [(x, y)], [lines], [(True, y != NO_FLIP)])
    terms = ml._group(cards // 2, moves, np.array([0.3])).terms[0, :, :, 0]
    every = set(range(cards))
    for first, one in ((LAPSE, None), (FREE, every), (FOLLOW, line)):
        for second, two in ((LAPSE, None), (FREE, every - {x}), (FOLLOW, other)):
            if y != NO_FLIP or second == LAPSE:
                assert terms[first, second] == pytest.approx(enumerated(ages, (x, y), 0.3, one, two), abs=1e-12)


def test_the_chances_of_all_second_cards_sum_to_one() -> None:
    game = next(record_games(QTable.blank(), MemoryPlayer((0.2, 0.2)), TargetRule.RANDOM, 1, 3))
    at = 10
    first = game.flips[at][0]
    found = {
        c
        for i in range(0, at, 2)
        if game.mates[game.flips[i][0]] == game.flips[i + 1][0]
        for c in (game.flips[i][0], game.flips[i + 1][0])
    }
    start = PlayedGame(game.mates, 6, game.flips[: at + 1])
    alone = ml.move_likelihood([start], np.array([0.2])).games(1.0, 0.0)[0, 0]
    each = [
        ml.move_likelihood([PlayedGame(game.mates, 6, (*game.flips[: at + 1], (c, 0, -1)))], np.array([0.2])).games(
            1.0, 0.0
        )[0, 0]
        for c in range(24)
        if c not in found and c != first
    ]
    assert np.exp(np.array(each) - alone).sum() == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_known_population_is_found_again(seed: int) -> None:
    policy = QTable.named("default")
    games = [
        PlayedGame(game.mates, 6, game.flips)
        for rule, start in ((TargetRule.MOST_FLIPPED, 0), (TargetRule.RANDOM, 1000))
        for game in record_games(policy, PopulationPlayer(-1.39, 0.5, 0.9, 0.0), rule, 28, start + seed)
    ]
    found = fit([str(number) for number in range(56)], games)
    assert found.mean.se is not None
    assert abs(found.mean.value + 1.39) < 2 * found.mean.se
    assert abs(found.spread.value / 0.5 - 1) < 0.3
    assert found.following is not None
    assert found.following.low < 0.9 < found.following.high
    assert found.lapse.low < 0.001
    assert found.lapse.high < 0.03


def test_the_command_writes_people_that_simulate_and_train_read(tmp_path: Path) -> None:
    folder, people, page = write_study(tmp_path / "study", 8), tmp_path / "people.json", tmp_path / "page.html"
    done = CliRunner().invoke(
        recollect, ["calibrate", str(folder), "--out", str(people), "--page", str(page), "--json"]
    )
    assert done.exit_code == 0, done.output
    told = json.loads(done.stdout)
    assert told["sessions"] == 16
    assert len(told["rank_histogram"]["counts"]) == 10
    assert "age 0" in told["age"]
    assert {row["name"] for row in told["predictive_check"]} >= {"tom: flips, mean", "notom: hints followed"}
    assert "http" not in page.read_text().replace("http://www.w3.org", "")
    player = PopulationPlayer.load(people)
    assert player.forgetting_mean == told["forgetting_mean"]
    played = CliRunner().invoke(recollect, ["simulate", "--people", str(people), "--games", "50", "--json"])
    assert json.loads(played.stdout)["player"] == player.parameters()
    table = tmp_path / "table.json"
    train = ["train", "--people", str(people), "--episodes", "10", "--out", str(table), "--json"]
    assert CliRunner().invoke(recollect, train).exit_code == 0
    command = QTable.load(table).training["command"]
    again = tmp_path / "again.json"
    CliRunner().invoke(recollect, [*command.split()[1:], "--out", str(again)])
    assert again.read_text() == table.read_text()


def test_the_page_of_calibration_gives_the_numbers_of_its_example(tmp_path: Path) -> None:
    plan, study = tmp_path / "plan.toml", tmp_path / "example"
    plan.write_text(TEMPLATE.replace("n_per_arm = 56", "n_per_arm = 28"))
    made = CliRunner().invoke(recollect, ["plan", "simulate", str(plan), "--out", str(study)])
    assert made.exit_code == 0, made.output
    done = CliRunner().invoke(recollect, ["calibrate", str(study), "--json"])
    assert done.exit_code == 0, done.output
    found = json.loads(done.stdout)
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "calibrate.md").read_text("utf-8")
    for name, label in (
        ("forgetting_mean", "forgetting, mean of the logit"),
        ("forgetting_spread", "forgetting, spread of the logit"),
        ("follow", "following"),
    ):
        each = found["intervals"][name]
        line = f"{label:<34}{each['value']:>7.3f}   95 % interval {each['low']:.3f} to {each['high']:.3f}"
        assert line in page


def test_too_few_games_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="holds 8 games; a calibration needs at least 10"):
        read_games(write_study(tmp_path / "study", 4))


def calibration(spread: float) -> Calibration:
    """Return a calibration without people whose population has this spread."""
    same = CredibleInterval(0.9, 0.8, 1.0)
    return Calibration(
        CredibleInterval(-1.4, -1.6, -1.2),
        CredibleInterval(spread, 0.01, 0.2),
        same,
        same,
        0.0,
        (),
        np.ones((0, len(GRID))),
    )


CHECKED = CalibrationChecks((), RankCheck((1,) * 10, 1.0), {"tom": ([40], [50])})


def test_a_spread_below_the_step_of_the_grid_is_warned_of() -> None:
    found = calibration(STEP / 2)
    assert "below the grid's step" in found.warnings[0]
    page = calibration_page("x", found, CHECKED)
    assert "below the grid" in page
    assert "age 0" in page


def test_the_drawings_of_a_page_share_no_id() -> None:
    page = calibration_page("x", calibration(0.5), CHECKED)
    ids = re.findall(r'\bid="([^"]+)"', page)
    assert {name.partition("-")[0] for name in ids} == {"people", "flips", "ranks"}
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'(?:href="|url\()#([^")]+)', page)) <= set(ids)


def test_a_wrong_population_fails_the_predictive_check(tmp_path: Path) -> None:
    study = read_games(write_study(tmp_path / "study", 8))
    same = CredibleInterval(0.9, 0.8, 1.0)
    mean = CredibleInterval(1.0, 0.9, 1.1)
    wrong = Calibration(
        mean, CredibleInterval(0.5, 0.4, 0.6), same, CredibleInterval(0.02, 0, 0.1), 0.0, (), np.ones((0, len(GRID)))
    )
    checks = check_calibration(study, wrong, studies=40)
    assert all(row.p < 0.1 for row in checks.predicted if row.name.endswith("flips, mean"))


def test_people_are_drawn_anew_for_every_game_and_lapses_cost_flips() -> None:
    policy = QTable.blank()
    games = list(record_games(policy, PopulationPlayer(-1.4, 0.5), TargetRule.RANDOM, 400, 1))
    logits = np.log([game.forgetting / (1 - game.forgetting) for game in games])
    assert logits.mean() == pytest.approx(-1.4, abs=0.1)
    assert logits.std() == pytest.approx(0.5, abs=0.06)
    without = simulate_games(policy, MemoryPlayer((0.1, 0.1)), TargetRule.RANDOM, 300, 1)
    lapsing = simulate_games(policy, MemoryPlayer((0.1, 0.1), lapse=0.3), TargetRule.RANDOM, 300, 1)
    assert lapsing.flips.mean > without.flips.mean + 5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "is not JSON"),
        ("[]", "is not a file of people"),
        ('{"format": "recollect-people-1", "forgetting_mean": 1}', "lacks 'forgetting_spread'"),
        (
            '{"format": "recollect-people-1", "forgetting_mean": 1, "forgetting_spread": -1, "follow": 1, "lapse": 0}',
            "forgetting_spread must be a number from 0",
        ),
    ],
)
def test_a_file_that_holds_no_people_is_refused(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "people.json"
    file.write_text(text)
    with pytest.raises(UserInputError, match=said):
        PopulationPlayer.load(file)
