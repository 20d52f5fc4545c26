"""Find the file and key of a text that visitors read, and change it there with comments kept."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import tomlkit
from fluent.syntax import FluentParser, FluentSerializer
from fluent.syntax.ast import Message, Pattern, Resource, Term, TextElement

from kiosk import UserInputError
from kiosk.assistance.wording import Written
from kiosk.config import ASSETS, Settings, code_of, read_text
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.files import write_file
from kiosk.study.loader import read_study
from kiosk.study.texts import OWN_TEXTS
from kiosk.study.translations import (
    entry_patterns,
    pattern_text,
    put_text,
    read_document,
    resource_patterns,
    spelling_among,
    worded_strings,
    worded_tables,
)

BOM = "\ufeff"


@dataclass(frozen=True)
class TextPlace:
    """One text of a study: its file, its key there, and how it is written."""

    language: str
    file: Path
    key: str
    text: str
    kind: str
    """What the file holds: ``message``, ``own message``, ``sheet`` or ``questionnaire``."""
    shown: re.Pattern[str]
    """What it reads like on the screen; variables stand for anything."""
    literal: int
    """How many of its characters are no variable."""

    @property
    def is_shipped(self) -> bool:
        """Whether the file comes with Recollect."""
        return self.file.resolve().is_relative_to(ASSETS.resolve())


def text_places(plan: SessionConfig) -> tuple[TextPlace, ...]:
    """Return every text of a study in the language of a plan; raises UserInputError if a file cannot be read."""
    return (*_messages(plan), *_of_sheet(plan), *_of_questionnaires(plan))


def find_text(places: tuple[TextPlace, ...], shown: str) -> TextPlace | None:
    """Return the text that reads like this on the screen, the most exact one first; None if there is none."""
    words = _squeezed(shown)
    fitting = [place for place in places if words and place.shown.fullmatch(words)]
    return max(fitting, key=lambda place: place.literal, default=None)


def why_not_editable(settings: Settings, place: TextPlace) -> str:
    """Say why a text cannot be changed here; an empty string if it can."""
    study = settings.beside("").resolve()
    if settings.package is not None:
        return "the study is one packed file; change the folder that it was made from"
    if place.file.suffix == ".csv":
        return f"change it in a spreadsheet, or in a text editor: {place.file}"
    if place.is_shipped and place.kind == "message":
        return ""
    if place.is_shipped:
        return f"it comes with Recollect; copy {place.file} beside the study file, and name the copy there"
    if not place.file.resolve().is_relative_to(study):
        return f"{place.file} is outside the study's folder {study}"
    return ""


def change_text(settings: Settings, study_file: Path, place: TextPlace, text: str) -> tuple[Path, StudyConfig]:
    """Write a text into the file of its place, or into ``[texts]`` of the study file if it is shipped.

    Returns the file that was written, and the study as it is then. Raises UserInputError, and leaves every file as it
    was, if the text cannot be written there or the study is wrong with it.
    """
    why = why_not_editable(settings, place)
    if why:
        raise UserInputError(f"{place.key} cannot be changed here: {why}")
    if not text.strip():
        raise UserInputError(f"{place.key}: the text is empty")
    file, content = _changed(settings, study_file, place, text.strip())
    if not file.resolve().is_relative_to(study_file.parent.resolve()):
        raise UserInputError(f"{place.key} cannot be changed here: {file} is outside the study's folder")
    before = file.read_bytes()
    write_file(file, _as_before(content, before))
    try:
        return file, read_study(Settings.read(study_file))
    except UserInputError:
        write_file(file, before)
        raise


def _as_before(content: str, before: bytes) -> bytes:
    """Return a text with the mark and the ends of lines that its file had."""
    content = content.removeprefix(BOM).replace("\r\n", "\n")
    if b"\r\n" in before:
        content = content.replace("\n", "\r\n")
    return content.encode("utf-8-sig" if before.startswith(BOM.encode()) else "utf-8")


def _changed(settings: Settings, study_file: Path, place: TextPlace, text: str) -> tuple[Path, str]:
    """Return the file to write, and its content."""
    if place.kind == "message" and not place.is_shipped:
        return place.file, _in_fluent(place.file, place.key, text)
    if place.kind in {"message", "own message"}:
        return _replaced(settings, study_file, place, text)
    document = read_document(place.file)
    if place.kind == "sheet":
        put_text(document, place.key.split("."), text)
    else:
        for path, words in worded_tables(document, place.language):
            if path == place.key:
                words[spelling_among(words, place.language)] = text
    return place.file, tomlkit.dumps(document)


def _replaced(settings: Settings, study_file: Path, place: TextPlace, text: str) -> tuple[Path, str]:
    """Return the study file with a message in ``[texts.LANGUAGE]``, or the file of messages that it names there."""
    own = settings.own_texts_file(place.language)
    message, _, wording = place.key.partition(".")
    wordings = _wordings(place, message) if wording else {}
    if own is not None:
        words = {f".{name}": each for name, each in (wordings | {wording: text}).items()} if wording else {"": text}
        lines = "".join(_attribute(name, each) for name, each in words.items())
        return own, f"{read_text(f'the file {own}', own).rstrip()}\n{message} ={lines}\n"
    document = read_document(study_file)
    texts = document.setdefault("texts", tomlkit.table(is_super_table=True))
    code = next((key for key in texts if code_of(key) == place.language), place.language)
    table = texts.setdefault(code, tomlkit.table())
    if not wording:
        table[message] = text
    elif message in table:
        table[message][wording] = text
    else:
        table[message] = wordings | {wording: text}
    return study_file, tomlkit.dumps(document)


def _attribute(name: str, text: str) -> str:
    return f"\n    {name} = {_indented(text, 8)}" if name else f" {_indented(text, 4)}"


def _indented(text: str, spaces: int) -> str:
    return text.replace("\n", "\n" + " " * spaces)


def _wordings(place: TextPlace, message: str) -> dict[str, str]:
    """Return all wordings of a message in its file: whatever replaces a message replaces all of them."""
    found = resource_patterns(FluentParser().parse(read_text(f"the file {place.file}", place.file)))
    return {name.partition(".")[2]: pattern_text(pattern) for name, pattern in found if name.startswith(f"{message}.")}


def _in_fluent(file: Path, key: str, text: str) -> str:
    """Return a file of messages in which one text is another, and every other character is as it was."""
    source = read_text(f"the file {file}", file)
    resource = FluentParser().parse(source)
    old = dict(resource_patterns(resource)).get(key)
    if old is None or old.span is None:
        raise UserInputError(f"{file}: there is no message {key} any more")
    new = f"{source[: old.span.start]}{_spaced(source, old, text)}{source[old.span.end :]}"
    given = FluentParser().parse(new)
    kept, made = _by_key(resource), _by_key(given)
    if kept.keys() != made.keys() or any(made[name] != kept[name] for name in kept if name != key):
        raise UserInputError(f"{file}: {key}: {text[:60]!r} is not well-formed; mind the braces")
    return new


def _spaced(source: str, old: Pattern, text: str) -> str:
    """Indent the lines after the first, and keep a first line that begins on a line of its own."""
    start = old.span.start if old.span else 0
    line = source.rfind("\n", 0, start) + 1
    before = source[line:start]
    spaces = len(before) if before and not before.strip() else 8
    # The span of a text that begins below its key begins with the end of the line of the key, or its own indentation.
    begun = re.match(r"\s*", source[start : old.span.end if old.span else start])
    lead = begun.group() if begun else ""
    if "\n" in lead:
        spaces = len(lead.rpartition("\n")[2])
    return f"{lead}{_indented(text, spaces or 8)}"


def _by_key(resource: Resource) -> dict[str, str]:
    """Return every text by its key, and what is not well-formed by its place."""
    texts = {name: pattern_text(pattern) for name, pattern in resource_patterns(resource)}
    serializer = FluentSerializer(with_junk=True)
    others = (entry for entry in resource.body if not isinstance(entry, Message | Term))
    return texts | {f" {n}": serializer.serialize_entry(entry) for n, entry in enumerate(others)}


def _messages(plan: SessionConfig) -> Iterator[TextPlace]:
    for written in plan.catalogue.written.values():
        if isinstance(written.entry, Term):
            continue
        kind = "own message" if _is_in_study_file(plan, written) else "message"
        for key, pattern in entry_patterns(written.entry):
            shown, literal = _as_shown(pattern)
            if literal:
                yield TextPlace(plan.language, written.file, key, pattern_text(pattern), kind, shown, literal)


def _is_in_study_file(plan: SessionConfig, written: Written) -> bool:
    return written.source == plan.catalogue.sources.get(OWN_TEXTS)


def _as_shown(pattern: Pattern) -> tuple[re.Pattern[str], int]:
    """Return what a message reads like when its variables are filled in, and its number of other characters."""
    parts, literal = [], 0
    for element in pattern.elements:
        if isinstance(element, TextElement):
            words = re.sub(r"\s+", " ", element.value)
            parts.append(re.escape(words))
            literal += len(words.strip())
        else:
            parts.append(".*?")
    return re.compile("".join(parts).strip()), literal


def _squeezed(text: str) -> str:
    return " ".join(text.split())


def _plainly(language: str, file: Path, key: str, text: str, kind: str) -> TextPlace:
    words = _squeezed(text)
    return TextPlace(language, file, key, text, kind, re.compile(re.escape(words)), len(words))


def _of_sheet(plan: SessionConfig) -> Iterator[TextPlace]:
    folder = plan.settings.resolve_asset("consent", plan.settings.consent.text)
    for file in sorted(folder.glob("*.toml")):
        if code_of(file.stem) == plan.language:
            for key, text in worded_strings(read_document(file)):
                yield _plainly(plan.language, file, key, text, "sheet")


def _of_questionnaires(plan: SessionConfig) -> Iterator[TextPlace]:
    for name in (plan.settings.about_you, *plan.settings.questionnaires):
        file = plan.settings.resolve_asset("questionnaires", name)
        if file.suffix == ".toml":
            for key, words in worded_tables(read_document(file), plan.language):
                text = str(words[spelling_among(words, plan.language)])
                yield _plainly(plan.language, file, key, text, "questionnaire")
