"""Files that translators work with: write the texts of a study as PO or XLIFF, and read them back."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path
from xml.parsers import expat

from babel.messages.catalog import Catalog
from babel.messages.pofile import PoFileError, read_po, write_po

from kiosk import UserInputError
from kiosk.config import read_text
from kiosk.files import write_file
from kiosk.language_codes import standard
from kiosk.study.translations import State, Translation, Unit

PO, XLIFF = ".po", (".xliff", ".xlf")
_XLIFF = "urn:oasis:names:tc:xliff:document:1.2"


def export_texts(translation: Translation, file: Path) -> int:
    """Write all texts as PO or XLIFF 1.2, by the file's ending; returns how many. Raises UserInputError."""
    units = translation.units()
    if file.suffix.lower() == PO:
        content = _as_po(translation, units)
    elif file.suffix.lower() in XLIFF:
        content = _as_xliff(translation, units)
    else:
        raise UserInputError(f"{file}: the name must end in {PO} or {' or '.join(XLIFF)}")
    write_file(file, content)
    return len(units)


def import_texts(file: Path, translation: Translation) -> dict[str, str]:
    """Read the translated texts of a PO or XLIFF file, by their keys.

    Raises UserInputError if it is neither, or is of another language.
    """
    name = f"the file {file}"
    text = read_text(name, file)
    if file.suffix.lower() == PO:
        language, texts = _from_po(name, text)
    elif file.suffix.lower() in XLIFF:
        language, texts = _from_xliff(name, text)
    else:
        raise UserInputError(f"{file}: the name must end in {PO} or {' or '.join(XLIFF)}")
    if language and standard(language) != translation.language:
        raise UserInputError(f"{name} is in {language!r}, not in {translation.language!r}")
    return texts


def _as_po(translation: Translation, units: Sequence[Unit]) -> bytes:
    catalog = Catalog(project=translation.settings.title, version="1", charset="utf-8", fuzzy=False)
    catalog.header_comment = f"# {translation.settings.title}: from {translation.source_language}."
    for unit in units:
        fresh = "" if unit.state is State.UNCHANGED else unit.target
        catalog.add(unit.source, fresh, context=unit.key, auto_comments=unit.note.splitlines())
    written = io.BytesIO()
    write_po(written, catalog, width=0, omit_header=True, sort_output=False)
    # The header names the language; Babel's own has dates, which would differ from file to file.
    head = (
        'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=UTF-8\\n"\n"Content-Transfer-Encoding: 8bit\\n"\n'
        f'"Language: {translation.language}\\n"\n\n'
    )
    return head.encode() + written.getvalue()


def _from_po(name: str, text: str) -> tuple[str, dict[str, str]]:
    try:
        catalog = read_po(io.StringIO(text), abort_invalid=True)
    except (PoFileError, ValueError) as error:
        raise UserInputError(f"{name} is not a PO file: {error}") from error
    told = {str(key): str(value) for key, value in catalog.mime_headers} if text.strip() else {}
    texts = {
        message.context: str(message.string)
        for message in catalog
        if message.context and message.string and not message.fuzzy
    }
    found = re.search(r'^"Language: ([\w-]+)', text, re.MULTILINE)
    if not texts and not found:
        raise UserInputError(f"{name} is not a PO file of this study: no entry has a msgctxt")
    return (found[1] if found else told.get("Language", "")), texts


def _as_xliff(translation: Translation, units: Sequence[Unit]) -> bytes:
    ET.register_namespace("", _XLIFF)
    root = ET.Element(f"{{{_XLIFF}}}xliff", {"version": "1.2"})
    for part in dict.fromkeys(unit.part for unit in units):
        about = {"original": part, "datatype": "plaintext", "source-language": translation.source_language}
        file = ET.SubElement(root, f"{{{_XLIFF}}}file", about | {"target-language": translation.language})
        body = ET.SubElement(file, f"{{{_XLIFF}}}body")
        for unit in (unit for unit in units if unit.part == part):
            told = ET.SubElement(body, f"{{{_XLIFF}}}trans-unit", {"id": unit.key, "xml:space": "preserve"})
            ET.SubElement(told, f"{{{_XLIFF}}}source").text = unit.source
            done = unit.target if unit.state is not State.UNCHANGED else ""
            state = "translated" if done else "needs-translation"
            ET.SubElement(told, f"{{{_XLIFF}}}target", {"state": state}).text = done
            if unit.note:
                ET.SubElement(told, f"{{{_XLIFF}}}note").text = unit.note
    ET.indent(root)
    return bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True)) + b"\n"


def _from_xliff(name: str, text: str) -> tuple[str, dict[str, str]]:
    _refuse_entities(name, text)
    try:
        root = ET.fromstring(text)  # noqa: S314 - a document type, which entities need, was refused
    except ET.ParseError as error:
        raise UserInputError(f"{name} is not XLIFF: {error}") from error
    if root.tag != f"{{{_XLIFF}}}xliff":
        raise UserInputError(f"{name} is not XLIFF 1.2, which 'recollect study translations --write' makes")
    space = {"x": _XLIFF}
    language = next((each.get("target-language", "") for each in root.iterfind("x:file", space)), "")
    texts: dict[str, str] = {}
    for unit in root.iterfind(".//x:trans-unit", space):
        target = unit.find("x:target", space)
        text = "" if target is None else "".join(target.itertext())
        if text.strip():
            texts[unit.get("id", "")] = text
    return language, texts


def _refuse_entities(name: str, text: str) -> None:
    """Refuse a document type: with entities, a short file can become gigabytes, or read other files."""

    def refuse(*_: object) -> None:
        raise UserInputError(f"{name} has a document type (<!DOCTYPE), which is refused; XLIFF needs none")

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)  # noqa: FBT003 - expat's own
    except expat.ExpatError as error:
        raise UserInputError(f"{name} is not XLIFF: {error}") from error
