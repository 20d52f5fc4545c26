"""Commands on the stored data: backup, verify, withdraw, merge, export."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict
from importlib.util import find_spec
from pathlib import Path

import click
from rich.table import Table

from kiosk import StorageError, UserInputError
from kiosk.cli.options import database_data_option, json_option, progress_bar, sessions_data_option
from kiosk.cli.terminal import confirm, console, counted, one_line, tell_caution, tell_line
from kiosk.export.bids import Bids
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset as write
from kiosk.export.layouts import PsychDs
from kiosk.store import drives
from kiosk.store import maintenance as copies
from kiosk.store import merge as merging
from kiosk.store import verify as checking
from kiosk.store import withdrawal as withdrawing
from kiosk.store.copies import CopyKind, KnownCopy, copies_to_see_to, note_copy
from kiosk.store.database import FILE as DATABASE
from kiosk.store.database import in_use
from kiosk.store.schema import check_readable
from kiosk.store.verify import Flaw, Verification

SHORT_SHA = 12
MOST_PROCESSES = 4
"""One process reads for all, so more of them would wait for it."""
SOMETHING_WRONG = 1
"""The exit code when something is found, or the disk fails."""


@contextmanager
def _disk_in_words() -> Iterator[None]:
    try:
        yield
    except StorageError as failure:
        raise click.ClickException(str(failure)) from failure


@click.command()
@database_data_option
@click.option(
    "--to",
    metavar="PLACE",
    help="Where copies are kept: a folder, a drive by its name, or 'stick' for the one that is plugged in; by default "
    "in the data folder.",
)
@click.option(
    "--keep", type=click.IntRange(min=1), default=copies.KEPT, show_default=True, help="How many copies are kept."
)
@click.option(
    "--encrypt-for",
    "keys",
    multiple=True,
    metavar="KEY",
    help="Encrypt the copy for a public key of age (age1...) or SSH, or for those in a file; may be given again.",
)
@json_option
def backup_command(data: Path, to: str | None, keep: int, keys: tuple[str, ...], *, as_json: bool) -> None:
    """Copy the database, also while a kiosk is writing.

    The copy is checked, and the oldest copies are removed. A copy that goes to another place is read back from
    there, and has its name only once it is whole.
    """
    check_readable(data)
    if to is None and not keys:
        into = data / copies.FOLDER
        with _disk_in_words(), progress_bar("copying", hidden=as_json) as tell:
            copy = copies.back_up(data, into, keep, tell)
        told = {"backup": str(copy), "bytes": copy.stat().st_size, "kept": len(copies.list_backups(into))}
        tell_line(json.dumps(told) if as_json else f"The copy is {copy}, one of {told['kept']} that are kept there.")
        return
    if to is None:
        raise UserInputError("--encrypt-for is for a copy that is carried away: name the place with --to")
    readers = drives.recipients(keys) if keys else ()
    into = drives.destination(to)
    with _disk_in_words(), progress_bar("copying", hidden=as_json) as tell:
        carried = drives.carry(data, into, keep, readers, tell)
    note_copy(data, CopyKind.BACKUP, carried.file)
    if as_json:
        told = {"backup": str(carried.file), "bytes": carried.bytes, "kept": carried.kept}
        click.echo(json.dumps(told | {"sha256": carried.sha256, "encrypted": carried.encrypted}))
        return
    how = ", encrypted" if carried.encrypted else ""
    tell_line(f"The copy is {carried.file}{how}: {carried.bytes:,} bytes, written and read back alike.")
    click.echo(f"SHA-256 {carried.sha256}; copies kept there: {carried.kept}.")


@click.command()
@database_data_option
@click.option("--port", type=click.IntRange(1, 65535), default=8001, show_default=True, help="On this machine only.")
@click.option("--open", "opens", is_flag=True, help="Open the page in the browser.")
def browse_command(data: Path, port: int, *, opens: bool) -> None:
    """Show a copy of the database with Datasette.

    It is verified and read only, and served until Ctrl+C. The page is served to this machine alone; the copy is
    removed at the end. It needs the extra 'browse'.
    """
    if find_spec("datasette") is None:
        raise UserInputError("browsing needs Datasette: pip install 'recollect[browse]'")
    with tempfile.TemporaryDirectory(prefix="recollect-browse-") as place, _disk_in_words():
        copy = copies.back_up(data, Path(place), 1).rename(Path(place) / DATABASE)
        with progress_bar("checking", hidden=False) as tell:
            flaws = checking.verify(Path(place), tell)
        if flaws:
            raise UserInputError(f"the database is not as it was written: 'recollect verify --data {data}' says why")
        tell_line(f"http://127.0.0.1:{port}/ shows a verified copy of {data}; Ctrl+C ends it and removes the copy.")
        serve = ("serve", "--immutable", str(copy), "--host", "127.0.0.1", "--port", str(port))
        command = [sys.executable, "-m", "datasette", *serve, "--setting", "allow_download", "off"]
        # Ctrl+C reaches both; this one waits until the other has ended.
        with suppress(KeyboardInterrupt), subprocess.Popen(command + ["--open"] * opens) as datasette:  # noqa: S603
            code = datasette.wait()
            if code:
                raise UserInputError(f"Datasette ended with exit code {code}; is the port {port} taken? Try --port")


@click.command()
@database_data_option
@json_option
def verify_command(data: Path, *, as_json: bool) -> None:
    """Check the database row by row.

    The exit code is 1 if anything is wrong. A withdrawal that was cut off is finished, and people who withdrew are
    deleted again where an older copy was put back; otherwise nothing is changed.
    """
    with progress_bar("checking", hidden=as_json) as tell:
        flaws, unseen = checking.look_through(data, tell)
    # A database that is wrong in another way is left as it was found.
    here = [flaw for flaw in flaws if flaw.check in {Verification.FINISHED, Verification.COPIES}]
    others = {flaw.check for flaw in flaws if flaw not in here}
    if here and others <= {Verification.ELSEWHERE} and not in_use(data):
        try:
            withdrawing.finish_at_rest(data)
        except (StorageError, UserInputError) as failure:
            click.echo(f"What was withdrawn could not be deleted: {failure}", err=True)
        else:
            click.echo("What was left of people who withdrew is deleted now:", err=True)
            for flaw in here:
                click.echo(f"  {one_line(f'{flaw.where}: {flaw.what}')}", err=True)
            flaws, unseen = checking.look_through(data)
    if as_json:
        rows = [asdict(flaw) | {"check": flaw.check.name.lower()} for flaw in flaws]
        places = [{"kind": copy.kind.value, "place": str(copy.place), "why": why} for copy, why in unseen]
        told = {"data": str(data), "sound": not flaws, "results": rows}
        click.echo(json.dumps(told | ({"copies_not_looked_into": places} if places else {})))
    else:
        console().print(_table(flaws))
        if unseen:
            click.echo("People who withdrew may be in these copies elsewhere, which were not looked into:", err=True)
        for copy, why in unseen:
            click.echo(f"  {one_line(f'{copy.kind.value} of {copy.made_at[:10]}: {copy.place}: {why}')}", err=True)
    sys.exit(SOMETHING_WRONG if flaws else 0)


def _table(flaws: list[Flaw]) -> Table:
    table = Table(box=None)
    for heading in ("check", "where", "result"):
        table.add_column(heading)
    for check in Verification:
        found = [flaw for flaw in flaws if flaw.check is check]
        for number, flaw in enumerate(found):
            table.add_row("" if number else check.value, flaw.where, flaw.what)
        if not found:
            table.add_row(check.value, "", "ok")
    return table


@click.command()
@click.argument("code", required=False)
@click.option("--session", type=click.IntRange(min=1), help="The number of their session, for a person without a code.")
@sessions_data_option
@click.option("--yes", is_flag=True, help="Do not ask.")
@json_option
def withdraw_command(code: str | None, session: int | None, data: Path, *, yes: bool, as_json: bool) -> None:
    """Delete all that is stored of the participant with this CODE.

    Give the number of their session instead, as 'recollect sessions' lists it, if they have no code. Only a count
    stays. If a withdrawal was cut off, the same command finishes it.
    """
    who = code if session is None else session
    if who is None or (code is not None and session is not None):
        raise click.UsageError("give the code of the participant, or --session with the number of their session")
    going = withdrawing.find_withdrawal(data, who)
    if not yes and not going.cut_off:
        begun = (going.started_at or "")[:16].replace("T", " ")
        click.echo(
            f"Participant {going.participant}, {_sessions(going)}, begun {begun} (UTC): {going.events} events "
            f"will be deleted for ever, and the copies in the data folder ({going.backups}) replaced by a fresh one. "
            "Copies that are kept elsewhere, folders that this one was merged into, and those that it was merged from "
            "are not touched.",
            err=True,
        )
        if not confirm("Delete them?"):
            raise click.Abort
    with _disk_in_words():
        gone = withdrawing.withdraw(data, who)
    told = f"All of participant {gone.participant} is deleted."
    if gone.cut_off:
        told = f"The withdrawal of participant {gone.participant}, which had been cut off, is finished."
    others = list(copies_to_see_to(data, withdrawing.codes_withdrawn(data, gone)))
    if as_json:
        rows = [
            {"kind": each.kind.value, "place": str(each.place), "made_at": each.made_at, "sessions": sessions}
            for each, sessions in others
        ]
        click.echo(json.dumps(gone.to_json() | {"copies_elsewhere": rows}))
        return
    click.echo(told)
    if others:
        click.echo("These hold them, or may hold them; see to each of them:", err=True)
    for each, sessions in others:
        # The date of a source folder would be that of the merge.
        of = "" if each.kind is CopyKind.SOURCE else f" of {each.made_at[:10]}"
        click.echo(f"  {one_line(f'{each.kind.value}{of}: {each.place}{_way_out(each, sessions)}')}", err=True)


def _way_out(copy: KnownCopy, sessions: list[int]) -> str:
    """Return the command that deletes people in a data folder that holds these sessions of them."""
    if copy.kind not in {CopyKind.MERGE, CopyKind.SOURCE}:
        return ""
    # One session is enough: all visits of a participant go.
    who = f"--session {sessions[0]}" if sessions else "CODE"
    return f": recollect withdraw {who} --data {copy.place}"


class FolderAndSite(click.ParamType[tuple[Path, str]]):
    """A data folder and the site it gets: ``A=ROME``."""

    name = "FOLDER=SITE"

    def convert(
        self, value: str | tuple[Path, str], param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[Path, str]:
        """Read both; the name of a folder may have an equals sign, that of a site has none."""
        if isinstance(value, tuple):
            return value
        folder, equals, site = value.rpartition("=")
        if not (folder and equals):
            self.fail(f"{value!r} must be a folder and its site, such as A=ROME", param, ctx)
        return Path(folder), site


def _sessions(going: withdrawing.Withdrawal) -> str:
    """Name the sessions that go: those of all visits."""
    if len(going.sessions) > 1:
        return f"sessions {', '.join(map(str, going.sessions))}"
    return f"session {going.session}"


@click.command()
@click.argument("folders", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="A B [C ...]")
@click.option("--out", required=True, type=click.Path(path_type=Path), help="The new data folder, not there or empty.")
@click.option(
    "--site",
    "sites",
    multiple=True,
    type=FolderAndSite(),
    help="Give all that a folder holds this site, for kiosks that recorded without one; once for each folder.",
)
@json_option
def merge_command(folders: tuple[Path, ...], out: Path, sites: tuple[tuple[Path, str], ...], *, as_json: bool) -> None:
    """Merge the data folders A, B and so on.

    The result is a new folder; A, B and so on are not changed.
    """
    with _disk_in_words(), progress_bar("merging", hidden=as_json) as tell:
        sessions = merging.merge(folders, out, tell, sites)
    for folder in folders:
        note_copy(folder, CopyKind.MERGE, out)
        note_copy(out, CopyKind.SOURCE, folder)
    studies = merging.studies_in(folders)
    if as_json:
        named = [asdict(each) | {"folder": str(each.folder)} for each in studies]
        click.echo(json.dumps({"out": str(out), "folders": len(folders), "sessions": sessions, "studies": named}))
        return
    tell_line(f"{out} holds {counted(sessions, 'session')} of {counted(len(folders), 'folder')}.")
    if len({each.sha256 for each in studies}) > 1:
        click.echo("caution: they are of studies that differ; compare them with 'recollect study diff':")
        for each in studies:
            sha256 = each.sha256[:SHORT_SHA] or "unknown"
            tell_line(f"  {sha256} {each.title!r}: {counted(each.sessions, 'session')} in {each.folder}")


@click.command()
@sessions_data_option
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The folder to write; new, or empty.")
@click.option("--bids", is_flag=True, help="Names like those of BIDS, instead of Psych-DS.")
@click.option("--with-dates", is_flag=True, help="Also when each session began.")
@click.option("--with-rehearsals", is_flag=True, help="Also rehearsals, told apart by a column.")
@click.option("--with-trials", is_flag=True, help="Also sessions without a PIN, told apart by a column.")
@click.option("--with-texts", is_flag=True, help="Also what people typed; it may name a person.")
@click.option("--with-ages", is_flag=True, help="Also exact ages; by default they stand in bands of some years.")
@click.option("--with-unshared", is_flag=True, help="Also who did not agree to publishing; then keep it to yourself.")
@click.option("--shuffled-ids", is_flag=True, help="Let no name and no order of rows tell in which order people came.")
@json_option
def export_command(data: Path, out: Path, *, bids: bool, shuffled_ids: bool, as_json: bool, **also: bool) -> None:
    """Write a data set for publishing, with a codebook.

    The data set follows Psych-DS.
    """
    check_readable(data)
    withdrawing.check_none_is_back(data)
    extras = frozenset(extra for extra in ExportOption if also[f"with_{extra.value}"])
    with progress_bar("sessions", hidden=as_json) as bar:
        # A kiosk that is open on the folder has the other processors to itself.
        processes = 1 if in_use(data) else min(os.cpu_count() or 1, MOST_PROCESSES)
        layout = Bids if bids else PsychDs
        exported = write(data, out, layout, extras, bar, shuffled_ids=shuffled_ids, processes=processes)
    note_copy(data, CopyKind.EXPORT, out)
    if as_json:
        click.echo(json.dumps({"out": str(out)} | exported.to_json()))
        return
    tell_line(f"The data set in {out} holds {counted(exported.participants, 'session')}.")
    if exported.not_shared:
        click.echo(f"Left out, as their visitors did not agree to publishing: {exported.not_shared}.")
    if exported.under_way:
        click.echo(f"Left out, as they are still under way: {exported.under_way}.")
    if exported.trials:
        click.echo(f"Left out, as no PIN was set, so that they were trials: {exported.trials}.")
    for caution in exported.cautions:
        tell_caution(caution)
