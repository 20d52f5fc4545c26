"""Which texts a person may have typed, or a machine may have put together; they are left out unless they are asked for.

A visitor can write a name into an answer, an experimenter into a reason, and a failure may name a place or a device.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kiosk.store.dataset.stored.kept import Kept, Record
from kiosk.study.declared.questionnaire import ShortText
from kiosk.study.events import AnswerGiven, BodyChanged, EndAsked, RobotLost, SpeechFailed

FREE: Mapping[str, frozenset[str]] = {
    EndAsked.__name__: frozenset({"reason"}),
    SpeechFailed.__name__: frozenset({"why"}),
    RobotLost.__name__: frozenset({"why"}),
    BodyChanged.__name__: frozenset({"why"}),
}
"""The fields of each kind of event that may hold any text at all."""


def safe_fields(record: Record, kept: Kept) -> dict[str, Any]:
    """The fields of an event without any that may hold free text; of unknown events nothing is safe."""
    if record.event is None:
        return {}
    free = FREE.get(record.type, frozenset())
    if isinstance(record.event, AnswerGiven) and is_free_text(record.event, kept):
        free = frozenset({"value"})
    return {name: value for name, value in record.fields.items() if name not in free}


def is_free_text(answer: AnswerGiven, kept: Kept) -> bool:
    """Whether an answer was typed; where the questionnaires cannot be read, any text may have been."""
    if not isinstance(answer.value, str):
        return False
    if kept.plan is None:
        return True
    asked = (kept.plan.about_you, *kept.plan.questionnaires)
    items = [item for questionnaire in asked for item in questionnaire.items if item.id == answer.item]
    return not items or any(isinstance(item, ShortText) for item in items)
