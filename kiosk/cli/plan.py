"""The commands of planning: write, check, preregister and freeze a plan, simulate its data, and its power."""

from __future__ import annotations

import json
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.cli.calibrate import analysis
from kiosk.cli.options import data_option, json_option, progress_bar
from kiosk.experiment.condition import Condition
from kiosk.files import check_writable, write_file
from kiosk.store.plans import freeze_plan, frozen_plans, games_per_condition, record_look
from kiosk.training.simulated_players import PopulationPlayer

LARGEST_SIZE = 10_000

plan_argument = click.argument("plan", type=click.Path(path_type=Path, dir_okay=False))
people_option = click.option(
    "--people",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The people who are simulated; recollect calibrate writes such a file.",
)
policy_option = click.option("--policy", default="default", show_default=True, help="The table that helps them.")
rule_option = click.option(
    "--target",
    type=click.Choice([rule.value for rule in TargetRule]),
    default=TargetRule.MOST_FLIPPED.value,
    show_default=True,
    help="The rule of mentalised targets.",
)
seed_option = click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Fixes all chance.")


@click.group()
def plan_group() -> None:
    """Plan a study before its first participant; see docs/plan.md."""


@plan_group.command("new")
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False))
@json_option
def plan_new(file: Path, *, as_json: bool) -> None:
    """Write a plan to begin with: the paper's study with modern defaults."""
    if file.exists():
        raise UserInputError(f"{file} is there already; choose another name")
    write_file(file, analysis("plan").TEMPLATE)
    click.echo(json.dumps({"plan": str(file)}) if as_json else f"Written: {file}")


@plan_group.command("check")
@plan_argument
@json_option
def plan_check(plan: Path, *, as_json: bool) -> None:
    """Check a plan, and say what it declares."""
    module = analysis("plan")
    read = module.StudyPlan.read(plan)
    sha256 = module.plan_sha256(plan)
    if as_json:
        levels = [{"per_arm": n, "level": level} for n, level in read.levels()]
        click.echo(json.dumps({"sha256": sha256, "plan": read.model_dump(mode="json"), "levels": levels}))
        return
    families = len({each.family for each in read.hypothesis})
    click.echo(f"{plan} is a plan: {len(read.hypothesis)} hypotheses in {families} families, {read.n_per_arm} an arm.")
    for n, level in read.levels():
        click.echo(f"  at {n} an arm: two-sided p < {level:.5f}")
    click.echo(f"SHA-256 {sha256}")


@plan_group.command("show")
@plan_argument
@json_option
def plan_show(plan: Path, *, as_json: bool) -> None:
    """Print the preregistration in Markdown, with the fields of OSF and AsPredicted."""
    module = analysis("plan")
    text = module.preregistration(module.StudyPlan.read(plan), module.plan_sha256(plan))
    click.echo(json.dumps({"preregistration": text}) if as_json else text, nl=as_json)


@plan_group.command("freeze")
@plan_argument
@data_option
@json_option
def plan_freeze(plan: Path, data: Path, *, as_json: bool) -> None:
    """Write the plan's hash and the time into the database, before the first participant."""
    module = analysis("plan")
    module.StudyPlan.read(plan)
    frozen = freeze_plan(data, module.plan_sha256(plan), plan.read_bytes().decode("utf-8"))
    told = f"Frozen in {data} at {frozen.frozen_at}: {frozen.sha256}"
    document = {"sha256": frozen.sha256, "frozen_at": frozen.frozen_at}
    click.echo(json.dumps(document) if as_json else told)


@plan_group.command("look")
@plan_argument
@data_option
@json_option
def plan_look(plan: Path, data: Path, *, as_json: bool) -> None:
    """Record a declared look at the data; refused before its number of participants is reached."""
    module = analysis("plan")
    read = module.StudyPlan.read(plan)
    sha256 = module.plan_sha256(plan)
    if all(frozen.sha256 != sha256 for frozen in frozen_plans(data)):
        raise UserInputError(
            f"{plan} is not frozen in {data}: recollect plan freeze comes before the first participant"
        )
    per_arm = min(games_per_condition(data, read.conditions)[name] for name in read.conditions)
    read.refuse_before_look(per_arm)
    record_look(data, sha256, per_arm)
    level = [level for n, level in read.levels() if n <= per_arm][-1:]
    told = {"per_arm": per_arm, "level": level[0] if level else None}
    click.echo(json.dumps(told) if as_json else f"Look recorded at {per_arm} participants an arm.")


@plan_group.command("simulate")
@plan_argument
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The new folder of the data set.")
@people_option
@policy_option
@rule_option
@seed_option
@json_option
def plan_simulate(
    plan: Path, out: Path, people: Path | None, policy: str, target: str, seed: int, *, as_json: bool
) -> None:
    """Write the data set of a simulated study, which report and calibrate read."""
    read = analysis("plan").StudyPlan.read(plan)
    study = analysis("simulated_study")
    table, rule = QTable.named(policy), TargetRule(target)
    cells = [study.StudyCell(Condition(name), read.n_per_arm) for name in read.conditions]
    simulated = list(study.simulate_participants(table, _people(people), rule, cells, seed))
    study.write_dataset(out, simulated, table, rule, f"{read.title} (simulated)")
    told = {"out": str(out), "participants": len(simulated)}
    click.echo(json.dumps(told) if as_json else f"{len(simulated)} simulated participants are in {out}.")


class Sizes(click.ParamType[tuple[int, ...]]):
    """Participants an arm: ``56``, or ``28:120:4`` from, to and step."""

    name = "n or from:to:step"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, ...]:
        """Read one number or three."""
        try:
            first, *rest = (int(part) for part in str(value).split(":"))
            last, step = rest or (first, 1)
            sizes = tuple(range(first, last + 1, step))
        except ValueError:
            sizes = ()
        if not sizes or sizes[0] < 3 or sizes[-1] > LARGEST_SIZE:  # noqa: PLR2004 - no variance from fewer
            self.fail(
                f"{value!r} is neither a number from 3 to {LARGEST_SIZE} nor a range such as 28:120:4", param, ctx
            )
        return sizes


@plan_group.command("power")
@plan_argument
@click.option(
    "--n", "sizes", type=Sizes(), help="Participants an arm; the plan's looks or its n unless told otherwise."
)
@people_option
@click.option("--studies", type=click.IntRange(10, 1_000_000), default=2000, show_default=True, help="How many.")
@click.option("--null", is_flag=True, help="Simulate without any effect: the type I error.")
@click.option("--workers", type=click.IntRange(1, 1024), help="Processes of this machine; one for each core.")
@click.option("--scheduler", default="", help="A running Dask scheduler, tcp://HOST:PORT, instead of processes.")
@click.option(
    "--store", type=click.Path(path_type=Path, dir_okay=False), help="Where finished blocks are kept, to go on later."
)
@click.option("--curve", type=click.Path(path_type=Path, dir_okay=False), help="Draw the power over n here (.svg).")
@policy_option
@rule_option
@seed_option
@json_option
def plan_power(
    plan: Path,
    sizes: tuple[int, ...] | None,
    people: Path | None,
    studies: int,
    workers: int | None,
    scheduler: str,
    store: Path | None,
    curve: Path | None,
    policy: str,
    target: str,
    seed: int,
    *,
    null: bool,
    as_json: bool,
) -> None:
    """Simulate whole studies under the plan, and count how often each test finds an effect."""
    read = analysis("plan").StudyPlan.read(plan)
    power = analysis("power")
    if curve is not None:
        check_writable(curve)
    sizes = sizes or (read.sequential.looks if read.sequential else (read.n_per_arm,))
    player = _people(people).parameters()
    del player["name"]
    table = QTable.named(policy)
    job = power.PowerJob(read.model_dump_json(), table.to_json(), target, player, sizes, studies, seed, null)
    store = store or plan.with_suffix(f".{job.key[:8]}.blocks")
    check_writable(store)
    with progress_bar("blocks", job.blocks, hidden=as_json) as progress:
        signed = power.run(job, store, workers or os.cpu_count() or 1, scheduler, progress)
    rows = power.summarise(job, signed)
    document: dict[str, Any] = {
        "studies": studies,
        "null": null,
        "store": str(store),
        "rows": [asdict(r) for r in rows],
    }
    document["smallest_n"] = {name: power.smallest_n(rows, name) for name in dict.fromkeys(row.test for row in rows)}
    if read.sequential is not None and sizes == read.sequential.looks:
        found = power.sequential_rejections(job, signed)
        document["sequential"] = {name: {"rejected": r, "mean_n": n} for name, (r, n) in found.items()}
    if curve is not None:
        write_file(curve, power.curve(rows))
    click.echo(json.dumps(document) if as_json else _in_words(document))


def _people(file: Path | None) -> PopulationPlayer:
    return PopulationPlayer() if file is None else PopulationPlayer.load(file)


def _in_words(document: dict[str, Any]) -> str:
    what = "type I error" if document["null"] else "power"
    lines = [
        f"{document['studies']} studies; {what} raw and corrected",
        f"{'test':<36}{'n':>6}{'raw':>8}{'corrected':>11}",
    ]
    lines += [f"{r['test']:<36}{r['n']:>6}{r['rejected']:>8.3f}{r['corrected']:>11.3f}" for r in document["rows"]]
    if not document["null"]:
        for name, n in document["smallest_n"].items():
            lines.append(f"smallest n an arm for a power of .8, {name}: {n or 'more than was simulated'}")
    for name, found in document.get("sequential", {}).items():
        lines.append(f"with looks, {name}: {found['rejected']:.3f}, stopped at {found['mean_n']:.1f} an arm on average")
    lines.append(f"Finished blocks are in {document['store']}.")
    return "\n".join(lines)
