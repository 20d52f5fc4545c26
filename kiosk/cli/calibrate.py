"""The command that estimates how the people of a study forget, follow and lapse."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.cli.options import json_option, progress_bar
from kiosk.files import check_writable, write_file


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
    """Estimate forgetting, following and lapses of the people in an exported DATASET.

    Mean and spread of forgetting, with intervals; see docs/calibrate.md.
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
    click.echo(_in_words(found, checked, study))
    for file in (out, page):
        if file is not None:
            click.echo(f"Written: {file}")


def _in_words(found: Any, checked: Any, study: Any) -> str:
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
