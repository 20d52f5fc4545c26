"""The commands that learn and play: train and simulate."""

from __future__ import annotations

import json
import math
import shlex
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, astuple, fields, replace
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.assistance.memory_model import MemoryTiming
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, NO_GATE, ActionSpec, Gate, QTable, check_actions, find_action
from kiosk.cli.options import progress_bar
from kiosk.cli.terminal import tell_line
from kiosk.config import KNOWN_CONDITIONS, AssistanceConfig
from kiosk.experiment.condition import Condition, target_rule
from kiosk.files import check_writable, write_file
from kiosk.training import simulation
from kiosk.training.learning import CHOICES, RECIPES, Averaging, Decisions, Exploration, Learner, LearningRate, Recipe
from kiosk.training.memory_timing import TimingExperiment, best_timing, checked_timing, timing_grid
from kiosk.training.rewards import Reward
from kiosk.training.simulated_players import (
    ChancePlayer,
    Counting,
    MemoryPlayer,
    PopulationPlayer,
    SimulatedPlayer,
    TextPlayer,
)
from kiosk.training.vectorised_game import is_slow

STOPPED = 130
"""The exit code after Ctrl-C."""
GATES = {"on": Gate(), "off": NO_GATE}
_PLAYERS: dict[str, SimulatedPlayer] = {
    player.name: player for player in (ChancePlayer(), MemoryPlayer(), TextPlayer(), PopulationPlayer())
}


class Forgetting(click.ParamType[tuple[float, float]]):
    """A chance to forget, or a range of it: ``.2`` or ``.1:.45``."""

    name = "number or low:high"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, float]:
        """Read one number or two."""
        if isinstance(value, tuple):
            return value
        try:
            low, _, high = str(value).partition(":")
            return float(low), float(high or low)
        except ValueError:
            self.fail(f"{value!r} is neither a number nor a range such as .1:.45", param, ctx)


def _choice(kind: Any) -> click.Choice[str]:
    return click.Choice([member.value for member in kind])


def _options(*options: Callable[..., Any]) -> Callable[[Any], Any]:
    def add(function: Any) -> Any:
        for option in reversed(options):
            function = option(function)
        return function

    return add


as_json = click.option("--json", "json_", is_flag=True, help="Print one JSON object and nothing else.")
player_options = _options(
    click.option("--player", type=click.Choice(list(_PLAYERS)), help="Who plays."),
    click.option("--threshold", type=float, help="Chance player: from which chance on it may remember (.5)."),
    click.option(
        "--forgetting", type=Forgetting(), help="Memory player: forgotten per flip (.2), or a range. Text player: .12."
    ),
    click.option("--counting", type=_choice(Counting), help="Text player: what NF counts (since_match)."),
    click.option("--follow", type=float, help="The chance to follow a hint (1)."),
    click.option("--lapse", type=float, help="Memory player, people: the chance to take any card (0)."),
    click.option("--forgetting-mean", type=float, help="People: the mean of the logit of forgetting (-1.4)."),
    click.option("--forgetting-spread", type=float, help="People: the SD of the logit of forgetting (.5)."),
    click.option(
        "--people",
        type=click.Path(path_type=Path, dir_okay=False),
        help="The people of this file, which recollect calibrate wrote.",
    ),
)


def player_from_options(
    base: SimulatedPlayer, player: str | None, people: Path | None = None, **given: Any
) -> SimulatedPlayer:
    """Return the player that the options describe; what they leave out is as in ``base`` or in that player's nature."""
    if people is not None:
        if player not in {None, PopulationPlayer.name}:
            raise UserInputError(f"the people of {people} are no {player} player: leave out --player, or --people")
        base, player = PopulationPlayer.load(people), None
    start = base if player in (None, base.name) else _PLAYERS[player or ""]
    wanted = {name: value for name, value in given.items() if value is not None}
    known = {field.name for field in fields(start)}  # type: ignore[arg-type]  # every player is a dataclass
    foreign = sorted(wanted.keys() - known)
    if foreign:
        raise UserInputError(f"the {start.name} player has no --{foreign[0].replace('_', '-')}")
    if "counting" in wanted:
        wanted["counting"] = Counting(wanted["counting"])
    if isinstance(start, TextPlayer) and "forgetting" in wanted:
        wanted["forgetting"] = _one_number(wanted["forgetting"])
    seated: SimulatedPlayer = replace(start, **wanted)  # type: ignore[type-var]  # as above
    return seated


_PLAYER_OPTIONS = (
    *("player", "people", "threshold", "forgetting", "counting", "follow"),
    *("lapse", "forgetting_mean", "forgetting_spread"),
)


def _one_number(forgetting: tuple[float, float]) -> float:
    if forgetting[0] != forgetting[1]:
        raise UserInputError("the text player's --forgetting is one number, not a range")
    return forgetting[0]


@contextmanager
def ctrl_c() -> Iterator[Callable[[], bool]]:
    """Whether Ctrl-C was pressed, instead of being torn out of whatever is under way; heard in the background too."""
    pressed: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: pressed.append(number))
    try:
        yield lambda: bool(pressed)
    finally:
        signal.signal(signal.SIGINT, before)


def say_if_slow(*, hidden: bool) -> None:
    """Say on standard error that there is nothing to compile the rules with, and what to install."""
    if is_slow() and not hidden:
        click.echo(
            "There is no C compiler, so the games run in plain Python, which is slow. The numbers are the same.\n"
            'To make them faster, install gcc or the extra "fast" of Recollect.',
            err=True,
        )


@click.command()
@click.option(
    "--reward", type=_choice(Reward), default="retrieval", show_default=True, help="What the robot is paid for."
)
@player_options
@click.option("--episodes", type=int, help="Games to learn from (retrieval and paper 25000, released 100000).")
@click.option("--seed", type=int, default=1, show_default=True, help="Fixes everything random.")
@click.option("--epsilon", type=_choice(Exploration), help="How often to try an action at random.")
@click.option("--alpha", type=_choice(LearningRate), help="The learning rate.")
@click.option("--averaging", type=_choice(Averaging), help="Which table is frozen.")
@click.option("--decisions", type=_choice(Decisions), help="Which flips are learnt from.")
@click.option("--target", type=_choice(TargetRule), help="Where first-card hints point in training.")
@click.option("--gamma", type=float, help="The discount per flip (.8).")
@click.option("--gate", type=click.Choice(list(GATES)), help="Whether hints wait for the gate (on).")
@click.option("--action", "actions", multiple=True, help="An action of a package, besides the usual four; repeatable.")
@click.option("--name", help="The table's name (the name of the file).")
@click.option(
    "--out", type=click.Path(path_type=Path, dir_okay=False), required=True, help="Where to write the policy file."
)
@click.option(
    "--timing",
    type=click.Choice(["table", "model"]),
    default="table",
    show_default=True,
    help="What is learnt: a table, or the thresholds of timing by the model of memory, written as a part of a study "
    "file.",
)
@click.option("--games", type=int, help="With --timing model: games for each pair of thresholds (300).")
@click.option("--assistance", type=float, help="With --timing model: the most assistance per flip (.175).")
@click.option("--spread", type=float, help="With --timing model: the most SD of the flips a game (none).")
@as_json
def train_command(out: Path, name: str | None, reward: str, json_: bool, **options: Any) -> None:  # noqa: FBT001 - click's flag
    """Train a table and freeze it.

    The defaults of the other options depend on the reward.
    """
    timing, games, assistance, spread = (options.pop(name) for name in ("timing", "games", "assistance", "spread"))
    if timing == "model":
        limits = MOST_ASSISTANCE if assistance is None else assistance, math.inf if spread is None else spread
        _tune_thresholds(out, games, limits, json_=json_, **options)
        return
    if (games, assistance, spread) != (None, None, None):
        raise UserInputError("--games, --assistance and --spread are for --timing model only")
    recipe = recipe_of(Reward(reward), **options)
    name = name or out.stem
    check_writable(out)
    say_if_slow(hidden=json_)
    learner = Learner(recipe)
    with progress_bar("training", recipe.episodes, hidden=json_) as progress, ctrl_c() as pressed:
        learner.study(progress, pressed)
    if learner.episodes < recipe.episodes:
        _leave_checkpoint(learner, name, out)
    table = learner.freeze(name, train_command_line(recipe, name))
    write_file(out, table.to_json())
    say(
        {"policy": name, "file": str(out), "episodes": learner.episodes, "sha256": table.sha256},
        f"{out}: the table {name!r} after {learner.episodes:,} episodes, sha256 {table.sha256}",
        json_=json_,
    )


GAMES_TO_TUNE, MOST_ASSISTANCE = 300, 0.175
_TUNES = {"seed", "target", "gate", *_PLAYER_OPTIONS}


def _tune_thresholds(out: Path, games: int | None, limits: tuple[float, float], *, json_: bool, **options: Any) -> None:
    """Try thresholds, and write the best within ``limits`` as the part of a study file that declares them."""
    foreign = sorted(name for name, value in options.items() if value not in (None, ()) and name not in _TUNES)
    if foreign:
        raise UserInputError(f"--{foreign[0]} is for a table; --timing model learns thresholds")
    player = player_from_options(PopulationPlayer(), **{name: options[name] for name in _PLAYER_OPTIONS})
    gate, target = GATES[options["gate"] or "on"], TargetRule(options["target"] or TargetRule.MOST_FLIPPED.value)
    games = GAMES_TO_TUNE if games is None else games
    check_writable(out)
    experiment, timings = TimingExperiment(gate, player, target, games, options["seed"]), timing_grid()
    with progress_bar("tuning", len(timings) * games, hidden=json_) as progress:
        tried = list(experiment.tune(timings, progress))
    best = best_timing(tried, *limits)
    best_at = dict(zip(_THRESHOLDS, astuple(best.timing), strict=True))
    lines = "".join(f"{name} = {value:g}\n" for name, value in best_at.items())
    write_file(out, f'[assistance]\ntiming = "model"\n{lines}')
    measures = best.results.measures()
    told = {"file": str(out), **best_at, **measures}
    flips, given = best.results.flips, best.results.assistance.mean
    say(
        told,
        f"{out}: help below {best.timing.first:g} and {best.timing.second:g}, a seen card is named below "
        f"{best.timing.card:g}, all from {best.timing.flips} flips on; {flips.mean:.1f} flips (SD {flips.sd:.1f}), "
        f"assistance {given:.3f} a flip",
        json_=json_,
    )


def _leave_checkpoint(learner: Learner, name: str, out: Path) -> None:
    if learner.episodes == 0:
        click.echo("recollect: stopped before the first episodes were through; nothing was written", err=True)
        sys.exit(STOPPED)
    beside = out.with_suffix(f".checkpoint{out.suffix}")
    write_file(beside, learner.freeze(name, train_command_line(learner.recipe, name)).to_json())
    tell_line(
        f"recollect: stopped after {learner.episodes:,} of {learner.recipe.episodes:,} episodes; "
        f"what is known so far is a usable policy in {beside}, and {out} is as it was",
        err=True,
    )
    sys.exit(STOPPED)


def recipe_of(reward: Reward, **options: Any) -> Recipe:
    """Return the reward's recipe with what the options change."""
    base = RECIPES[reward]
    seated = {name: options.pop(name) for name in _PLAYER_OPTIONS}
    given = {name: value for name, value in options.items() if value is not None}
    for name in given.keys() & CHOICES.keys():
        given[name] = CHOICES[name](given[name])
    if "gate" in given:
        given["gate"] = GATES[given["gate"]]
    if added := given.pop("actions", ()):
        given["actions"] = _with_usual(added)
    return replace(base, player=player_from_options(base.player, **seated), **given)


def _with_usual(names: Sequence[str]) -> tuple[ActionSpec, ...]:
    """Return the usual four actions and those of these names; raises UserInputError if there can be no such set."""
    try:
        return check_actions([*ACTIONS, *map(find_action, names)])
    except ValueError as error:
        raise UserInputError(f"--action: {error}") from error


def train_command_line(recipe: Recipe, name: str) -> str:
    """Return the command that makes this table again, without ``--out``."""
    player = recipe.player.parameters()
    words = {"reward": recipe.reward.value, "player": player.pop("name")}
    words |= {key: _word(value) for key, value in player.items() if (key, value) != ("follow", 1.0)}
    words |= {"episodes": str(recipe.episodes), "seed": str(recipe.seed)}
    base = RECIPES[recipe.reward]
    for key in ("epsilon", "alpha", "averaging", "decisions", "target"):
        if getattr(recipe, key) is not getattr(base, key):
            words[key] = getattr(recipe, key).value
    if recipe.gamma != base.gamma:
        words["gamma"] = _word(recipe.gamma)
    if recipe.gate != base.gate:
        words["gate"] = "off"
    added = [f"--action {action.label}" for action in recipe.actions if action not in ACTIONS]
    return " ".join(
        [
            "recollect train",
            *(f"--{key.replace('_', '-')} {value}" for key, value in words.items()),
            *added,
            f"--name {shlex.quote(name)}",
        ]
    )


def _word(value: Any) -> str:
    return ":".join(map(repr, value)) if isinstance(value, list) else str(value)


def say(document: dict[str, Any], text: str, *, json_: bool) -> None:
    """Print the document as JSON, or else the text."""
    click.echo(json.dumps(document) if json_ else text)


@click.command()
@player_options
@click.option(
    "--policy", "name", default="default", show_default=True, help="A file, default, study-like, no-help or none."
)
@click.option(
    "--condition",
    type=click.Choice([*KNOWN_CONDITIONS]),
    default="tom",
    show_default=True,
    help="Where hints point.",
)
@click.option("--target", type=_choice(TargetRule), help="Another target rule than the condition's.")
@click.option("--games", type=int, default=5000, show_default=True, help="How many games.")
@click.option("--seed", type=int, default=1, show_default=True, help="Fixes everything random.")
@click.option(
    "--timing",
    type=click.Choice(["table", "model"]),
    default="table",
    show_default=True,
    help="What decides when to help, as in a study file.",
)
@click.option("--threshold-first", type=float, help="With --timing model: help with first cards below this (.2).")
@click.option("--threshold-second", type=float, help="With --timing model: help with second cards below this (.2).")
@click.option("--threshold-card", type=float, help="With --timing model: name a seen second card below this (.05).")
@click.option("--threshold-flips", type=int, help="With --timing model: no help before so many flips (24).")
@as_json
def simulate_command(
    name: str,
    condition: str,
    target: str | None,
    games: int,
    seed: int,
    json_: bool,  # noqa: FBT001 - click's flag
    **options: Any,
) -> None:
    """Play games with a simulated player under a frozen table.

    It prints the measures of the study.
    """
    where = target_rule(Condition(condition).known, TargetRule.MOST_FLIPPED)
    table = QTable.named(name) if where else QTable.blank()
    timing = _timing(*(options.pop(name) for name in ("timing", *_THRESHOLDS)))
    player = player_from_options(ChancePlayer(), **options)
    rule = TargetRule(target) if target else where or TargetRule.RANDOM
    say_if_slow(hidden=json_)
    with progress_bar("playing", games, hidden=json_) as progress:
        if timing is None or where is None:
            played = simulation.simulate_games(table, player, rule, games, seed, progress)
        else:
            played = TimingExperiment(table.gate, player, rule, games, seed).play(timing, progress)
    measures = played.measures() | ({"timing": asdict(timing)} if timing and where else {})
    asked = {"player": player.parameters(), "policy": table.name, "policy_sha256": table.sha256, "seed": seed}
    say(asked | {"condition": condition, "target": rule.value} | measures, _told(measures), json_=json_)


_THRESHOLDS = ("threshold_first", "threshold_second", "threshold_card", "threshold_flips")


def _timing(timing: str, *given: float | None) -> MemoryTiming | None:
    """Return the timing by memory that the options ask for; None for that by a table."""
    if timing == "table":
        if any(each is not None for each in given):
            raise UserInputError("--threshold-first, -second, -card and -flips are for --timing model only")
        return None
    usual = AssistanceConfig()
    thresholds = zip(_THRESHOLDS, given, strict=True)
    values: list[Any] = [getattr(usual, name) if each is None else each for name, each in thresholds]
    return checked_timing(*values)


def _told(measures: dict[str, Any]) -> str:
    lines = [f"{'games':<28}{measures['games']:,}"]
    measures |= measures["spreads"]
    for name in ("moves", "flips", "assistance_per_flip", "first_card_hints_per_game"):
        spread = measures[name]
        low, high = spread["ci95"]
        text = f"mean {spread['mean']:.3f}  sd {spread['sd']:.3f}  95 % interval {low:.3f} to {high:.3f}"
        lines.append(f"{name.replace('_', ' '):<28}{text}")
    lines += [f"{f'hint rate, {card} card':<28}{rate:.3f}" for card, rate in measures["hint_rate"].items()]
    shares = {
        "followed_first_card": "followed, first card",
        "followed": "followed, all",
        "led_to_match": "led to match",
    }
    lines += [f"{name:<28}{_share_told(measures, share)}" for share, name in shares.items()]
    return "\n".join(lines)


def _share_told(measures: dict[str, Any], share: str) -> str:
    if measures[share] is None:
        return "no hints"
    games, pooled = measures["games_with"][share], measures["pooled"][share]
    return f"mean {measures[share]:.3f} over {games:,} games with such hints; pooled over all hints {pooled:.3f}"
