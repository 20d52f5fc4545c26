"""Whether the questionnaires of a study are those that visitors were asked before, where their versions say so."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from kiosk import BadInput
from kiosk.findings import Finding
from kiosk.store.database import FILE, open_for_reading
from kiosk.study.declared.differences import differences
from kiosk.study.declared.questionnaire import QUESTIONNAIRES, Questionnaire
from kiosk.study.plan import Plan

WHAT = "questionnaires"
_REMEDY = "give it a new version; then the data set tells both apart"

_STORED = """
    SELECT content FROM source WHERE sha256 IN (
        SELECT about_you_source FROM sitting WHERE NOT simulated
        UNION SELECT questionnaire_source FROM sitting WHERE NOT simulated
    ) ORDER BY sha256
"""


def forms(folder: Path, plan: Plan) -> Iterator[Finding]:
    """Find questionnaires that changed since people answered them, and have their version still."""
    stored = _stored(folder) if (folder / FILE).exists() else []
    changed = False
    for asked in (plan.about_you, *plan.questionnaires):
        older = (each for each in stored if (each.id, each.version) == (asked.id, asked.version))
        differ = dict.fromkeys(name for each in older for name in differences(asked, each))
        if differ:
            changed = True
            what = f"{asked.id!r} is still version {asked.version!r}, but visitors were asked otherwise before: "
            yield Finding.warning(WHAT, what + ", ".join(differ), _REMEDY)
    if not changed:
        yield Finding.good(WHAT, "nothing was changed without a new version")


def _stored(folder: Path) -> list[Questionnaire]:
    """Every questionnaire that is stored; the finding of the database says it if they cannot be read."""
    found: list[Questionnaire] = []
    try:
        with closing(open_for_reading(folder)) as connection:
            contents = [content for (content,) in connection.execute(_STORED)]
    except (BadInput, sqlite3.Error):
        return found
    for content in contents:
        try:
            several = content.lstrip().startswith("[")
            found += QUESTIONNAIRES.validate_json(content) if several else [Questionnaire.model_validate_json(content)]
        except ValueError:
            # An older program wrote it, which asked in another form altogether.
            continue
    return found
