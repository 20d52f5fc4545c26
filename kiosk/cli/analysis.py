"""The commands of a study's analysis: calibrate players, plan, simulate, and report."""

from __future__ import annotations

import json
import os
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.cli.options import data_option, json_option, progress_bar
from kiosk.cli.terminal import tell_line
from kiosk.experiment.condition import Condition
from kiosk.export.new_files import new_folder, write_text
from kiosk.files import check_writable, write_file
from kiosk.store.plans import freeze_plan, frozen_plans, games_per_condition, record_look
from kiosk.training.simulated_players import PopulationPlayer


def analysis(module: str) -> Any:
    """Import a module of ``kiosk.analysis``; raises UserInputError where its libraries are not installed."""
    try:
        return import_module(f"kiosk.analysis.{module}")
    except ImportError as error:
        if (error.name or "").startswith("kiosk"):
            raise
        raise UserInputError(f'this needs {error.name}: pip install "recollect[analysis]"') from error


@click.command()
@click.argument("dataset", type=click.Path(path_type=Path))
@click.option("--player", type=click.Choice(["memory"]), default="memory", show_default=True, help="The model.")
@click.option(
    "--out", type=click.Path(path_type=Path, dir_okay=False), help="Write the people here, as JSON for --people."
)
@click.option(
    "--page", type=click.Path(path_type=Path, dir_okay=False), help="Write the checks here, as one HTML page."
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Fixes what the checks simulate.")
@json_option
def calibrate_command(
    dataset: Path, player: str, out: Path | None, page: Path | None, seed: int, *, as_json: bool
) -> None:
    """Estimate how the people in a DATASET forget and follow.

    It estimates forgetting (mean and spread), following and lapses, with intervals.
    """
    calibrate, checks = analysis("calibrate"), analysis("calibration_checks")
    for file in (out, page):
        if file is not None:
            check_writable(file)
    study = calibrate.read_games(dataset)
    found = calibrate.calibrate(study)
    with progress_bar("checking", hidden=as_json) as progress:
        checked = checks.check_calibration(study, found, seed, progress)
    document = {"model": player} | found.to_json() | {"left_out": study.left_out}
    if out is not None:
        write_file(out, json.dumps(document, indent=2) + "\n")
    if page is not None:
        write_file(page, checks.calibration_page(dataset.resolve().name, found, checked))
    if as_json:
        click.echo(json.dumps(document | checked.to_json()))
        return
    click.echo(_estimates_in_words(found, checked, study))
    for file in (out, page):
        if file is not None:
            tell_line(f"Written: {file}")


def _estimates_in_words(found: Any, checked: Any, study: Any) -> str:
    rows = {"forgetting, mean of the logit": found.mean, "forgetting, spread of the logit": found.spread}
    rows |= {"following": found.following, "lapse": found.lapse}
    lines = [f"{len(found.people)} games; left out, without a game: {study.left_out}."]
    for name, each in rows.items():
        if each is not None:
            lines.append(f"{name:<34}{each.value:>7.3f}   95 % interval {each.low:.3f} to {each.high:.3f}")
    lines += [
        f"{row.name:<48}data {row.observed:.3f}, simulated {row.low:.3f} to {row.high:.3f}" for row in checked.predicted
    ]
    if checked.ranks is not None:
        lines.append(f"rank histogram {' '.join(map(str, checked.ranks.counts))}, p = {checked.ranks.p:.2f}")
    lines += [f"warning: {warning}" for warning in found.warnings]
    return "\n".join(lines)


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
    """Plan a study before its first participant."""


@plan_group.command("new")
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False))
@json_option
def plan_new(file: Path, *, as_json: bool) -> None:
    """Write a plan of the paper's study, for you to change.

    Its defaults are modern ones.
    """
    if file.exists():
        raise UserInputError(f"{file} is there already; choose another name")
    write_file(file, analysis("plan").TEMPLATE)
    tell_line(json.dumps({"plan": str(file)}) if as_json else f"Written: {file}")


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
    tell_line(f"{plan} is a plan: {len(read.hypothesis)} hypotheses in {families} families, {read.n_per_arm} an arm.")
    for n, level in read.levels():
        click.echo(f"  at {n} an arm: two-sided p < {level:.5f}")
    click.echo(f"SHA-256 {sha256}")


@plan_group.command("show")
@plan_argument
@json_option
def plan_show(plan: Path, *, as_json: bool) -> None:
    """Print the preregistration in Markdown.

    It has the fields of OSF and AsPredicted.
    """
    module = analysis("plan")
    text = module.preregistration(module.StudyPlan.read(plan), module.plan_sha256(plan))
    click.echo(json.dumps({"preregistration": text}) if as_json else text, nl=as_json)


@plan_group.command("freeze")
@plan_argument
@data_option
@json_option
def plan_freeze(plan: Path, data: Path, *, as_json: bool) -> None:
    """Write the plan's hash and the time into the database.

    Do this before the first participant.
    """
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
    """Record a declared look at the data.

    It is refused before its number of participants is reached.
    """
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
    tell_line(json.dumps(told) if as_json else f"Look recorded at {per_arm} participants an arm.")


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
    """Write the data set of a simulated study.

    The commands report and calibrate read it.
    """
    read = analysis("plan").StudyPlan.read(plan)
    study = analysis("simulated_study")
    table, rule = QTable.named(policy), TargetRule(target)
    cells = [study.StudyCell(Condition(name), read.n_per_arm) for name in read.conditions]
    simulated = list(study.simulate_participants(table, _people(people), rule, cells, seed))
    study.write_dataset(out, simulated, table, rule, f"{read.title} (simulated)")
    told = {"out": str(out), "participants": len(simulated)}
    tell_line(json.dumps(told) if as_json else f"{len(simulated)} simulated participants are in {out}.")


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
    """Simulate studies under the plan to find its power.

    It counts how often each test finds an effect.
    """
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
    click.echo(json.dumps(document) if as_json else _plan_in_words(document))


def _people(file: Path | None) -> PopulationPlayer:
    return PopulationPlayer() if file is None else PopulationPlayer.load(file)


def _plan_in_words(document: dict[str, Any]) -> str:
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


PAGE = Path("report.html")


@click.command()
@click.argument("export", type=click.Path(path_type=Path), required=False)
@click.option(
    "--plan",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The plan; by default the one that was frozen with the data, or else the template.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    help=f"An HTML file, or a new folder for everything; by default {PAGE} unless --json is given.",
)
@click.option(
    "--exclude",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Declared exclusions: a CSV file with the columns participant_id and reason.",
)
@click.option("--paper", is_flag=True, help="Work the paper's own numbers out again; needs no EXPORT.")
@json_option
def report_command(
    export: Path | None, plan: Path | None, out: Path | None, exclude: Path | None, *, paper: bool, as_json: bool
) -> None:
    """Analyse an exported data set: tests, figures and tables.

    It says who took part and gives every test, and tables for a paper.
    """
    if export is None and not paper:
        raise UserInputError("a report needs the folder of an exported data set, or --paper")
    if export is None and (plan is not None or exclude is not None):
        raise UserInputError("--plan and --exclude are about a data set; name its folder")
    if out is None and not as_json:
        out = PAGE
    if out is not None and _is_page(out):
        check_writable(out)
    found = _analysed(export, plan, exclude) if export is not None else None
    document: dict[str, Any] = analysis("report").report_json(found) if found is not None else {}
    if paper:
        document["paper"] = analysis("paper").paper_json()
    if out is not None:
        pages = analysis("report_page")
        page = pages.report_page(found, with_paper=paper) if found is not None else pages.paper_page()
        _write(out, page, document)
    if as_json:
        click.echo(json.dumps(document))
        return
    click.echo(_report_in_words(document))
    tell_line(f"Written: {out}")


def _analysed(export: Path, plan: Path | None, exclude: Path | None) -> Any:
    declared = analysis("sample").read_exclusions(exclude) if exclude is not None else {}
    return analysis("report").make_report(analysis("data").load_study(export), plan, declared)


def _is_page(out: Path) -> bool:
    return out.suffix.lower() in {".html", ".htm"}


def _write(out: Path, page: Any, document: dict[str, Any]) -> None:
    """Write the page into its file, or the page, its parts and all numbers into a new folder."""
    module = analysis("page")
    if _is_page(out):
        write_file(out, module.to_html(page))
        return
    with new_folder(out) as folder:
        write_text(folder / "report.html", module.to_html(page))
        write_text(folder / "report.md", module.to_markdown(page))
        write_text(folder / "results.json", json.dumps(document, indent=1) + "\n")
        for table in module.tables(page):
            write_text(folder / "tables" / f"{table.id}.csv", module.csv_table(table))
            write_text(folder / "tables" / f"{table.id}.tex", module.latex_table(table) + "\n")
        for picture in module.all_pictures(page):
            write_text(folder / "figures" / f"{picture.id}.svg", picture.svg)


def _report_in_words(document: dict[str, Any]) -> str:
    if "status" not in document:
        rows = document["paper"]
        return "\n".join(f"{row['measure']:<28}t({row['df']}) = {row['t']:.2f}, p = {row['p']:.3f}" for row in rows)
    lines = [f"{document['status']}: {document['reason']}."]
    lines += [f"  {name}: {n} analysed" for name, n in document["analysed"].items()]
    for each in document["hypotheses"]:
        p = "" if each["corrected"] is None else f"corrected p = {each['corrected']:.4f}, "
        lines.append(f"{each['id']:<20}{p}{each['verdict']}")
    return "\n".join(lines)
