"""What the sittings followed: questionnaires, information sheets, policies and settings, each under its hash."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from kiosk.settings import Settings
from kiosk.store.dataset.files import write_text
from kiosk.store.dataset.stored.followed import Followed
from kiosk.study.plan import Plan

PUBLISHED = frozenset(
    {
        "title",
        "languages",
        "stages",
        "about_you",
        "questionnaires",
        "game",
        "practice",
        "assistance",
        "timing",
        "idle",
        "voice",
        "screen",
    }
)
"""The parts of a study file that say nothing of people, devices, keys or seeds; a new part is not among them."""

_PARTLY: dict[str, bool | set[str]] = {"allocation": {"quotas", "block"}, "consent": {"adult"}}
"""What else is told of other parts: who wants to analyse an allocation as it was made has to know its blocks."""

_SHOWN = 12
"""Characters of a hash in a file's name."""


def write_materials(folder: Path, study: Followed) -> None:
    """Write everything once, however many sittings followed it."""
    for name, content in {material for plan in study.plans for material in _materials(plan)}:
        write_text(folder / name, content)


def _materials(plan: Plan) -> Iterator[tuple[str, str]]:
    for questionnaire in (plan.about_you, *plan.questionnaires):
        yield _file(f"questionnaires/{questionnaire.id}", questionnaire.sha256), _pretty(questionnaire)
    yield _file(f"information/{plan.language}", plan.information.sha256), _pretty(plan.information)
    yield _file("policies/policy", plan.policy.sha256), plan.policy.to_json()
    yield _file("settings/settings", plan.settings.sha256), _published(plan.settings)
    decks = json.dumps({"game": plan.deck, "practice": plan.practice_deck}, ensure_ascii=False, indent=2) + "\n"
    yield _file("decks/decks", hashlib.sha256(decks.encode()).hexdigest()), decks


def _file(name: str, sha256: str) -> str:
    return f"{name}-{sha256[:_SHOWN]}.json"


def _pretty(content: BaseModel) -> str:
    return content.model_dump_json(indent=2) + "\n"


def _published(settings: Settings) -> str:
    told: dict[str, Any] = json.loads(settings.model_dump_json(include=_PARTLY | dict.fromkeys(PUBLISHED, True)))
    return json.dumps(told, ensure_ascii=False, indent=2) + "\n"
