"""What a sitting follows: all that is fixed before its first event, except chance."""

from __future__ import annotations

from dataclasses import dataclass

from kiosk.assistant.qtable import QTable
from kiosk.assistant.wording import Catalogue
from kiosk.settings import Settings
from kiosk.study.condition import Condition
from kiosk.study.declared.information import Information
from kiosk.study.declared.questionnaire import Questionnaire
from kiosk.study.stages import Course


@dataclass(frozen=True)
class Plan:
    """Everything that a sitting follows, except chance and what happens in it; its words are in one language."""

    settings: Settings
    condition: Condition
    policy: QTable
    catalogue: Catalogue
    information: Information
    about_you: Questionnaire
    questionnaires: tuple[Questionnaire, ...]
    deck: tuple[str, ...]
    practice_deck: tuple[str, ...]

    @property
    def language(self) -> str:
        """The language of the sitting."""
        return self.catalogue.language

    @property
    def course(self) -> Course:
        """Its stages in their order; raises BadInput if there can be no such course."""
        return Course.of(self.settings.stages)
