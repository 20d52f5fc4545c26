"""The keys of a study file for people: an example and a reference page, made of the declarations."""

from __future__ import annotations

import inspect
import re
from collections.abc import Collection, Iterator, Sequence
from textwrap import wrap
from types import NoneType
from typing import Annotated, Any, Literal, get_args, get_origin

import tomlkit
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from kiosk.config import Settings
from kiosk.errors import bounds
from kiosk.units import Unit

WIDTH = 100
"""Characters of a line in a study file."""

_TYPES = {bool: "true or false", int: "whole number", float: "number", str: "text", dict: "table"}

_HEAD = """\
# A study file with every key, as it is without one: this follows the study wherever it says anything. Keep only the
# keys that are to be different. Times are in milliseconds (ms). Check it with: recollect study check FILE
"""

_PAGE = """\
# The study file: every key

A study file is TOML. A key that it leaves out has its default, so an empty file is the study of the paper.
`recollect study new DIR` writes a folder with a whole study, `recollect study reference --toml` prints a file with
every key, and `recollect study check FILE` checks a file with everything that it names. A name with a slash or an
extension is a path from the study file's folder. Any other name is first looked up in `assets/` and `policies/`, and
then in the study file's folder.

This page is printed by `recollect study reference`; change the declarations in `kiosk/config`, not the page.
"""


def as_study_file(settings: Settings) -> str:
    """Return a study file that sets every key to what it is in ``settings``, each under its sentence."""
    parts, described = [_HEAD], set[type[BaseModel]]()
    for section, model in _sections(settings):
        kind = type(model)
        if kind in described:
            lines = (f"{key} = {_toml(getattr(model, key))}\n" for key, _ in _keys(kind))
            parts.append(f"\n[{section}]\n{''.join(lines)}")
            continue
        if section:
            parts.append(f"\n{_comment(_described(kind))}\n[{section}]\n")
        parts += (_entry(key, field, getattr(model, key)) for key, field in _keys(kind))
        described.add(kind)
    return "".join(parts)


def as_short_study_file(settings: Settings, shown: Collection[str], head: str) -> str:
    """Return a study file with the keys that differ from the defaults, and those in ``shown``."""
    parts, usual = [head], Settings()
    for section, model in _sections(settings):
        if section.startswith("conditions.") and settings.conditions == usual.conditions:
            continue
        defaults = type(model)()
        keys = [
            (key, field)
            for key, field in _keys(type(model))
            if getattr(model, key) != getattr(defaults, key) or (f"{section}.{key}" if section else key) in shown
        ]
        if keys and section:
            parts.append(f"\n{_comment(_described(type(model)))}\n[{section}]\n")
        parts += (_entry(key, field, getattr(model, key)) for key, field in keys)
    return "".join(parts)


def as_page(model: type[Settings]) -> str:
    """Return the reference of every key, as Markdown."""
    parts = [_PAGE]
    written = set[type[BaseModel]]()
    for section, settings in _sections(model(), "NAME"):
        if type(settings) in written:
            continue
        written.add(type(settings))
        heading = f"## [{section}]\n\n{_described(type(settings))}" if section else "## Above all sections"
        parts.append(f"\n{heading}\n\n| key | what it sets | values | default |\n|---|---|---|---|\n")
        parts += (_row(key, field, getattr(settings, key)) for key, field in _keys(type(settings)))
    return "".join(parts)


def _sections(settings: Settings, name: str = "") -> Iterator[tuple[str, BaseModel]]:
    """Yield the study file itself, without a name, and every section of it; declared ones may get another name."""
    yield "", settings
    for key in type(settings).model_fields:
        match getattr(settings, key):
            case BaseModel() as section:
                yield key, section
            case {} as declared:
                sections = {each: model for each, model in declared.items() if isinstance(model, BaseModel)}
                yield from ((f"{key}.{name or each}", model) for each, model in sections.items())


def _keys(model: type[BaseModel]) -> Iterator[tuple[str, FieldInfo]]:
    """Yield what is no section."""
    for key, field in model.model_fields.items():
        declared = [*field.default.values()] if isinstance(field.default, dict) else [field.default]
        if not any(isinstance(each, BaseModel) for each in declared):
            yield key, field


def _described(model: type[BaseModel]) -> str:
    """Return a section's own sentences, in one paragraph each."""
    paragraphs = inspect.cleandoc(model.__doc__ or "").split("\n\n")
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs).replace("``", "`")


def _comment(text: str) -> str:
    paragraphs = text.split("\n\n")
    return "\n".join(f"# {line}" for paragraph in paragraphs for line in wrap(paragraph, WIDTH))


def _sentence(field: FieldInfo) -> str:
    """Return what a key sets, and in which unit."""
    unit = next((each.name for each in field.metadata if isinstance(each, Unit)), "")
    described = field.description or ""
    said = not unit or re.search(rf"\b{unit}\b", described)
    return described if said else f"{described.removesuffix('.')} ({unit})."


def _entry(key: str, field: FieldInfo, value: object) -> str:
    set_to = f"# {key} = (not set)" if value is None else f"{key} = {_toml(value)}"
    return f"\n{_comment(_sentence(field))}\n{set_to}\n"


def _row(key: str, field: FieldInfo, value: object) -> str:
    default = "" if value is None else f"`{_toml(value, WIDTH * WIDTH)}`"
    return f"| `{key}` | {_sentence(field)} | {_may_be(field)} | {default} |\n"


def _toml(value: object, width: int = WIDTH) -> str:
    """Return a value as TOML; a list that is too long for a line gets a line for each entry."""
    if isinstance(value, dict):
        inner = ", ".join(f"{key} = {_toml(each)}" for key, each in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, tuple):
        entries = [_toml(each) for each in value]
        line = f"[{', '.join(entries)}]"
        return line if len(line) <= width else "\n".join(("[", *(f"    {entry}," for entry in entries), "]"))
    return tomlkit.item(value).as_string()


def _may_be(field: FieldInfo) -> str:
    """Return what may be given for a key, in words."""
    annotation, declared = field.annotation, list(field.metadata)
    if NoneType in get_args(annotation):
        annotation = next(each for each in get_args(annotation) if each is not NoneType)
    limits = _bounds(declared)
    inner = next((each for each in get_args(annotation) if get_origin(each) is Annotated), None)
    if inner is not None:
        each_is = next(iter(get_args(inner)[1:]))
        limits = f"each {_bounds(each_is.metadata)}"
    return ", ".join(filter(None, (_type(annotation), limits)))


def _bounds(declared: Sequence[Any]) -> str:
    """Return the bounds of a number; its unit stands in its sentence."""
    return bounds([each for each in declared if not isinstance(each, Unit)])


def _type(annotation: Any) -> str:
    origin = get_origin(annotation) or annotation
    if origin is Literal:
        return " or ".join(f"`{_toml(each)}`" for each in get_args(annotation))
    if origin is tuple:
        of = get_args(annotation)
        return "list of texts" if of[-1] is Ellipsis else f"list of {len(of)} numbers"
    return _TYPES[origin]
