"""What a sitting follows: all that is fixed before its first event, except chance."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

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

    def lying_with(self, other: Settings) -> Plan:
        """The same plan, whose settings look for what they name by a path where these do."""
        return replace(self, settings=self.settings.lying_with(other))

    @property
    def course(self) -> Course:
        """Its stages in their order; raises BadInput if there can be no such course."""
        return Course.of(self.settings.stages)


@dataclass(frozen=True)
class Source:
    """Where something came from that a study file calls by name.

    ``sha256`` is the hash that goes into records where there is one; that of a folder is over its files. ``unused`` is
    what has the same name beside the study file, and was not taken.
    """

    key: str
    name: str
    path: Path
    is_shipped: bool
    sha256: str
    version: str | None = None
    unused: Path | None = None
    pictures: tuple[Path, ...] = ()


@dataclass(frozen=True)
class Study:
    """A study, ready to be run: a plan for each of its languages, alike in all but words."""

    plans: tuple[Plan, ...]
    sources: tuple[Source, ...] = ()

    @property
    def settings(self) -> Settings:
        """The study file."""
        return self.plans[0].settings

    @property
    def own_pictures(self) -> tuple[Path, ...]:
        """The pictures that do not come with the program, each once."""
        return tuple(dict.fromkeys(file for each in self.sources if not each.is_shipped for file in each.pictures))

    @property
    def languages(self) -> tuple[str, ...]:
        """What a visitor may choose from; the first one is shown at rest."""
        return tuple(plan.language for plan in self.plans)

    def plan(self, language: str, condition: Condition | None = None) -> Plan:
        """The plan of one of its languages, in the study file's condition or another one."""
        plan = self.plans[self.languages.index(language)]
        return plan if condition is None else replace(plan, condition=condition)
