"""Commands on what visitors read in a study: its translations, and all of it as a PDF."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click
from rich.table import Table

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option
from kiosk.cli.terminal import console, counted, tell_line
from kiosk.config import Settings, code_of
from kiosk.robots.registry import check_robot
from kiosk.study.checks import expected_minutes
from kiosk.study.editing import TextPlace, change_text, find_text, text_places, why_not_editable
from kiosk.study.loader import read_study
from kiosk.study.translations import State, Translation, Unit
from kiosk.study.translator_files import export_texts, import_texts

if TYPE_CHECKING:
    from kiosk.experiment.session_config import SessionConfig, StudyConfig
    from kiosk.ui.preview import FoundText

SHOWN = 60


@click.command("translations")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--language", help="The language to list, to write or to read; one that is not there yet begins here.")
@click.option("--write", type=click.Path(path_type=Path), help="Write its texts for translators: a .po or .xliff file.")
@click.option("--read", type=click.Path(path_type=Path), help="Put translated texts of such a file into the study.")
@json_option
def translations_command(
    file: Path, language: str | None, write: Path | None, read: Path | None, *, as_json: bool
) -> None:
    """Show how far a study FILE is translated.

    It also exchanges the texts with a table for translators.
    """
    settings = Settings.read(file)
    if (write or read) and language is None:
        raise UserInputError("--language is missing: which language is it, such as --language nl?")
    if write and read:
        raise UserInputError("--write and --read cannot be used together")
    if language and read:
        _read(settings, Translation(settings, language), read, as_json=as_json)
    elif language and write:
        count = export_texts(Translation(settings, language), write)
        tell_line(json.dumps({"file": str(write), "texts": count}) if as_json else f"{count} texts are in {write}.")
    else:
        codes = [language] if language else list(settings.language_codes[1:])
        _show({code: Translation(settings, code).units() for code in codes}, list_them=bool(language), as_json=as_json)


def _read(settings: Settings, translation: Translation, file: Path, *, as_json: bool) -> None:
    texts = import_texts(file, translation)
    written, left = translation.fill(texts)
    if as_json:
        click.echo(json.dumps({"files": [str(path) for path in written], "left_out": left}))
        return
    for path in written:
        tell_line(f"written: {path}")
    for sentence in left:
        tell_line(f"left out: {sentence}")
    if translation.language not in map(code_of, settings.languages):
        click.echo(f'Add "./{translation.language}" to languages in the study file to use it.')


def _show(found: dict[str, Sequence[Unit]], *, list_them: bool, as_json: bool) -> None:
    if as_json:
        rows = {code: [{"key": unit.key, "state": unit.state.value} for unit in units] for code, units in found.items()}
        click.echo(json.dumps(rows))
        return
    table = Table(box=None, pad_edge=False)
    for heading in ("language", "texts", *(state.value for state in State)):
        table.add_column(heading, justify="left" if heading in {"language", "texts"} else "right")
    for code, units in found.items():
        for part in dict.fromkeys(unit.part for unit in units):
            counts = Counter(unit.state for unit in units if unit.part == part)
            table.add_row(code, part, *(str(counts[state] or "") for state in State))
    console().print(table)
    if list_them:
        for unit in (unit for units in found.values() for unit in units if unit.state is not State.DONE):
            click.echo(f"{unit.state.value}: {unit.key}: {unit.source[:SHOWN]!r}")


@click.command("dossier")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The PDF file to write.")
@json_option
def dossier_command(file: Path, out: Path, *, as_json: bool) -> None:
    """Write a study FILE as one PDF for an ethics board.

    It has the stages, every screen and text, what is stored, and hashes.
    """
    from kiosk.ui.dossier import write_dossier  # noqa: PLC0415 - the other commands do without a window

    study = read_study(read_settings(file))
    check_robot(study.settings)
    pages = write_dossier(study, max(round(expected_minutes(plan)) for plan in study.plans), out)
    tell_line(json.dumps({"file": str(out), "pages": pages}) if as_json else f"{out} has {counted(pages, 'page')}.")


@click.command("preview")
@click.argument("file", type=click.Path(path_type=Path))
def preview_command(file: Path) -> None:
    """Show every screen of a study FILE while you write it.

    The window follows the files as you change them. Click on a text to see its file and key, and to change it.
    """
    from kiosk.ui.preview import show_preview  # noqa: PLC0415 - the other commands do without a window
    from kiosk.ui.window import WindowMode, check_screen  # noqa: PLC0415 - as above

    texts = EditedStudy(file)
    texts.read()
    check_screen(WindowMode.WINDOW)
    show_preview(file, texts)


class EditedStudy:
    """A study whose texts are found and changed."""

    def __init__(self, file: Path) -> None:
        """Nothing is read before ``read``."""
        self._file = file
        self._settings = Settings()
        self._places: dict[str, tuple[TextPlace, ...]] = {}
        self._found: TextPlace | None = None

    def read(self) -> StudyConfig:
        """Return the study as its files are now; raises UserInputError."""
        settings = read_settings(self._file)
        study = read_study(settings)
        self._settings, self._places = settings, {}
        return study

    def find(self, plan: SessionConfig, shown: str) -> FoundText | None:
        """Return the text that reads like this on a screen in the language of a plan."""
        from kiosk.ui.preview import FoundText  # noqa: PLC0415 - the other commands do without a window

        if plan.language not in self._places:
            self._places[plan.language] = text_places(plan)
        self._found = place = find_text(self._places[plan.language], shown)
        if place is None:
            return None
        note = why = why_not_editable(self._settings, place)
        if not why and place.is_shipped:
            note = f"It comes with Recollect; your text goes into [texts.{place.language}] of {self._file}."
        return FoundText(place.file, place.key, place.text, note, is_editable=not why)

    def change(self, text: str) -> None:
        """Write the text that was found last; raises UserInputError and changes nothing if that is impossible."""
        if self._found is None:
            raise UserInputError("there is no text to change; click on one first")
        change_text(self._settings, self._file, self._found, text)
