"""Read a study file with everything that it names, or refuse it in one sentence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from itertools import combinations
from pathlib import Path

from kiosk import UserInputError
from kiosk.assistance.policy import NONE, ActionSpec, QTable, find_action
from kiosk.config import NO_ROBOT, Game, Located, Practice, Settings, pictures_in
from kiosk.experiment.condition import Condition, allocation_slots
from kiosk.experiment.experimenter import shortcuts
from kiosk.experiment.information import POINTER, RETURNING, Information, check_alike
from kiosk.experiment.items import Pictures
from kiosk.experiment.labels import read_as
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.experiment.session_config import SessionConfig, Source, StudyConfig
from kiosk.experiment.transitions import StageOrder
from kiosk.game import CARDS_IN_A_PAIR
from kiosk.study.decks import boards, deck_faults, picture_faults
from kiosk.study.findings import Findings, digest, located
from kiosk.study.names import unclear_cards, unclear_names, unclear_purposes
from kiosk.study.package import study_hash
from kiosk.study.texts import StudyTexts

_FONTS = (".ttf", ".otf", ".ttc")

MOST_ITEMS = 1000
"""Items of all questionnaires of a study; an export has a column for each, and spreadsheets slow down beyond."""


def read_study(settings: Settings) -> StudyConfig:
    """Everything that a study file names, read; raises UserInputError with a sentence for everything that is wrong."""
    look = _Look(settings)
    texts = StudyTexts(look)
    look.at("stages", partial(StageOrder.of, settings.stages))
    look.at("shortcuts", partial(shortcuts, settings.shortcuts))
    look.check_allocation()
    texts.read_tables()
    policy = look.policy()
    policies = look.policies(policy)
    look.check_hints(filter(None, (policy, *policies.values())))
    look.check_looks()
    actions = (action for table in (policy, *policies.values()) if table for action in table.actions)
    catalogues = texts.catalogues(tuple(dict.fromkeys(actions)))
    sheets = look.sheets()
    asked = look.questionnaires()
    condition = look.condition("assistance.condition", settings.assistance.condition)
    decks = {key: look.deck(key, board) for key, board in boards(settings)}
    look.check_practice()
    look.check_logo()
    look.check_fonts()
    look.check_pointer(sheets)
    look.check_returning(sheets)
    if look.faults or condition is None or policy is None:
        raise UserInputError(*look.faults)
    for language, catalogue in catalogues.items():
        catalogue.followed_by(other for each, other in catalogues.items() if each != language)
    sha256 = study_hash(settings, look.sources)
    return StudyConfig(
        tuple(
            SessionConfig(
                settings=settings,
                condition=condition,
                policy=policies.get(condition.name, policy),
                policies=policies,
                catalogue=catalogues[language],
                information=sheets[language],
                about_you=asked[0],
                questionnaires=asked[1:],
                deck=decks["game"],
                practice_deck=decks.get("practice", ()),
                study_sha256=sha256,
            )
            for language in settings.language_codes
        ),
        tuple(look.sources),
    )


class _Look(Findings):
    """Looks at what a study names, part by part."""

    def __init__(self, settings: Settings) -> None:
        """Look at what these name."""
        super().__init__(settings)
        self._asked: list[tuple[Path, Questionnaire]] = []

    def check_logo(self) -> None:
        """See that the lab's logo is there."""
        name = self.settings.look.logo
        file = self.settings.beside(name)
        if name and not (file.is_file() and file.suffix.lower() == ".svg"):
            self.blame("look.logo", f"there is no SVG file {file}")
        elif name:
            self.drawn("look.logo", name, Located(file), (file,))
            self.faults += picture_faults(file)

    def check_fonts(self) -> None:
        """See that the study's own fonts are there."""
        for name, file in zip(self.settings.look.fonts, self.settings.own_fonts, strict=True):
            if file.is_file() and file.suffix.lower() in _FONTS:
                self.sources.append(Source("look.fonts", name, file, is_shipped=False, sha256=digest(file)))
            else:
                self.blame("look.fonts", f"there is no font {file} that ends in {', '.join(_FONTS)}")

    # What there is

    def sheets(self) -> dict[str, Information]:
        """Return what visitors are told in every language; the same in each."""
        text = self.settings.consent.text
        place = self.at("consent.text", partial(located, self.settings, "consent", text))
        if place is None:
            return {}
        read = {each: self.into(partial(Information.of, place.path, each)) for each in self.settings.language_codes}
        sheets = {language: sheet for language, sheet in read.items() if sheet}
        self.into(partial(check_alike, sheets, place.path))
        for sheet in [*sheets.values()][:1]:
            names = (purpose.id for purpose in sheet.consent.purposes)
            self.faults += (
                f"the information sheets in {place.path}: {sentence}" for sentence in unclear_purposes(names)
            )
        for language, sheet in sheets.items():
            self.came(f"consent.text ({language})", text, place, sheet.sha256, sheet.version)
        return sheets

    def questionnaires(self) -> tuple[Questionnaire, ...]:
        """Return the one about the visitor, and those after the game; none of their names is the same."""
        settings = self.settings
        names = (("about_you", settings.about_you), *(("questionnaires", name) for name in settings.questionnaires))
        asked = tuple(read for key, name in names if (read := self._questionnaire(key, name)))
        for one, other in combinations(asked, 2):
            names_of_other = {item.id for item in other.items}
            both = [item.id for item in one.items if item.id in names_of_other]
            if one.id == other.id:
                self.blame("questionnaires", f"two of them have the id {one.id!r}")
            elif both:
                self.blame("questionnaires", f"{one.id!r} and {other.id!r} both have the items {', '.join(both)}")
        self.faults += unclear_names(self._asked)
        items = sum(len(each.items) for _, each in self._asked)
        if items > MOST_ITEMS:
            self.blame("questionnaires", f"together they have {items:,} items; a study has at most {MOST_ITEMS:,}")
        return asked

    def _questionnaire(self, key: str, name: str) -> Questionnaire | None:
        place = self.at(key, partial(located, self.settings, "questionnaires", name))
        asked = self.into(partial(Questionnaire.read, place.path)) if place else None
        if place and asked:
            self.came(key, name, place, asked.sha256, asked.version)
            unworded = ((language, ", ".join(asked.unworded(language))) for language in self.settings.language_codes)
            what = f"the questionnaire {place.path}"
            self.faults += (f"{what} lacks words in {language!r} for {items}" for language, items in unworded if items)
            self.faults += (f"{what}: {sentence}" for sentence in self._unseen(asked))
        if place and asked:
            self._asked.append((place.path, asked))
        return asked

    def _unseen(self, asked: Questionnaire) -> Iterator[str]:
        """Yield what is wrong with the pictures of its scales."""
        for item in asked.items:
            if not isinstance(item, Pictures):
                continue
            try:
                place = located(self.settings, "scales", item.pictures)
            except UserInputError as error:
                yield from (f"{item.id}: {sentence}" for sentence in error.sentences)
            else:
                needed = tuple(place.path / f"{number}.svg" for number in range(1, item.points + 1))
                self.drawn(f"{asked.id}, {item.id}: pictures", item.pictures, place, needed)
                yield from (f"{item.id}: there is no picture {file}" for file in needed if not file.is_file())
                drawn = () if place.is_shipped else (file for file in needed if file.is_file())
                yield from (f"{item.id}: {fault}" for file in drawn for fault in picture_faults(file))

    def policy(self) -> QTable | None:
        """Return the frozen table."""
        return self._table("assistance.policy", self.settings.assistance.policy)

    def _table(self, key: str, name: str) -> QTable | None:
        if name == NONE:
            return QTable.blank()
        place = self.at(key, partial(located, self.settings, "policies", name))
        table = self.into(partial(QTable.load, place.path)) if place else None
        if place and table:
            self.came(key, name, place, table.sha256)
        return table

    def policies(self, policy: QTable | None) -> dict[str, QTable]:
        """Return the tables of all conditions, if any has one of its own; ``policy`` is that of the others."""
        named = {name: each.policy for name, each in self.settings.conditions.items() if each.policy}
        if policy is None or not named:
            return {}
        own = {name: self._table(f"conditions.{name}.policy", table) for name, table in named.items()}
        return {name: own.get(name) or policy for name in self.settings.all_conditions}

    def check_hints(self, tables: Iterable[QTable]) -> None:
        """See that the tables have the actions that are taken without asking them, as states name the last one."""
        assistance = self.settings.assistance
        needed = {
            "timing": (ActionSpec.SUG_COL, ActionSpec.SUG_CARD) if assistance.timing == "model" else (),
            "hesitation_action": (find_action(assistance.hesitation_action),) if assistance.hesitation_max else (),
        }
        for table in tables:
            for key, actions in needed.items():
                lacking = ", ".join(action.label for action in actions if action not in table.actions)
                if lacking:
                    self.blame(f"assistance.{key}", f"a table that the study names has no action {lacking}")

    def check_looks(self) -> None:
        """See that a robot looks at places, if hints are nothing but looks."""
        robot = self.settings.robot
        if robot.kind == NO_ROBOT or robot.gaze:
            return
        for name, cell in self.settings.conditions.items():
            if cell.gaze_only:
                self.blame(f"conditions.{name}.gaze_only", "robot.gaze is false, so the robot would look nowhere")

    def condition(self, key: str, name: str) -> Condition | None:
        """Return the condition of a name, if there is one."""
        known = self.at(key, partial(self.settings.condition, name))
        misread = read_as(name)
        if misread:
            self.blame(key, f"the condition {name!r} is taken for {misread} by programs that read tables")
        return Condition(name) if known else None

    def deck(self, key: str, board: Game | Practice) -> tuple[str, ...]:
        """Return the names of a deck's cards, in alphabetical order; there are enough for the board."""
        shape, places = f"a board of {board.rows} x {board.columns}", board.rows * board.columns
        if places % CARDS_IN_A_PAIR:
            self.blame(key, f"{shape} has {places} places, but cards come in pairs")
        place = self.at(f"{key}.deck", partial(located, self.settings, "cards", board.deck))
        if place is None:
            return ()
        pictures = pictures_in(place.path)
        self.drawn(f"{key}.deck", board.deck, place, pictures.values())
        cards = tuple(pictures)
        self.faults += () if place.is_shipped else deck_faults(place.path)
        self.faults += (f"the deck {place.path}: {sentence}" for sentence in unclear_cards(cards))
        pairs = places // CARDS_IN_A_PAIR
        if len(cards) < pairs:
            self.blame(f"{key}.deck", f"{shape} needs {pairs} pictures, but the deck {board.deck!r} has {len(cards)}")
        return cards

    # What does not fit

    def check_practice(self) -> None:
        """Refuse a practice that shows the pictures of the game before it."""
        settings = self.settings
        if "practice" in settings.stages and settings.practice.deck == settings.game.deck:
            self.blame("practice.deck", f"the game has the pictures {settings.game.deck!r} too; choose others")

    def check_pointer(self, sheets: Mapping[str, Information]) -> None:
        """Refuse to record the way of the pointer where no visitor can agree to it."""
        offered = {purpose.id for sheet in sheets.values() for purpose in sheet.consent.purposes}
        if self.settings.privacy.pointer_trace and sheets and POINTER not in offered:
            self.blame("privacy.pointer_trace", f"the consent has no purpose {POINTER!r} that a visitor could agree to")

    def check_returning(self, sheets: Mapping[str, Information]) -> None:
        """Refuse to let visitors come back where they cannot say so, or cannot agree to it freely."""
        settings = self.settings
        if not settings.returning.enabled:
            return
        lacking = [stage for stage in ("about", "consent", "debrief") if stage not in settings.stages]
        if lacking:
            self.blame("returning.enabled", f"visitors can come back only in a study with the stage {lacking[0]!r}")
        for language, sheet in sheets.items():
            offered = {purpose.id: purpose for purpose in sheet.consent.purposes}
            if RETURNING not in offered:
                why = f"has no purpose {RETURNING!r} that a visitor could agree to"
            elif offered[RETURNING].required:
                why = f"requires the purpose {RETURNING!r}, which must be free to refuse: write required = false"
            else:
                continue
            self.blame("returning.enabled", f"the consent in {language!r} {why}")
            break
        if settings.returning.condition == "next" and len(settings.randomisation.target_n) < _FEWEST_IN_TURN:
            self.blame("returning.condition", "'next' needs two conditions or more in randomisation.target_n")

    def check_allocation(self) -> None:
        """Every quota is one of a condition, and every block holds them in ratio."""
        declared = self.settings.randomisation
        named = {name: self.condition("randomisation.target_n", name) for name in declared.target_n}
        quotas = {condition: declared.target_n[name] for name, condition in named.items() if condition}
        if quotas and len(quotas) == len(named):
            self.at(
                "randomisation.block_size", partial(allocation_slots, quotas, declared.block_size, declared.seed or 0)
            )


_FEWEST_IN_TURN = 2
"""Conditions that can follow one another."""
