"""Commands that help to set up a study: check its file, write one to begin with, bring in an instrument."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

import click
from rich.table import Table

from kiosk import UserInputError, program
from kiosk.assistance.wording import CARD, Catalogue
from kiosk.cli.guide import add_guide
from kiosk.cli.main import BAD_INPUT
from kiosk.cli.options import json_option, set_pin_command
from kiosk.cli.terminal import console, tell_caution, tell_line
from kiosk.config import NO_ROBOT, Settings, pictures_in
from kiosk.experiment.items import TextPage
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.experiment.session_config import Source, StudyConfig
from kiosk.extensions import ExtensionGroup, find, registered_names
from kiosk.files import write_file
from kiosk.robots.registry import check_robot, load_driver
from kiosk.store.connecting import atomic_directory
from kiosk.study.checks import expected_minutes, study_warnings
from kiosk.study.csv_import import Heading, read_items, write_questionnaire
from kiosk.study.decks import NAMES, names_in, names_table
from kiosk.study.findings import located
from kiosk.study.forming import card_forms
from kiosk.study.loader import read_study
from kiosk.study.names import unclear_names
from kiosk.study.new import STUDY_FILE, NewStudy, default_languages, find_template, templates
from kiosk.study.package import is_package, open_study
from kiosk.ui.checks import CannotDraw, found_in_pictures
from kiosk.ui.fonts import missing_characters

MOST_PER_PAGE = 8
# A command loads what only it needs, so that a study is refused soon.
# ruff: noqa: PLC0415

SHORT_SHA = 12


class StudyGroup(click.Group):
    """The commands on studies; those of other modules are loaded when they are called."""

    ELSEWHERE: ClassVar[Mapping[str, str]] = {
        "diff": "kiosk.cli.study_package:diff_command",
        "dossier": "kiosk.cli.study_texts:dossier_command",
        "pack": "kiosk.cli.study_package:pack_command",
        "preview": "kiosk.cli.study_texts:preview_command",
        "translations": "kiosk.cli.study_texts:translations_command",
        "wording": "kiosk.cli.study_wording:wording",
    }

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of all commands in their order."""
        return sorted({*super().list_commands(ctx), *self.ELSEWHERE})

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load one command."""
        if cmd_name in self.ELSEWHERE and cmd_name not in self.commands:
            module, name = self.ELSEWHERE[cmd_name].split(":")
            command = getattr(import_module(module), name)
            add_guide(f"study {cmd_name}", command)
            self.add_command(command, cmd_name)
        return super().get_command(ctx, cmd_name)


@click.group(cls=StudyGroup)
def study() -> None:
    """Set up a study: its file, cards, texts and PIN."""


study.add_command(set_pin_command)


@study.command("check")
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--allowed-signers",
    type=click.Path(path_type=Path),
    help="Who may have signed a packed study: a file as ssh-keygen(1) describes it.",
)
@click.option(
    "--pages", is_flag=True, help="Also go through a session in every language and on three sizes of the window."
)
@json_option
@click.pass_context
def study_check(
    context: click.Context, file: Path, allowed_signers: Path | None, *, pages: bool, as_json: bool
) -> None:
    """Check a study FILE and print a summary, or its faults.

    Every file that it names is checked too.
    """
    try:
        read = read_study(open_study(file))
        check_robot(read.settings)
        from kiosk.cli.study_package import signature_of

        signature, unverified = signature_of(file, allowed_signers)
        untried = [*unverified, *check_pictures(read), *check_fonts(read), *(check_pages(read) if pages else ())]
    except UserInputError as refusal:
        if not as_json:
            raise
        click.echo(json.dumps({"faults": refusal.sentences}))
        context.exit(BAD_INPUT)
    summary = summarised(read)
    if is_package(file):
        summary["signed"] = str(signature) if signature else None
    summary["cautions"] += untried
    if as_json:
        click.echo(json.dumps({"faults": []} | summary))
    else:
        _print_summary(read, summary)


def _print_summary(read: StudyConfig, summary: Mapping[str, Any]) -> None:
    """Print what a study is, where everything came from, and what may not be meant."""
    table = Table(box=None, show_header=False)
    for key, value in summary.items():
        if key not in {"cautions", "sources"}:
            table.add_row(key.replace("_", " "), _told(value))
    console().print(table)
    for source in read.sources:
        tell_line(_came_from(source))
    for caution in summary["cautions"]:
        tell_caution(caution)


def check_pictures(read: StudyConfig) -> list[str]:
    """Raise UserInputError if a picture of the study's own cannot be drawn; returns what else can be said of them."""
    try:
        faults, cautions = found_in_pictures(read)
    except CannotDraw as error:
        return [f"the pictures were not tried: {error}"]
    if faults:
        raise UserInputError(*faults)
    return list(cautions)


def check_fonts(read: StudyConfig) -> list[str]:
    """Return a caution for every language with characters that no font here can draw."""
    try:
        return [f"{each}; {each.remedy}" for each in missing_characters(program("_display", "fonts"), read)]
    except (OSError, ValueError, subprocess.SubprocessError) as error:
        return [f"the fonts were not tried: {error}"]


def check_pages(read: StudyConfig) -> list[str]:
    """Raise UserInputError if a session does not come to its end; returns the texts that are cut off."""
    from kiosk.cli.page_walk import walk_pages

    found = list(walk_pages(read))
    faults = [sentence for is_fault, sentence in found if is_fault]
    if faults:
        raise UserInputError(*faults)
    return [sentence for _, sentence in found]


def summarised(read: StudyConfig) -> dict[str, Any]:
    """Return what a study is, for people and programs."""
    settings, plan = read.settings, read.plans[0]
    return {
        "title": settings.title,
        "sha256": read.sha256,
        "languages": list(read.languages),
        "stages": list(settings.stages),
        "conditions": dict(settings.randomisation.target_n) or {settings.assistance.condition: None},
        "block": settings.randomisation.block_size if settings.randomisation.target_n else None,
        "policy": f"{plan.policy.name} {plan.policy.sha256[:8]}",
        "items": {asked.id: _questions(asked) for asked in (plan.about_you, *plan.questionnaires)},
        "minutes": max(round(expected_minutes(plan)) for plan in read.plans),
        "sources": [_described(source) for source in read.sources],
        "cautions": [*study_warnings(read), *_renamed(read)],
    }


def _described(source: Source) -> dict[str, Any]:
    """Where a name led, for programs."""
    return {
        "key": source.key,
        "name": source.name,
        "path": str(source.path),
        "shipped": source.is_shipped,
        "version": source.version,
        "sha256": source.sha256,
        "unused": None if source.unused is None else str(source.unused),
    }


def _came_from(source: Source) -> str:
    """Where a name led, for people."""
    kind = "shipped" if source.is_shipped else "own"
    version = "" if source.version is None else f", version {source.version}"
    return f"{source.key}: {source.name!r} is {kind}: {source.path}{version}, sha256 {source.sha256[:SHORT_SHA]}"


def _renamed(read: StudyConfig) -> Iterator[str]:
    """Yield the items whose columns in a data set are called otherwise."""
    from kiosk.export.records import StudyMaterials
    from kiosk.export.tables import renamed_items

    for item, column in renamed_items(StudyMaterials(read.plans)).items():
        yield f"about_you: the item {item!r} will be the column {column!r}, as the data set's own has that name"


def _questions(asked: Questionnaire) -> int:
    return sum(not isinstance(item, TextPage) for item in asked.items)


def _told(value: object) -> str:
    """Return a value of the summary as a person reads it."""
    match value:
        case None:
            return "none"
        case dict():
            return ", ".join(name if number is None else f"{name} {number}" for name, number in value.items())
        case list():
            return ", ".join(map(str, value))
    return str(value)


@study.command("cards")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--sheet", type=click.Path(path_type=Path, dir_okay=False), help="Draw all cards on this sheet (.png).")
@click.option("--names", is_flag=True, help=f"Write {NAMES} with a row for each card, where there is none.")
@click.option("--practice", is_flag=True, help="The deck of the practice, and not that of the game.")
@json_option
def study_cards(file: Path, sheet: Path | None, *, names: bool, practice: bool, as_json: bool) -> None:
    """List the cards of a study FILE and what is wrong with them.

    It names each card and says which are hard to tell apart.
    """
    from kiosk.ui.cards import card_warnings, draw_cards, save_sheet

    settings = Settings.read(file)
    board = settings.practice if practice else settings.game
    folder = located(settings, "cards", board.deck).path
    if names:
        write_names(settings, board.deck)
    read = read_study(settings)
    pictures = pictures_in(folder)
    drawn = draw_cards(pictures.values())
    drawings = {card: drawn[picture] for card, picture in pictures.items()}
    called = {card: [plan.catalogue.forms_of(card)[CARD] for plan in read.plans] for card in pictures}
    warnings = [*(f"the picture {each.file} cannot be drawn: {each.fault}" for each in drawings.values() if each.fault)]
    warnings += [*card_warnings(drawings.values()), *_unnamed(read, pictures)]
    if sheet is not None:
        save_sheet(sheet, drawings, called)
    if as_json:
        cards = [
            {"card": card, "file": str(picture), "names": dict(zip(read.languages, called[card], strict=True))}
            for card, picture in pictures.items()
        ]
        click.echo(json.dumps({"deck": str(folder), "cards": cards, "cautions": warnings}))
        return
    table = Table("card", *read.languages, "size", box=None)
    for card, drawing in drawings.items():
        table.add_row(card, *called[card], f"{drawing.width} x {drawing.height}")
    console().print(table)
    for warning in warnings:
        tell_caution(warning)
    if sheet is not None:
        tell_line(f"The cards are drawn on {sheet}.")


def _unnamed(study: StudyConfig, cards: Iterable[str]) -> Iterator[str]:
    """Yield for each language which cards it has no name for."""
    for plan in study.plans:
        unnamed = [card for card in cards if not plan.catalogue.names(card)]
        if unnamed:
            yield f"no name in {plan.language!r}, so that the file's name is said: {', '.join(unnamed)}"


def write_names(settings: Settings, deck: str) -> None:
    """Write a table for the names of a deck's cards; raises UserInputError where there is one."""
    place = located(settings, "cards", deck)
    file = place.path / NAMES
    if place.is_shipped:
        raise UserInputError(f"the deck {deck!r} is shipped and has names; only those of your own cards can be written")
    if file.exists():
        raise UserInputError(f"{file} is there already; add to it what is missing")
    folders = [located(settings, "sentences", name).path for name in settings.languages]
    spoken = {catalogue.language: catalogue for catalogue in map(Catalogue, folders)}
    cards = pictures_in(place.path)
    forms = {language: card_forms(catalogue) for language, catalogue in spoken.items()}
    known = {language: names_in(catalogue, cards) for language, catalogue in spoken.items()}
    write_file(file, names_table(cards, forms, known))
    tell_line(f"Fill in the names of the cards in {file}.", err=True)


@study.command("new")
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path, file_okay=False))
@click.option("--template", help=f"What to begin with: {', '.join(templates())}.")
@click.option("--title", help="What the study is called.")
@click.option("--contact", help="Whom visitors write to, best a mail address.")
@click.option("--language", "languages", multiple=True, help="A language, such as 'en'; may be given several times.")
@click.option("--robot", help="The robot, by the name of its driver, or 'none'.")
@json_option
def study_new(
    folder: Path,
    template: str | None,
    title: str | None,
    contact: str | None,
    languages: tuple[str, ...],
    robot: str | None,
    *,
    as_json: bool,
) -> None:
    """Make the folder DIR with a whole study in it.

    In a terminal it asks for everything that no option gives.
    """
    check_free(folder)
    asks = sys.stdin.isatty() and not as_json
    if template is None and asks:
        for each in templates().values():
            click.echo(f"  {each.name:15} {each.about}")
    chosen = find_template(_ask("Template", template, "paper", asks=asks))
    title = _ask("Title", title, chosen.study["title"], asks=asks)
    spoken = languages or _ask("Languages", None, " ".join(chosen.languages), asks=asks).replace(",", " ").split()
    contact = _ask("Whom visitors write to", contact, "", asks=asks)
    usual = str(chosen.study.get("robot", {}).get("kind", NO_ROBOT))
    kind = _ask(f"Robot ({NO_ROBOT}, {', '.join(registered_names(ExtensionGroup.ROBOTS))})", robot, usual, asks=asks)
    new = NewStudy(chosen, title, contact, default_languages(chosen, spoken), {} if kind == usual else _robot(kind))
    files = new.files()
    with atomic_directory(folder) as made:
        for name, content in files.items():
            (made / name).parent.mkdir(parents=True, exist_ok=True)
            (made / name).write_bytes(content)
        made.chmod(0o755)
    if as_json:
        packages = [str(folder / "packages" / name) for name in chosen.packages]
        click.echo(json.dumps({"study": str(folder / STUDY_FILE), "files": sorted(files), "packages": packages}))
        return
    tell_line(f"{len(files)} files were written to {folder}. Read {folder / 'README.md'} first, then:")
    for name in chosen.packages:
        tell_line(f"  pip install {folder / 'packages' / name}")
    tell_line(f"  recollect rehearse --headless --study {folder / STUDY_FILE}")


def _ask(what: str, given: str | None, usual: str, *, asks: bool) -> str:
    """Return what is given, or ask for it where a person can answer."""
    if given is not None:
        return given
    return str(click.prompt(what, default=usual, show_default=bool(usual))) if asks else usual


def check_free(folder: Path) -> None:
    """Raise UserInputError if there is something in a folder that is to be made."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise UserInputError(f"{folder} is there already and is not empty; name a new folder")


def _robot(kind: str) -> dict[str, Any]:
    """Return the section of a robot, with all options of its driver; raises UserInputError if there is none."""
    if kind == NO_ROBOT:
        return {"kind": kind}
    driver = load_driver(find(ExtensionGroup.ROBOTS, kind))
    options = {
        key: field.default
        for key, field in driver.options.model_fields.items()
        if isinstance(field.default, bool | int | float | str)
    }
    return {"kind": kind, "options": options}


@study.command("reference")
@click.option("--toml", is_flag=True, help="Print a study file with every key instead, as it is without one.")
def study_reference(*, toml: bool) -> None:
    """Print the reference of every key of a study file.

    It is Markdown.
    """
    from kiosk.study.reference import as_page, as_study_file

    click.echo(as_study_file(Settings()) if toml else as_page(Settings), nl=False)


@study.command(name="import")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--id", "name", required=True, help="What the questionnaire is called, in records and columns.")
@click.option("--version", required=True, help="Its version; it changes whenever an item does.")
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The TOML file to write; it must be new.")
@click.option("--note", help="Where its wording is from.")
@click.option("--per-page", type=click.IntRange(1, MOST_PER_PAGE), default=1, show_default=True, help="Items a page.")
@click.option("--shuffled", is_flag=True, help="Shuffle its items anew for every visitor.")
@click.option("--language", default="en", show_default=True, help="The language of a file that does not name one.")
@json_option
def study_import(
    file: Path,
    name: str,
    version: str,
    out: Path,
    note: str | None,
    per_page: int,
    language: str,
    *,
    shuffled: bool,
    as_json: bool,
) -> None:
    """Make a questionnaire from a CSV table or a survey FILE.

    A table has one row per item. XLSForm (.xlsx), REDCap data
    dictionaries (.csv), LimeSurvey (.txt) and Qualtrics (.qsf) are known. Each item that cannot be imported is named
    on a line.
    """
    from kiosk.study.survey_import import is_survey, read_survey

    order = ItemOrder.SHUFFLED if shuffled else ItemOrder.FIXED
    heading = Heading(
        id=name, version=version, note=note or f"Brought in from {file.name}.", per_page=per_page, order=order
    )
    from_program = is_survey(file)
    read, left = read_survey(file, heading, language) if from_program else (read_items(file, heading), [])
    unclear = list(unclear_names([(file, read)]))
    if unclear and not from_program:
        raise UserInputError(*unclear)
    write_questionnaire(read, out)
    if as_json:
        told = {"out": str(out), "items": len(read.items), "not_taken": [*left], "to_change": unclear}
        click.echo(json.dumps(told))
        return
    items = "1 item" if len(read.items) == 1 else f"{len(read.items)} items"
    tell_line(f"{items} written to {out}")
    for sentence in left:
        tell_line(f"not taken: {sentence}")
    for sentence in unclear:
        tell_line(f"to change in {out} before it is used: {sentence}")
