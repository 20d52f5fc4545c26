"""The command that writes the data set."""

from __future__ import annotations

import json
from pathlib import Path

import click

from kiosk.cli.options import json_option, sittings_data_option
from kiosk.cli.progress import progress_bar
from kiosk.store.dataset.export import export as write
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.layouts.bids import Bids
from kiosk.store.dataset.layouts.psych_ds import PsychDs


@click.command()
@sittings_data_option
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The folder to write; new, or empty.")
@click.option("--bids", is_flag=True, help="Names like those of BIDS, instead of Psych-DS.")
@click.option("--with-dates", is_flag=True, help="Also when each sitting began.")
@click.option("--with-rehearsals", is_flag=True, help="Also rehearsals, told apart by a column.")
@click.option("--with-trials", is_flag=True, help="Also sittings without a PIN, told apart by a column.")
@click.option("--with-texts", is_flag=True, help="Also what people typed; it may name somebody.")
@click.option("--with-unshared", is_flag=True, help="Also who did not agree to publishing; then keep it to yourself.")
@json_option
def export(data: Path, out: Path, *, bids: bool, as_json: bool, **also: bool) -> None:
    """Write a data set for publishing: every table with a codebook, as Psych-DS asks for."""
    extras = frozenset(extra for extra in Extra if also[f"with_{extra.value}"])
    with progress_bar("sittings", hidden=as_json) as bar:
        exported = write(data, out, Bids if bids else PsychDs, extras, bar)
    if as_json:
        click.echo(json.dumps({"out": str(out)} | exported.to_json()))
        return
    click.echo(f"The data set in {out} holds {exported.participants} sittings.")
    if exported.not_shared:
        click.echo(f"Left out, as their visitors did not agree to publishing: {exported.not_shared}.")
    if exported.under_way:
        click.echo(f"Left out, as they are still under way: {exported.under_way}.")
    if exported.trials:
        click.echo(f"Left out, as no PIN was set, so that they were trials: {exported.trials}.")
    for caution in exported.cautions:
        click.echo(f"caution: {caution}")
