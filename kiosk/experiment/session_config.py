"""What a session and a study follow, and what kind of session it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from pathlib import Path

from kiosk.assistance.policy import QTable
from kiosk.assistance.wording import Catalogue
from kiosk.config import ConditionConfig, Settings, Timing
from kiosk.experiment.condition import Condition
from kiosk.experiment.information import Information
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.experiment.transitions import StageOrder
from kiosk.lazy_dataclass import dataclass


def kind_of(settings: Settings) -> SessionKind:
    """Return what people's sessions at a kiosk with these settings are."""
    return SessionKind.STUDY if settings.experimenter.pin_hash else SessionKind.TRIAL


@dataclass(frozen=True)
class Translation:
    """What a session says and shows in one language; the questionnaires hold all of theirs."""

    catalogue: Catalogue
    information: Information


@dataclass(frozen=True)
class SessionConfig:
    """Everything that a session follows, except chance and what happens in it; it begins in one language."""

    settings: Settings
    condition: Condition
    policy: QTable
    catalogue: Catalogue
    information: Information
    about_you: Questionnaire
    questionnaires: tuple[Questionnaire, ...]
    deck: tuple[str, ...]
    practice_deck: tuple[str, ...]
    translations: tuple[Translation, ...] = ()
    """All languages that the visitor can go on in; none but its own if this is empty."""

    def translation(self, language: str) -> Translation | None:
        """Return what it says in another of its languages; None if it has no such language."""
        own = Translation(self.catalogue, self.information)
        return next((each for each in (own, *self.translations) if each.catalogue.language == language), None)

    @property
    def languages(self) -> tuple[str, ...]:
        """The languages that the visitor can go on in, in the study's order."""
        return tuple(each.catalogue.language for each in self.translations) or (self.language,)

    policies: Mapping[str, QTable] = field(default_factory=dict)
    """The tables of the study's conditions, by their names, where any has one of its own."""
    study_sha256: str = ""
    """The hash of the whole study, as ``study pack`` prints it; empty where it is not known."""
    visit: int = 1
    """Which visit of the participant it is, counted from 1."""

    @property
    def asked_about_you(self) -> tuple[Questionnaire, ...]:
        """The questionnaire about the visitor as it is asked at this visit; nothing if it is not."""
        return _at_visit((self.about_you,), self.visit)

    @property
    def asked_after_game(self) -> tuple[Questionnaire, ...]:
        """The questionnaires after the game as they are asked at this visit."""
        return _at_visit(self.questionnaires, self.visit)

    @property
    def cell(self) -> ConditionConfig:
        """What the condition comes to; raises UserInputError if the settings do not know it."""
        return self.settings.condition(self.condition.name)

    @property
    def timing(self) -> Timing:
        """The times that hold in the condition."""
        return self.settings.timing.model_copy(update=self.cell.timing)

    def in_condition(self, condition: Condition) -> SessionConfig:
        """Return the same plan in another condition, with the table of that."""
        return replace(self, condition=condition, policy=self.policies.get(condition.name, self.policy))

    @property
    def language(self) -> str:
        """The language of the session."""
        return self.catalogue.language

    def with_base_dir(self, other: Settings) -> SessionConfig:
        """Return the same plan, whose settings look for what they name by a path where these do."""
        return replace(self, settings=self.settings.with_base_dir(other))

    @property
    def stage_order(self) -> StageOrder:
        """Its stages in their order; raises UserInputError if there can be no such course.

        A later visit leaves out a stage in which nothing is asked.
        """
        order = StageOrder.of(self.settings.stages)
        empty = {Stage.ABOUT_YOU: not self.asked_about_you, Stage.QUESTIONS: not self.asked_after_game}
        return StageOrder(tuple(stage for stage in order.stages if self.visit == 1 or not empty.get(stage)))


def _at_visit(questionnaires: tuple[Questionnaire, ...], visit: int) -> tuple[Questionnaire, ...]:
    return tuple(asked for each in questionnaires if (asked := each.at_visit(visit)) is not None)


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
class StudyConfig:
    """A study, ready to be run: a plan for each of its languages, alike in all but words."""

    plans: tuple[SessionConfig, ...]
    sources: tuple[Source, ...] = ()

    @property
    def settings(self) -> Settings:
        """The study file."""
        return self.plans[0].settings

    @property
    def sha256(self) -> str:
        """The hash of everything that sessions follow, settings of one kiosk left out; empty if it is not known."""
        return self.plans[0].study_sha256

    @property
    def own_pictures(self) -> tuple[Path, ...]:
        """The pictures that do not come with the program, each once."""
        return tuple(dict.fromkeys(file for each in self.sources if not each.is_shipped for file in each.pictures))

    @property
    def own_cards(self) -> tuple[Path, ...]:
        """Those of them that are cards, in the order of their decks."""
        decks = (each for each in self.sources if each.key.endswith(".deck") and not each.is_shipped)
        return tuple(dict.fromkeys(file for each in decks for file in each.pictures))

    @property
    def languages(self) -> tuple[str, ...]:
        """What a visitor may choose from; the first one is shown at rest."""
        return tuple(plan.language for plan in self.plans)

    def plan(self, language: str, condition: Condition | None = None) -> SessionConfig:
        """Return the plan of one of its languages, in the study file's condition or another one."""
        plan = self.plans[self.languages.index(language)]
        plan = replace(plan, translations=tuple(Translation(each.catalogue, each.information) for each in self.plans))
        return plan if condition is None else plan.in_condition(condition)

    def condition(self, name: str) -> Condition:
        """Return the condition of a name; raises UserInputError with all the names there are."""
        self.settings.condition(name)
        return Condition(name)
