"""Policies, plans and sentences for tests. Nothing here reads ``policies/``: a test's table is made on the spot."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

from kiosk.assistance.policy import ACTIONS, NO_GATE, STATES, ActionSpec, Gate, QTable, State
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, STAGES, Settings
from kiosk.experiment.booth_status import BoothStatus, DayCounts, PartStatus, utc
from kiosk.experiment.condition import Condition
from kiosk.experiment.information import ConsentPage, Information, Page, Purpose
from kiosk.experiment.items import Integer, Likert, Multiple, Option, ShortText, Single
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.experiment.session_config import SessionConfig, Translation
from kiosk.game import Board

SHORT = ("introduction", "game", "result", "questions")
"""The stages around a game, with nothing to be decided beforehand."""

WITH_PIN = f'[experimenter]\npin_hash = "scrypt:10:{"0" * 32}:{"0" * 64}"\n'
"""The lines of a study file for a PIN of the right form, which no digits open."""

CATALOGUES = {folder.name: Catalogue(folder) for folder in sorted((ASSETS / "sentences").iterdir())}
ENGLISH, ITALIAN = CATALOGUES["en"], CATALOGUES["it"]


def without_line(sentence: str) -> str:
    """Return a sentence of a refusal without the line that it names at its end."""
    return re.sub(r" \(line \d+\)$", "", sentence)


def _deck(name: str) -> tuple[str, ...]:
    return tuple(sorted(picture.stem for picture in (ASSETS / "cards" / name).glob("*.svg")))


ANIMALS, FRUIT = _deck("animals"), _deck("fruit")


def likert(name: str, **more: Any) -> Likert:
    """Return an item of five points."""
    ends = {"lowest": {"en": "not at all"}, "highest": {"en": "very much"}}
    return Likert.model_validate({"id": name, "kind": "likert", "text": {"en": f"{name}?"}} | ends | more)


def questionnaire(name: str, *items: Any, **more: Any) -> Questionnaire:
    """Return a questionnaire of these items."""
    return Questionnaire(id=name, version="1", note="made for tests", items=items, **more)


def options(*names: str) -> tuple[Option, ...]:
    """Options of these names."""
    return tuple(Option(id=name, text={"en": name}) for name in names)


CLOSING = questionnaire("closing", likert("enjoyed"), likert("helped"), likert("understood"))
ABOUT_YOU = questionnaire(
    "about-you",
    Integer(id="age", kind="integer", text={"en": "age?"}, lowest=18, highest=120, required=True),
    Single(id="robots", kind="single", text={"en": "robots?"}, options=options("none", "stories", "owns")),
    Multiple(id="languages", kind="multiple", text={"en": "languages?"}, options=options("en", "it", "es")),
    ShortText(id="job", kind="text", text={"en": "job?"}, longest=20),
    per_page=3,
)
INFORMATION = Information(
    version="7",
    about=Page(title="About", paragraphs=("what it is about",)),
    consent=ConsentPage(
        title="Consent",
        paragraphs=("what is agreed to",),
        purposes=(
            Purpose(id="store", text="store it"),
            Purpose(id="share", text="share it", required=False),
        ),
    ),
    debrief=Page(title="Debrief", paragraphs=("what it was about",)),
)
"""An information sheet with two purposes, of which one is required."""


def with_needed_boxes(page: ConsentPage) -> ConsentPage:
    """Return a page on which two boxes have to be ticked, with what its first two points say."""
    stated = zip(("take_part", "store"), page.points, strict=False)
    needed = tuple(Purpose(id=name, text=text) for name, text in stated)
    # The boxes say what the first point says.
    shorter = {"points": page.points[1:], "signs": page.signs[1:], "purposes": (*needed, *page.purposes)}
    return page.model_copy(update=shorter)


ITALIAN_INFORMATION = INFORMATION.model_copy(
    update={"about": Page(title="Di che cosa si tratta", paragraphs=("di questo",))}
)


def policy_that(choose: Callable[[State], ActionSpec], gate: Gate = NO_GATE) -> QTable:
    """Return a table whose greedy action in every state is the chosen one."""
    values = [[float(action is choose(state)) for action in ACTIONS] for state in STATES]
    return QTable.freeze("made for a test", gate, values, {"by": "hand"})


def always(action: ActionSpec, gate: Gate = NO_GATE) -> QTable:
    """Return a table that always takes this action."""
    return policy_that(lambda _: action, gate)


def mixed(seed: int = 0, gate: Gate = NO_GATE) -> QTable:
    """Return a table that takes any action anywhere, drawn by a seed."""
    rng = Random(seed)
    chosen = {state: rng.choice(list(ACTIONS)) for state in STATES}
    return policy_that(chosen.__getitem__, gate)


def plan(
    condition: Condition = Condition.TOM,
    policy: QTable | None = None,
    stages: tuple[str, ...] = SHORT,
    **settings: Any,
) -> SessionConfig:
    """Return a plan for a session of these stages; ``settings`` are sections of the study file."""
    return SessionConfig(
        settings=Settings(stages=stages, **settings),
        condition=condition,
        policy=policy or mixed(),
        catalogue=ENGLISH,
        information=INFORMATION,
        about_you=ABOUT_YOU,
        questionnaires=(CLOSING,),
        deck=ANIMALS,
        practice_deck=FRUIT,
        translations=(Translation(ENGLISH, INFORMATION), Translation(ITALIAN, ITALIAN_INFORMATION)),
    )


def whole(condition: Condition = Condition.TOM, policy: QTable | None = None, **settings: Any) -> SessionConfig:
    """Return a plan for a session of all stages that there are."""
    return plan(condition, policy, STAGES, **settings)


def board_of(*rows: str) -> Board:
    """Return a board from one word per row, one letter per card: ``board_of("abc", "cab")``."""
    return Board(len(rows), len(rows[0]), tuple("".join(rows)))


STATUS = BoothStatus(
    at=utc(0),
    started_at=utc(0),
    version="1",
    pid=7,
    site="",
    study="S",
    study_sha256="0",
    kind="person",
    stage="attract",
    stage_since=utc(0),
    paused=False,
    supervised=True,
    today=DayCounts(),
    ended=(),
    parts=(PartStatus("voice", ok=True, message="wörds"),),
    disk_free_mib=900,
    last_backup_at=None,
)
"""A booth that waits for a visitor."""

PLAYING = replace(
    STATUS,
    at=utc(600_000),
    stage="game",
    stage_since=utc(420_000),
    today=DayCounts(begun=3, completed=2, last_hour=1),
    parts=(PartStatus("voice", ok=True, message="it speaks"),),
)
"""A booth with a game under way for three minutes."""
