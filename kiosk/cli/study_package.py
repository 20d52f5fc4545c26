"""Commands that make one file of a study, and that compare two studies."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import click

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option
from kiosk.cli.terminal import one_line, tell_line
from kiosk.robots.registry import check_robot
from kiosk.study.comparison import Impact, compare
from kiosk.study.loader import read_study
from kiosk.study.package import (
    ENDING,
    LOCAL_ENDING,
    CannotVerify,
    Signature,
    is_package,
    pack,
    sign,
    signature_file,
    verify_signature,
    write_package,
)

DIFFERENT = 1
"""The exit code when two studies are not the same."""


@click.command("pack")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--out", type=click.Path(path_type=Path), help=f"The file to write; by default FILE with {ENDING}.")
@click.option("--sign", "key", type=click.Path(path_type=Path), help="Sign it with this SSH key.")
@json_option
def pack_command(file: Path, out: Path | None, key: Path | None, *, as_json: bool) -> None:
    """Pack a study FILE and all files that it names into one.

    It prints the file's SHA-256. The same study gives the same bytes. The kiosk runs the packed file as it is. The
    PIN, the robot's address and other settings of one kiosk are not packed; write them into a file of the same
    name that ends in .local.toml.
    """
    out = out or file.with_suffix(ENDING)
    study = read_study(read_settings(file))
    check_robot(study.settings)
    package = pack(study.settings, study.sources)
    write_package(package, out)
    signature = sign(out, key) if key else None
    if as_json:
        told = {"file": str(out), "sha256": package.sha256, "bytes": len(package.content), "files": [*package.files]}
        click.echo(json.dumps(told | {"signature": str(signature) if signature else None}))
        return
    tell_line(f"{package.sha256}  {out}")
    click.echo(f"{len(package.files)} files of the study's own, {len(package.content):,} bytes.", err=True)
    if signature:
        tell_line(f"Its signature is {signature}.", err=True)
    if study.settings.experimenter.pin_hash:
        local = out.with_suffix(LOCAL_ENDING)
        tell_line(f"The PIN is not in it: put [experimenter] into {local} on each kiosk.", err=True)


@click.command("diff")
@click.argument("one", type=click.Path(path_type=Path))
@click.argument("other", type=click.Path(path_type=Path))
@json_option
@click.pass_context
def diff_command(context: click.Context, one: Path, other: Path, *, as_json: bool) -> None:
    """Show how the studies ONE and OTHER differ.

    It also says whether the difference can change the data. The exit code is 1 if they differ.
    """
    studies = [read_study(read_settings(file)) for file in (one, other)]
    found = compare(*studies)
    if as_json:
        rows = [asdict(each) | {"impact": each.impact.name.lower()} for each in found]
        hashes = [study.sha256 for study in studies]
        click.echo(json.dumps({"sha256": hashes, "same": not found, "differences": rows}))
    else:
        for impact in Impact:
            some = [each for each in found if each.impact is impact]
            if some:
                click.echo(f"{impact.value}:")
            for each in some:
                click.echo(f"  {one_line(f'{each.where}: {each.what} ({each.effect})')}")
        if not found:
            same = studies[0].sha256 == studies[1].sha256
            click.echo("The studies are the same." if same else "Nothing differs that sessions follow.")
    context.exit(DIFFERENT if found else 0)


def signature_of(file: Path, allowed_signers: Path | None) -> tuple[Signature | None, list[str]]:
    """Return the signature of a packed study, and a caution where it cannot be verified; raises UserInputError."""
    if not is_package(file):
        if allowed_signers is not None:
            raise UserInputError(f"{file} is no packed study, so it cannot be signed; 'recollect study pack' makes one")
        return None, []
    try:
        signature = verify_signature(file, allowed_signers)
    except CannotVerify as error:
        return None, [f"the signature {signature_file(file)} was not verified: {error}"]
    if signature is None and allowed_signers is not None:
        raise UserInputError(f"{file} is not signed: there is no {signature_file(file)}")
    return signature, []
