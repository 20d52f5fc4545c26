"""Every number that docs/explanation/learning.md and the policy cards give, made again, and whether each claim holds.

Two arms never share random numbers, so the interval of their difference is that of two independent samples. Tables of
different training seeds play the same games, so that what differs between them is the table alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, MoveOutcome, QTable
from kiosk.experiment.condition import Condition, target_rule
from kiosk.training import policies
from kiosk.training.learning import RECIPES, Averaging, Decisions, Learner, LearningRate, Recipe
from kiosk.training.rewards import Reward
from kiosk.training.simulated_players import ChancePlayer, MemoryPlayer, SimulatedPlayer, TextPlayer
from kiosk.training.simulation import T_CARD, Z95, GameResults, Progress, Spread, simulate_games


def _rule(condition: Condition) -> TargetRule:
    """Where first-card hints point in a condition that gives any."""
    return target_rule(condition.known, TargetRule.MOST_FLIPPED) or TargetRule.RANDOM


TOM, NOTOM = _rule(Condition.TOM), _rule(Condition.NOTOM)
FOLLOWED = {TOM: 0.92, NOTOM: 0.86}
"""The share of hints that the study's people followed."""
PAPER_UNAIDED, PAPER_ASSISTED, PAPER_PERFECT = (48.15, 7.55), (41.73, 8.83), (25.1, 3.7)
"""The paper's simulations: mean and SD of the moves."""
LEAST_SAVED = 2.0
AGREEMENT = 0.9
ASSISTANCE = (0.2, 0.36)
FIRST_CARD_HINTS = (2.0, 6.0)
DEGENERATE = 21.0
"""Moves below which a table does the player's work: the best memory needs 18.85."""
CLOSE, DISAGREE, LOTTERY = 0.3, 2.0, 5.0
"""Moves between seeds: up to which they agree, from which they disagree, from which a table is a matter of luck."""
FEWER = 5_000
"""Episodes that might do instead of 25,000."""
FEW = 0.4
"""First-card hints a game that have all but vanished."""


@dataclass(frozen=True, slots=True)
class CardArm:
    """One line of a policy card: who plays, and where hints point."""

    label: str
    player: SimulatedPlayer
    target: TargetRule


def _forgetting(d: float, follow: float = 1.0) -> MemoryPlayer:
    return MemoryPlayer((d, d), follow)


ARMS = (
    CardArm("chance .5, noToM", ChancePlayer(), NOTOM),
    *(
        CardArm(f"memory {d}, {name}", _forgetting(d), rule)
        for d in (0.15, 0.2, 0.25)
        for name, rule in (("noToM", NOTOM), ("ToM", TOM))
    ),
    CardArm("memory 0.2, most recent", _forgetting(0.2), TargetRule.MOST_RECENT),
    CardArm("memory 0.2, noToM, follows .86", _forgetting(0.2, FOLLOWED[NOTOM]), NOTOM),
    CardArm("memory 0.2, ToM, follows .92", _forgetting(0.2, FOLLOWED[TOM]), TOM),
    CardArm("text .12, noToM", TextPlayer(), NOTOM),
    CardArm("chance .5, ToM", ChancePlayer(), TOM),
)


@dataclass(frozen=True, slots=True)
class Claim:
    """One line of the evidence."""

    what: str
    expected: str
    measured: str
    holds: bool


@dataclass(frozen=True, slots=True)
class MoveSample:
    """Moves of many games, and what the paper reports beside them (mean and SD)."""

    label: str
    moves: tuple[float, ...]
    paper: tuple[float, float]


def measure_arm(policy: QTable, arm: CardArm, games: int, seed: int) -> GameResults:
    """Play one arm; every arm has random numbers of its own."""
    return simulate_games(policy, arm.player, arm.target, games, seed * 1000 + ARMS.index(arm))


def card_table(policy: QTable, rows: Sequence[tuple[CardArm, GameResults]], games: int, seed: int) -> str:
    """Return the numbers of a policy card, as a table in Markdown."""
    lines = [
        f"{policy.name}, sha256 {policy.sha256}",
        f"{games:,} games a line, seed {seed}; means with their normal 95 % intervals.",
        "",
        "| player | moves | SD | flips | assistance per flip | first-card hints a game |",
        "|---|---|---|---|---|---|",
    ]
    for arm, played in rows:
        numbers = (
            _mean(played.moves),
            f"{played.moves.sd:.2f}",
            _mean(played.flips),
            _mean(played.assistance, 3),
            _mean(played.first_card_hints),
        )
        lines.append(f"| {arm.label} | " + " | ".join(numbers) + " |")
    return "\n".join(lines)


def claims_table(claims: Sequence[Claim]) -> str:
    """Return the claims as a table in Markdown."""
    head = ["| claim | expected | measured | holds |", "|---|---|---|---|"]
    return "\n".join(
        head + [f"| {c.what} | {c.expected} | {c.measured} | {'yes' if c.holds else '**no**'} |" for c in claims]
    )


def figure_samples(games: int, seed: int) -> list[MoveSample]:
    """Return the three distributions of the paper's simulation figure."""
    default, none = QTable.named("default"), QTable.blank()
    return [
        MoveSample("no help, threshold .5", _moves(none, ChancePlayer(), games, seed), PAPER_UNAIDED),
        MoveSample("helped by the default table", _moves(default, ChancePlayer(), games, seed + 1), PAPER_ASSISTED),
        MoveSample("no help, threshold .10", _moves(none, ChancePlayer(0.1), games, seed + 2), PAPER_PERFECT),
    ]


def _moves(policy: QTable, player: SimulatedPlayer, games: int, seed: int) -> tuple[float, ...]:
    return tuple(flips / 2 for flips in simulate_games(policy, player, NOTOM, games, seed).each(0))


def gather_claims(games: int, seeds: int, seed: int, progress: Progress = lambda _: None) -> list[Claim]:
    """All claims, in the order of the docs; ``progress`` is called after each of the STEPS."""
    claims: list[Claim] = []
    for number, step in enumerate(_STEPS, 1):
        claims += step(games, seeds, seed)
        progress(number)
    return claims


def _players(games: int, _seeds: int, seed: int) -> list[Claim]:
    none = QTable.blank()
    expected: list[tuple[str, SimulatedPlayer, float, float | None, float, float]] = [
        ("chance .5", ChancePlayer(), 48.19, 7.57, 0.3, 0.2),
        ("chance .10", ChancePlayer(0.1), 25.18, 3.79, 0.3, 0.2),
        ("memory 0", _forgetting(0), 18.85, 0.81, 0.1, 0.1),
        ("memory .2", _forgetting(0.2), 30.5, 4.4, 0.3, 0.4),
        ("memory .45", _forgetting(0.45), 47.4, 10.8, 0.5, 0.4),
        ("text .12", TextPlayer(), 47.4, 10.7, 0.5, 0.6),
    ]
    claims = []
    for number, (label, player, mean, sd, near, near_sd) in enumerate(expected):
        moves = simulate_games(none, player, NOTOM, games, seed * 1000 + 100 + number).moves
        holds = abs(moves.mean - mean) <= near and abs(moves.sd - (sd or moves.sd)) <= near_sd
        wanted = f"{mean} (within {near}), SD {sd} (within {near_sd})"
        claims.append(
            Claim(f"moves of the {label} player, no help", wanted, f"{_mean(moves)}, SD {moves.sd:.2f}", holds)
        )
    return claims


def _literal(games: int, seeds: int, seed: int) -> list[Claim]:
    settled = replace(RECIPES[Reward.PAPER], alpha=LearningRate.VISITS, averaging=Averaging.LAST_HALF)
    played = [_chance(table, games, seed) for table in train_seeds(settled, seeds)]
    means = [g.moves.mean for g in played]
    cards = [g.total(T_CARD) / (g.total(0) / 2) for g in played]
    firsts = max(g.first_card_hints.mean for g in played)
    text = f"{_range(means)} moves, cards on {_range(cards, 2)} of second flips, first-card hints at most {firsts:.2f}"
    drift = [_chance(table, games, seed).moves.mean for table in train_seeds(RECIPES[Reward.PAPER], seeds)]
    return [
        Claim(
            "reward paper, decreasing alpha: degenerate",
            "below 21 moves, card hints",
            text,
            max(means) < DEGENERATE and firsts == 0,
        ),
        Claim(
            "reward paper, the paper's alpha: seeds disagree",
            "a spread",
            f"{_range(drift)} moves",
            max(drift) - min(drift) > DISAGREE,
        ),
    ]


def _lottery(games: int, seeds: int, seed: int) -> list[Claim]:
    recipe = RECIPES[Reward.RELEASED]
    rising = [_chance(table, games, seed).moves.mean for table in train_seeds(recipe, seeds)]
    nearest = 1 + min(range(seeds), key=lambda n: abs(rising[n] - PAPER_ASSISTED[0]))
    text = f"{_range(rising)} moves; nearest to {PAPER_ASSISTED[0]}: seed {nearest}"
    spread = max(rising) - min(rising)
    lottery = Claim(
        "reward released, released alpha: a lottery",
        f"seeds differ by more than {LOTTERY:g} moves",
        text,
        spread > LOTTERY,
    )
    settled = replace(recipe, alpha=LearningRate.VISITS, averaging=Averaging.LAST_HALF)
    return [lottery, *(_settled(replace(settled, decisions=kind), games, seeds, seed) for kind in Decisions)]


def _settled(recipe: Recipe, games: int, seeds: int, seed: int) -> Claim:
    played = [_chance(table, games, seed) for table in train_seeds(recipe, seeds)]
    means, firsts = [g.moves.mean for g in played], [g.first_card_hints.mean for g in played]
    return Claim(
        f"reward released, decreasing alpha, decisions {recipe.decisions.value}: settled",
        "seeds within .3 moves, 0 to .4 first-card hints a game",
        f"{_range(means)} moves, {_range(firsts, 2)} first-card hints",
        max(means) - min(means) <= CLOSE and max(firsts) <= FEW,
    )


def _default(games: int, _seeds: int, seed: int) -> list[Claim]:
    table = QTable.named("default")
    played = {arm.label: measure_arm(table, arm, games, seed) for arm in ARMS}
    chance = played["chance .5, noToM"]
    claims = []
    for label in (
        "chance .5, noToM",
        "chance .5, ToM",
        *(f"memory {d}, {c}" for d in (0.2, 0.25) for c in ("noToM", "ToM")),
    ):
        helped = played[label].assistance
        claims.append(
            Claim(f"(a) assistance per flip, {label}", ".20 to .36", _mean(helped, 3), _between(helped, ASSISTANCE))
        )
    for label in ("memory 0.2, noToM", "memory 0.25, noToM"):
        hints = played[label].first_card_hints
        claims.append(
            Claim(f"(b) first-card hints a game, {label}", "2 to 6", _mean(hints), _between(hints, FIRST_CARD_HINTS))
        )
    claims += _four_sentences(table, played)
    moves, bound = chance.moves, 0.9 * 48.19
    near = abs(moves.mean - PAPER_ASSISTED[0]) <= PAPER_ASSISTED[1]
    text = f"{_mean(moves)}, SD {moves.sd:.2f}"
    claims.append(
        Claim(
            "(d) moves of the helped chance player",
            f"below {bound:.2f}, 41.73 +- 8.83",
            text,
            near and moves.mean < bound,
        )
    )
    return claims + [_saved(played, d) for d in ("0.15", "0.2", "0.25")]


def _four_sentences(table: QTable, played: dict[str, GameResults]) -> list[Claim]:
    claims = []
    for label in ("chance .5, noToM", "memory 0.2, ToM"):
        rates = played[label].measures()["hint_rate"]
        text = f"hint rates {rates['first']:.2f} first, {rates['second']:.2f} second"
        said = policies.policy_claims(table, rates["first"], rates["second"])
        claims += [Claim(f"(c) {one.text}", "holds", f"{label}: {text}", one.holds) for one in said]
    return claims


def _saved(played: dict[str, GameResults], d: str) -> Claim:
    without, tom = played[f"memory {d}, noToM"], played[f"memory {d}, ToM"]
    low, saved, high = difference(without.flips, tom.flips, len(tom.tallies))
    less = tom.assistance.mean < without.assistance.mean
    levels = f"assistance {tom.assistance.mean:.3f} against {without.assistance.mean:.3f}"
    text = f"{saved:.2f} [{low:.2f}, {high:.2f}], {levels}"
    least = LEAST_SAVED if d == "0.2" else 0.0
    holds = saved >= least and low > 0 and less
    return Claim(
        f"(f) flips that ToM saves, memory {d}", f"at least {least:g}, interval above 0, less assistance", text, holds
    )


def difference(one: Spread, other: Spread, games: int) -> tuple[float, float, float]:
    """Return the difference of two means of ``games`` games each, between the ends of its normal 95 % interval."""
    half = Z95 * math.sqrt((one.sd**2 + other.sd**2) / games)
    between = one.mean - other.mean
    return between - half, between, between + half


def _seeds_agree(games: int, seeds: int, seed: int) -> list[Claim]:
    tables = train_seeds(RECIPES[Reward.RETRIEVAL], seeds)
    means = [_chance(table, games, seed).moves.mean for table in tables]
    near = max(means) - min(means) <= 1
    return [
        _alike("(e) seeds take the same greedy actions", tables),
        Claim("(e) moves of the chance player between seeds", "differ by at most 1", f"{_range(means)} moves", near),
    ]


def _alike(what: str, tables: Sequence[QTable]) -> Claim:
    between = [policies.compare_policies(one, other).agreement for i, one in enumerate(tables) for other in tables[:i]]
    shipped = QTable.named("default")
    same = sum(not policies.compare_policies(table, shipped).different for table in tables)
    text = f"{min(between):.2f} to {max(between):.2f}; {same} of {len(tables)} as the shipped table in every state"
    return Claim(what, "at least .90 of the visited states", text, min(between) >= AGREEMENT)


def _controls(_games: int, seeds: int, _seed: int) -> list[Claim]:
    blind = train_seeds(replace(RECIPES[Reward.RETRIEVAL], target=NOTOM), seeds)
    hints = max(_card_hints_on_first_cards(table) for table in blind)
    what = "trained with random targets: card hints on first cards"
    short = train_seeds(replace(RECIPES[Reward.RETRIEVAL], episodes=FEWER), seeds)
    return [
        Claim(what, "in no state", f"in at most {hints} states", hints == 0),
        _alike(f"{FEWER:,} episodes suffice", short),
    ]


def train_seeds(recipe: Recipe, seeds: int) -> list[QTable]:
    """Return the recipe's tables for the seeds 1 to ``seeds``."""
    tables = []
    for seed in range(1, seeds + 1):
        learner = Learner(replace(recipe, seed=seed))
        learner.study()
        tables.append(learner.freeze(f"{recipe.reward.value}-{seed}", ""))
    return tables


def _chance(table: QTable, games: int, seed: int) -> GameResults:
    return simulate_games(table, ChancePlayer(), NOTOM, games, seed)


def _card_hints_on_first_cards(table: QTable) -> int:
    firsts = [
        state for state in policies.visits(table) if state.outcome in (MoveOutcome.F_CORRECT, MoveOutcome.F_WRONG)
    ]
    return sum(table.action(state) is ActionSpec.SUG_CARD for state in firsts)


_STEPS: tuple[Callable[[int, int, int], list[Claim]], ...] = (
    _players,
    _literal,
    _lottery,
    _default,
    _seeds_agree,
    _controls,
)
STEPS = len(_STEPS)


def _mean(spread: Spread, decimals: int = 2) -> str:
    low, high = spread.ci95
    return f"{spread.mean:.{decimals}f} [{low:.{decimals}f}, {high:.{decimals}f}]"


def _between(spread: Spread, ends: tuple[float, float]) -> bool:
    return ends[0] <= spread.mean <= ends[1]


def _range(values: Sequence[float], decimals: int = 1) -> str:
    return f"{min(values):.{decimals}f} to {max(values):.{decimals}f}"
