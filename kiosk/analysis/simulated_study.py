"""Simulate participants of a study, and write them as a data set in the layout of ``recollect export``.

Games are played by a population of memory players under the study's table. A participant needs a time per flip of
their own, and answers each scale with a sum around the scale's mean; neither depends on the condition unless an effect
is asked for.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from kiosk.analysis.data import COLUMNS, DESCRIPTION
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, QTable
from kiosk.experiment.condition import Condition, target_rule
from kiosk.export.codebook import CODEBOOK_VERSION
from kiosk.export.layouts import file_of
from kiosk.export.new_files import new_folder
from kiosk.training.simulated_players import SimulatedPlayer
from kiosk.training.simulation import RecordedGame, record_games
from kiosk.training.vectorised_game import CARDS, PAIRS
from kiosk.training.vectorised_game import COLUMNS as BOARD_COLUMNS

SECONDS_PER_FLIP = 1.1
"""The median time of a participant for a flip, of their own, without speech and holds."""
PACE_SPREAD = 0.3
"""SD of the logarithm of that time over participants."""
SCALES = {"SOC": (12.7, 3.7), "AC": (14.0, 3.0), "PC": (11.5, 3.0), "RC": (13.0, 3.5)}
"""Mean and SD of the sum of each scale (4 items from 1 to 5); about the pooled values of the paper."""
ITEMS, POINTS = 4, 5
"""Items of a scale, and points of an item."""
LOWEST_SUM, HIGHEST_SUM = ITEMS, ITEMS * POINTS
BOARD = 2
"""The game's board; the first is that of the practice."""

Numbers = dict[str, float]


@dataclass(frozen=True, slots=True)
class StudyCell:
    """One arm: its condition, how many complete participants it has, and shifts of measures in SDs of the arm."""

    condition: Condition
    n: int
    shifts: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SimulatedRecord:
    """One simulated person: the arm, the game and the measures, missing ones NaN."""

    name: str
    condition: Condition
    game: RecordedGame
    measures: Numbers


def simulate_participants(
    policy: QTable, player: SimulatedPlayer, rule: TargetRule, cells: Sequence[StudyCell], seed: int
) -> Iterator[SimulatedRecord]:
    """Simulate every participant of some arms; fixed by ``seed`` (0 or more).

    ``player`` should be drawn anew for every game, as people differ; ``rule`` is the rule of mentalised conditions.
    """
    number = 0
    for at, cell in enumerate(cells):
        where = target_rule(cell.condition.known, rule)
        table = policy if where is not None else QTable.blank()
        rng = np.random.default_rng([seed, at])
        game_seed = int(rng.integers(2**62))
        for game in record_games(table, player, where or TargetRule.RANDOM, cell.n, game_seed):
            number += 1
            yield SimulatedRecord(f"s{number:04}", cell.condition, game, _measures(game, rng, cell.shifts))


def game_measures(game: RecordedGame) -> Numbers:
    """Return the measures of a game as an export has them; rates without any hint are NaN."""
    hints = followed = first = followed_first = led = 0
    levels = 0.0
    led_on = False
    for at, (place, action, target) in enumerate(game.flips):
        matched = at % 2 == 1 and game.mates[game.flips[at - 1][0]] == place
        if at % 2 == 1 and led_on:
            led += matched
        hit = action != int(ActionSpec.NO_HELP) and follows_hint(place, action, target)
        led_on = at % 2 == 0 and hit
        if action != int(ActionSpec.NO_HELP):
            hints += 1
            levels += ACTIONS[action].level
            followed += hit
            first += at % 2 == 0
            followed_first += led_on
    flips = len(game.flips)
    return {
        "flips": flips,
        "moves": flips / 2,
        "hints": hints,
        "assistance_per_flip": levels / flips,
        "followed_rate": followed / hints if hints else np.nan,
        "first_followed_rate": followed_first / first if first else np.nan,
        "first_led_to_match_rate": led / first if first else np.nan,
    }


def follows_hint(place: int, action: int, target: int, columns: int = BOARD_COLUMNS) -> bool:
    """Whether a flip follows its hint: it is the hinted card, or lies in the hinted row or column."""
    if action == int(ActionSpec.SUG_CARD):
        return place == target
    if action == int(ActionSpec.SUG_COL):
        return place % columns == target % columns
    return place // columns == target // columns


def _measures(game: RecordedGame, rng: np.random.Generator, shifts: Mapping[str, float]) -> Numbers:
    measures = game_measures(game)
    pace = float(np.exp(np.log(SECONDS_PER_FLIP) + PACE_SPREAD * rng.standard_normal()))
    own = 1000 * pace * measures["flips"]
    measures |= {"completion_ms": own, "completion_with_speech_ms": own + 3500 * measures["hints"]}
    measures["per_match_ms"] = own / PAIRS
    for scale, (mean, sd) in SCALES.items():
        drawn = mean + sd * (rng.standard_normal() + shifts.get(scale, 0.0))
        measures[f"{scale}_sum"] = float(np.clip(np.rint(drawn), LOWEST_SUM, HIGHEST_SUM))
    return measures


def write_dataset(
    folder: Path, people: Sequence[SimulatedRecord], policy: QTable, rule: TargetRule, title: str
) -> None:
    """Write simulated participants as a data set that ``report`` and ``calibrate`` read; ``folder`` must be new.

    Raises UserInputError, and writes nothing, if the folder cannot be used.
    """
    with new_folder(folder) as root:
        _json(
            root / DESCRIPTION,
            {
                "@context": "https://schema.org/",
                "@type": "Dataset",
                "name": title,
                "description": f"{len(people)} simulated participants; made by Recollect, without any person.",
                "schemaVersion": CODEBOOK_VERSION,
            },
        )
        _json(root / "materials" / "settings" / "settings.json", {"assistance": {"target_rule": rule.value}})
        (root / "materials" / "policies").mkdir(parents=True)
        (root / "materials" / "policies" / "policy.json").write_text(policy.to_json(), "utf-8")
        for name, rows in _tables(people, policy).items():
            _table(root / file_of(name), [*dict.fromkeys((*COLUMNS.get(name, ()), *(rows[0] if rows else ())))], rows)


def _json(path: Path, content: Any) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=2) + "\n", "utf-8")


def _table(path: Path, names: Sequence[str], rows: Sequence[Mapping[str, Any]]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, names, restval="", lineterminator="\r\n")
        writer.writeheader()
        writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return "" if np.isnan(value) else repr(float(value)).removesuffix(".0")
    return str(value)


def _tables(people: Sequence[SimulatedRecord], policy: QTable) -> dict[str, list[dict[str, Any]]]:
    tables: dict[str, list[dict[str, Any]]] = {name: [] for name in (*COLUMNS, "cards")}
    for person in people:
        tables["participants"].append(_participant(person, policy))
        tables["cards"] += _cards(person)
        for row, hint in _flips(person):
            tables["flips"].append(row)
            if hint:
                tables["hints"].append(hint)
        for scale in SCALES:
            total = person.measures[f"{scale}_sum"]
            asked = {"participant_id": person.name, "questionnaire": "simulated", "scale": scale}
            tables["scores"].append(asked | {"sum": total, "mean": total / ITEMS, "items": ITEMS, "answered": ITEMS})
            scored = item_scores(int(total), np.random.default_rng([*f"{person.name}/{scale}".encode()]))
            for number, score in enumerate(scored, 1):
                answer = {"item": f"{scale}{number}", "kind": "likert", "value": score, "number": score}
                asked_for = {"reversed": False, "not_applicable": False, "not_shown": False}
                tables["answers"].append(asked | answer | {"scored": score} | asked_for)
    if people:
        tables["flow"].append({"quantity": "exported", "group": "", "count": len(people)})
    return tables


def item_scores(total: int, rng: np.random.Generator) -> list[int]:
    """Return scores from 1 to 5 of a scale's items, whose sum is ``total``: about equal, then moved apart."""
    each, rest = divmod(total, ITEMS)
    scores = [each + (at < rest) for at in range(ITEMS)]
    rng.shuffle(scores)
    # One move apart gives an alpha of about .7 to .8; more moves make the items unlike each other.
    up, down = rng.integers(ITEMS, size=2)
    if up != down and scores[up] < POINTS and scores[down] > 1:
        scores[up] += 1
        scores[down] -= 1
    return scores


def _participant(person: SimulatedRecord, policy: QTable) -> dict[str, Any]:
    fixed = {
        "condition": person.condition.name,
        "allocation_source": "list",
        "status": "completed",
        "last_stage": "thanks",
    }
    fixed["simulated"] = "true"
    done = {"game_completed": True, "resumed": 0, "pauses": 0, "pairs": PAIRS, "policy_sha256": policy.sha256}
    return {"participant_id": person.name} | fixed | done | person.measures


def _cards(person: SimulatedRecord) -> Iterator[dict[str, Any]]:
    for place in range(CARDS):
        picture = f"picture-{min(place, person.game.mates[place]):02}"
        row, column = divmod(place, BOARD_COLUMNS)
        yield {"participant_id": person.name, "board": BOARD, "stage": "game", "row": row + 1} | {
            "column": column + 1,
            "picture": picture,
        }


def _flips(person: SimulatedRecord) -> Iterator[tuple[dict[str, Any], dict[str, Any] | None]]:
    """Yield the rows of the tables of flips and hints."""
    game = person.game
    pace = round(person.measures["completion_ms"] / person.measures["flips"])
    for at, (place, action, target) in enumerate(game.flips):
        second = at % 2 == 1
        move = game.flips[at - at % 2 : at - at % 2 + 2]
        matched = game.mates[move[0][0]] == move[1][0] if len(move) > 1 else None
        helped = action != int(ActionSpec.NO_HELP)
        followed: Any = follows_hint(place, action, target) if helped else ""
        base = {"participant_id": person.name, "board": BOARD, "flip": at + 1, "followed": followed}
        base["move_card"] = "second" if second else "first"
        row, column = divmod(place, BOARD_COLUMNS)
        flip = {"stage": "game", "row": row + 1, "column": column + 1, "hinted": helped, "decision_ms": pace}
        flip["matched"] = matched if second else ""
        hint = {
            "action": ACTIONS[action].label,
            "target_row": target // BOARD_COLUMNS + 1,
            "target_column": target % BOARD_COLUMNS + 1,
            "move_matched": matched if matched is not None else "",
        }
        yield base | flip, (base | hint) if helped else None
