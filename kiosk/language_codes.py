"""Compare and spell language codes (BCP 47), such as ``pt-BR``; the facts about languages are CLDR's, from Babel.

It stands below the packages: voices, robots, texts and tables all have codes of languages.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

# Babel is imported by what asks it for a fact: most of what a start does only spells codes.
# ruff: noqa: PLC0415

_CODE = re.compile(
    r"(?P<language>[a-z]{2,3})(-(?P<extended>[a-z]{3}))?(-(?P<script>[a-z]{4}))?(-(?P<region>[a-z]{2}|\d{3}))?"
    r"(?P<rest>(-[a-z0-9]{1,16})*)"
)
_MORE_ALIASES = {"no": "nb"}
"""CLDR's own list leaves out that "Norwegian" without more means Bokmål."""

_EXACT, _PARENT, _NO_REGION = 0, 2, 4
_SCRIPT, _VARIANT = 1, 8
"""How far a code is from another one of the same language; whatever differs adds up."""


class _Parts(NamedTuple):
    language: str
    script: str
    region: str
    rest: str


def standard(code: str) -> str:
    """Spell a code as BCP 47 does: ``pt_br`` becomes ``pt-BR``; raises ValueError if it is none."""
    parts = _parts(code)
    if parts is None:
        raise ValueError(f"{code[:40]!r} is no language code, such as 'de' or 'pt-BR'")
    return "-".join(part for part in (*parts[:3], parts.rest) if part)


def is_right(code: str) -> bool:
    """Return whether this is written like a language code."""
    return _parts(code) is not None


def distance(wanted: str, offered: str) -> int | None:
    """Measure how far an offered code is from the wanted one; None if they do not mean the same language.

    0 is the same; the code of a wider region is nearer than one without a region. Two different regions, and two
    different scripts, never mean the same.
    """
    one, other = _meant(wanted), _meant(offered)
    if one is None or other is None or one.language != other.language:
        return None
    if one.script and other.script and one.script != other.script:
        return None
    far = _region_distance(one, other)
    if far is None:
        return None
    return far + _SCRIPT * (one.script != other.script) + _VARIANT * (one.rest != other.rest)


def with_region(code: str) -> str:
    """Add the region where a language is mostly spoken, if the code has none: ``it`` becomes ``it-IT``."""
    parts = _meant(code)
    if parts is None or parts.region:
        return code
    likely = _global("likely_subtags").get(parts.language, "").split("_")
    return f"{parts.language}-{likely[-1]}" if len(likely) > 1 else code


def babel_codes(code: str) -> list[str]:
    """List the codes by which Babel knows a language, the best first and English last.

    Babel does not know every language, so there has to be one to fall back on.
    """
    parts = _meant(code)
    tried = [] if parts is None else [(*parts[:3],), (parts.language, "", parts.region), (parts.language,)]
    codes = ["-".join(part for part in each if part) for each in tried]
    return [each for each in dict.fromkeys(codes) if _is_known(each)] + ["en"]


def _is_known(code: str) -> bool:
    from babel import Locale, UnknownLocaleError

    try:
        Locale.parse(code, sep="-")
    except (UnknownLocaleError, ValueError):
        return False
    return True


def _global(table: str) -> Mapping[str, str]:
    from babel.core import get_global

    return get_global(table)  # type: ignore[arg-type]  # its name is one of several


def _parts(code: str) -> _Parts | None:
    found = _CODE.fullmatch(code.strip().replace("_", "-").lower())
    if found is None:
        return None
    # Mandarin may stand as "cmn" or, in an older spelling, as "zh-cmn".
    language = found["extended"] or found["language"]
    return _Parts(
        language, (found["script"] or "").title(), (found["region"] or "").upper(), found["rest"].removeprefix("-")
    )


def _meant(code: str) -> _Parts | None:
    """Return the parts of a code, with one code for what several stand for."""
    parts = _parts(code)
    if parts is None:
        return None
    alias = _global("language_aliases").get(parts.language, parts.language)
    language, _, script = _MORE_ALIASES.get(alias, alias).partition("_")
    return parts._replace(language=language, script=parts.script or script)


def _region_distance(wanted: _Parts, offered: _Parts) -> int | None:
    if wanted.region == offered.region:
        return _EXACT
    if not wanted.region or not offered.region:
        return _NO_REGION
    parent = _global("parent_exceptions").get(f"{wanted.language}_{wanted.region}")
    return _PARENT if parent == f"{offered.language}_{offered.region}" else None
