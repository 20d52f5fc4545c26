"""A study file and everything that it names, read and held against each other, before the first visitor.

All faults are found, not only the first: whoever sets up a study mends them in one go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import TypeVar

from kiosk import BadInput
from kiosk.assistant.qtable import NONE, QTable
from kiosk.assistant.wording import CARD, Catalogue
from kiosk.game.board import CARDS_IN_A_PAIR
from kiosk.settings import ASSETS, Game, Practice, Settings
from kiosk.study.allocation import places
from kiosk.study.booth.chords import chords
from kiosk.study.condition import Condition
from kiosk.study.declared.checked import naming
from kiosk.study.declared.checked.alike import unclear_cards, unclear_names, unclear_purposes
from kiosk.study.declared.information import Information, check_alike
from kiosk.study.declared.questionnaire import Pictures, Questionnaire
from kiosk.study.plan import Plan, Study
from kiosk.study.stages import Course

MODEL_LANGUAGE = "en"
"""The language that all others are held against."""

Read = TypeVar("Read")


def read_study(settings: Settings) -> Study:
    """Everything that a study file names, read; raises BadInput with a sentence for everything that is wrong."""
    look = _Look(settings)
    look.at("stages", partial(Course.of, settings.stages))
    look.at("keys", partial(chords, settings.keys))
    look.check_allocation()
    catalogues = look.catalogues()
    sheets = look.sheets()
    asked = look.questionnaires()
    condition = look.at("assistance.condition", partial(Condition.named, settings.assistance.condition))
    policy = look.policy()
    deck = look.deck("game", settings.game)
    practice_deck = look.deck("practice", settings.practice) if "practice" in settings.stages else ()
    look.check_practice()
    if look.faults or condition is None or policy is None:
        raise BadInput(*look.faults)
    return Study(
        tuple(
            Plan(
                settings=settings,
                condition=condition,
                policy=policy,
                catalogue=catalogues[language],
                information=sheets[language],
                about_you=asked[0],
                questionnaires=asked[1:],
                deck=deck,
                practice_deck=practice_deck,
            )
            for language in settings.languages
        )
    )


class _Look:
    """Looks at what a study names; what is wrong becomes a sentence in ``faults``."""

    def __init__(self, settings: Settings) -> None:
        """Look at what these name."""
        self._settings = settings
        self._asked: list[tuple[Path, Questionnaire]] = []
        self.faults: list[str] = []

    def at(self, key: str, read: Callable[[], Read]) -> Read | None:
        """What is read, or None if the study file is to blame, at this key."""
        try:
            return read()
        except BadInput as error:
            self._blame(key, *error.sentences)
            return None

    def into(self, read: Callable[[], Read]) -> Read | None:
        """What is read, or None if a file is to blame that its own sentence names."""
        try:
            return read()
        except BadInput as error:
            self.faults += error.sentences
            return None

    def _blame(self, key: str, *sentences: str) -> None:
        self.faults += (f"{self._settings.name}: {key}: {each.removeprefix(f'{key}: ')}" for each in sentences)

    # What there is

    def catalogues(self) -> dict[str, Catalogue]:
        """The sentences of every language; each says all that the model language says."""
        found: dict[str, tuple[Path, Catalogue]] = {}
        for language in self._settings.languages:
            folder = self.at("languages", partial(naming.folder, self._settings, "sentences", language))
            catalogue = self.into(partial(Catalogue, folder)) if folder else None
            if folder and catalogue:
                found[language] = (folder, catalogue)
        _, model = found.get(MODEL_LANGUAGE) or (None, Catalogue(ASSETS / "sentences" / MODEL_LANGUAGE))
        for folder, catalogue in found.values():
            lacking = sorted(name for name in model.messages - catalogue.messages if not name.startswith(f"{CARD}-"))
            if lacking:
                self.faults.append(f"the sentences in {folder} lack {', '.join(lacking)}")
        return {language: catalogue for language, (_, catalogue) in found.items()}

    def sheets(self) -> dict[str, Information]:
        """What visitors are told in every language; the same in each."""
        text = self._settings.consent.text
        folder = self.at("consent.text", partial(naming.folder, self._settings, "consent", text))
        if folder is None:
            return {}
        read = {each: self.into(partial(Information.of, folder, each)) for each in self._settings.languages}
        sheets = {language: sheet for language, sheet in read.items() if sheet}
        self.into(partial(check_alike, sheets, folder))
        for sheet in [*sheets.values()][:1]:
            names = (purpose.id for purpose in sheet.consent.purposes)
            self.faults += (f"the information sheets in {folder}: {sentence}" for sentence in unclear_purposes(names))
        return sheets

    def questionnaires(self) -> tuple[Questionnaire, ...]:
        """The one about the visitor, and those after the game; none of their names is the same."""
        settings = self._settings
        names = (("about_you", settings.about_you), *(("questionnaires", name) for name in settings.questionnaires))
        asked = tuple(read for key, name in names if (read := self._questionnaire(key, name)))
        for one, other in combinations(asked, 2):
            both = [item.id for item in one.items if item.id in {item.id for item in other.items}]
            if one.id == other.id:
                self._blame("questionnaires", f"two of them have the id {one.id!r}")
            elif both:
                self._blame("questionnaires", f"{one.id!r} and {other.id!r} both have the items {', '.join(both)}")
        self.faults += unclear_names(self._asked)
        return asked

    def _questionnaire(self, key: str, name: str) -> Questionnaire | None:
        file = self.at(key, partial(naming.toml, self._settings, "questionnaires", name))
        asked = self.into(partial(Questionnaire.read, file)) if file else None
        if asked:
            unworded = ((language, ", ".join(asked.unworded(language))) for language in self._settings.languages)
            what = f"the questionnaire {file}"
            self.faults += (f"{what} lacks words in {language!r} for {items}" for language, items in unworded if items)
            self.faults += (f"{what}: {sentence}" for sentence in self._unseen(asked))
        if file and asked:
            self._asked.append((file, asked))
        return asked

    def _unseen(self, asked: Questionnaire) -> Iterator[str]:
        """What is wrong with the pictures of its scales."""
        for item in asked.items:
            if not isinstance(item, Pictures):
                continue
            try:
                folder = naming.folder(self._settings, "scales", item.pictures)
            except BadInput as error:
                yield from (f"{item.id}: {sentence}" for sentence in error.sentences)
            else:
                needed = (folder / f"{number}.svg" for number in range(1, item.points + 1))
                yield from (f"{item.id}: there is no picture {file}" for file in needed if not file.is_file())

    def policy(self) -> QTable | None:
        """The frozen table."""
        name = self._settings.assistance.policy
        if name == NONE:
            return QTable.blank()
        file: Path | None = self.at("assistance.policy", partial(naming.policy, self._settings, name))
        return self.into(partial(QTable.load, file)) if file else None

    def deck(self, key: str, board: Game | Practice) -> tuple[str, ...]:
        """The names of a deck's cards, in alphabetical order; there are enough for the board."""
        shape, places = f"a board of {board.rows} x {board.columns}", board.rows * board.columns
        if places % CARDS_IN_A_PAIR:
            self._blame(key, f"{shape} has {places} places, but cards come in pairs")
        folder = self.at(f"{key}.deck", partial(naming.folder, self._settings, "cards", board.deck))
        if folder is None:
            return ()
        cards = tuple(sorted(path.stem for path in folder.glob("*.svg")))
        self.faults += (f"the deck {folder}: {sentence}" for sentence in unclear_cards(cards))
        pairs = places // CARDS_IN_A_PAIR
        if len(cards) < pairs:
            self._blame(f"{key}.deck", f"{shape} needs {pairs} pictures, but the deck {board.deck!r} has {len(cards)}")
        return cards

    # What does not fit

    def check_practice(self) -> None:
        """Nobody sees the pictures of the game before it."""
        settings = self._settings
        if "practice" in settings.stages and settings.practice.deck == settings.game.deck:
            self._blame("practice.deck", f"the game has the pictures {settings.game.deck!r} too; choose others")

    def check_allocation(self) -> None:
        """Every quota is one of a condition, and every block holds them in ratio."""
        declared = self._settings.allocation
        named = {name: self.at("allocation.quotas", partial(Condition.named, name)) for name in declared.quotas}
        quotas = {condition: declared.quotas[name] for name, condition in named.items() if condition}
        if quotas and len(quotas) == len(named):
            self.at("allocation.block", partial(places, quotas, declared.block, declared.seed or 0))
