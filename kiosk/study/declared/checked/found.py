"""What a study that could be read, or could not, means for a booth: file, policy, languages, PIN and keys."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kiosk.assistant.qtable import NONE
from kiosk.findings import Finding
from kiosk.settings import Experimenter, Keys
from kiosk.study.declared.checked.cautions import cautions, minutes
from kiosk.study.plan import Study

FILE, POLICY, LANGUAGES, PIN, KEYS = "study file", "policy", "languages", "PIN", "keys"

CARD = ".md"
"""Beside a policy's numbers stands a page that says what they were made for."""

SHORT_SHA = 8
_MEND = "mend the study file; 'recollect study check FILE' reads it again"


def faults(sentences: Sequence[str]) -> Iterator[Finding]:
    """Whatever keeps a study file from being used."""
    return (Finding.bad(FILE, sentence, _MEND) for sentence in sentences)


def file(study: Study) -> Iterator[Finding]:
    """What the study is, and what of it may not be meant."""
    longest = max(round(minutes(plan)) for plan in study.plans)
    yield Finding.good(FILE, f"{study.settings.title!r}, about {longest} minutes, {study.settings.sha256[:SHORT_SHA]}")
    for caution in cautions(study):
        yield Finding.warning(FILE, caution, "change the study file, if it is not meant so")


def policy(study: Study) -> Iterator[Finding]:
    """The frozen table, and the page about it."""
    table = study.plans[0].policy
    words = f"{table.name} {table.sha256[:SHORT_SHA]}"
    name = study.settings.assistance.policy
    card = None if name == NONE else study.settings.find("policies", name).with_suffix(CARD)
    if card is None or card.is_file():
        yield Finding.good(POLICY, words)
    else:
        yield Finding.warning(POLICY, f"{words}; no page says how it was made", f"write {card}")


def languages(study: Study) -> Iterator[Finding]:
    """The languages that a visitor can choose, with their sentences and sheets."""
    plans = ", ".join(f"{plan.language} ({len(plan.catalogue.messages)} messages)" for plan in study.plans)
    yield Finding.good(LANGUAGES, plans)


def pin(experimenter: Experimenter) -> Iterator[Finding]:
    """Whether the kiosk is closed, or open for trials alone."""
    if experimenter.pin:
        yield Finding.good(PIN, "set")
    else:
        remedy = "put what 'recollect study pin' prints into the study file, under [experimenter]"
        words = "none: every sitting is a trial, which is not exported, and 'recollect keep' does not start"
        yield Finding.warning(PIN, words, remedy)


def keys(chords: Keys) -> Iterator[Finding]:
    """Whether the experimenter can get in and out; chords that are none, or double, are refused with the file."""
    without = [name for name in ("panel", "leave") if not getattr(chords, name)]
    if without:
        remedy = f"give keys.{without[0]} a chord, such as 'Ctrl+Shift+P'"
        yield Finding.warning(KEYS, f"there is none for {' and '.join(without)}", remedy)
    else:
        yield Finding.good(KEYS, f"{chords.panel} opens the panel, {chords.leave} leaves the kiosk")
