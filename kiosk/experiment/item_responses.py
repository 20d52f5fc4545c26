"""The answers of a session, read from its events: each item with its times and changes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from kiosk.experiment.events import (
    BackPressed,
    Event,
    HiddenItemsChanged,
    QuestionnairePageShown,
    ResponseGiven,
    StageEntered,
)
from kiosk.experiment.intervals import Interval, elapsed_ms
from kiosk.experiment.items import Answer, NotApplicable, Response
from kiosk.experiment.outcomes import Stage
from kiosk.lazy_dataclass import dataclass, with_values

OF_RESPONSES: frozenset[type[Event]] = frozenset(
    {StageEntered, HiddenItemsChanged, QuestionnairePageShown, ResponseGiven, BackPressed}
)
"""The events that change the responses."""


@dataclass(frozen=True)
class ItemResponse:
    """One item of a session; times in ms since its page was shown first, without pauses.

    ``response`` is None where nothing was answered, or nothing was left of it. ``first_ms`` and ``last_ms`` are the
    times of the first and the last answer, also of one that was taken back; None where there was none. ``changes``
    counts the answers that differ from the one before; the first is no change.
    """

    questionnaire: str
    item: str
    response: Response | None = None
    first_ms: int | None = None
    last_ms: int | None = None
    changes: int = 0
    hidden: bool = False
    """Whether the item's condition did not hold, so that it was not asked, or its answer was withdrawn."""

    @property
    def value(self) -> Answer | None:
        """The answer; None if there is none, also where the item does not apply."""
        return None if isinstance(self.response, NotApplicable) else self.response

    @property
    def does_not_apply(self) -> bool:
        """Whether the visitor said that the item does not apply."""
        return isinstance(self.response, NotApplicable)

    def answered(self, value: Response | None, after_ms: int) -> ItemResponse:
        """Add one more answer."""
        value = effective_answer(value)
        first = after_ms if self.first_ms is None else self.first_ms
        changed = self.first_ms is not None and value != self.response
        return replace(self, response=value, first_ms=first, last_ms=after_ms, changes=self.changes + changed)


def effective_answer(value: Response | None) -> Response | None:
    """Give an answer, or None for one that says nothing: an empty text, or none of the options."""
    return None if value in {"", ()} else value


class ResponsesReader:
    """Reads events into the answers of each stage since it was entered last, and into what was shown."""

    def __init__(self) -> None:
        self.shown: dict[str, list[str]] = {}
        self._by_stage: dict[Stage, dict[tuple[str, str], ItemResponse]] = {}
        self._here: dict[tuple[str, str], ItemResponse] = {}
        self._questionnaire = ""
        self._shown_ms: dict[tuple[str, str], int] = {}
        self._shown_by_stage: dict[Stage, dict[tuple[str, str], int]] = {}
        self._hidden_by_stage: dict[Stage, dict[str, tuple[str, ...]]] = {}
        self._hidden: dict[str, tuple[str, ...]] = {}
        self.goes_back = False

    @property
    def hidden(self) -> frozenset[tuple[str, str]]:
        """The items that their conditions hide, by questionnaire and item."""
        by_questionnaire = (pair for hidden in self._hidden_by_stage.values() for pair in hidden.items())
        return frozenset((questionnaire, item) for questionnaire, items in by_questionnaire for item in items)

    @property
    def given(self) -> dict[tuple[str, str], ItemResponse]:
        """The responses, by questionnaire and item."""
        return {key: response for given in self._by_stage.values() for key, response in given.items()}

    def take(self, event: Event, pauses: Collection[Interval]) -> None:
        """Read an event, after these pauses."""
        match event:
            case StageEntered(stage=stage):
                # A visitor who goes back finds the answers given there; a stage that begins anew has none.
                if not self.goes_back:
                    self._by_stage[stage], self._shown_by_stage[stage], self._hidden_by_stage[stage] = {}, {}, {}
                self._here = self._by_stage.setdefault(stage, {})
                self._shown_ms = self._shown_by_stage.setdefault(stage, {})
                self._hidden = self._hidden_by_stage.setdefault(stage, {})
                self._questionnaire = ""
            case HiddenItemsChanged(questionnaire=questionnaire, hidden=hidden, withdrawn=withdrawn):
                self._hidden[questionnaire] = hidden
                lost = {(questionnaire, item) for item in withdrawn} & self._here.keys()
                self._here |= {key: with_values(self._here[key], response=None) for key in lost}
            case QuestionnairePageShown(questionnaire=questionnaire, items=items, at_ms=at_ms):
                self._questionnaire = questionnaire
                for item in items:
                    self._shown_ms.setdefault((questionnaire, item), at_ms)
                shown = self.shown.setdefault(questionnaire, [])
                shown += [item for item in items if item not in shown]
            case ResponseGiven(item=item, value=value, at_ms=at_ms):
                key = (self._questionnaire, item)
                after_ms = elapsed_ms(self._shown_ms.get(key, at_ms), at_ms, pauses)
                self._here[key] = self._here.get(key, ItemResponse(*key)).answered(value, after_ms)
        if not isinstance(event, StageEntered | QuestionnairePageShown):
            self.goes_back = isinstance(event, BackPressed)
