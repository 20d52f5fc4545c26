"""A study file and everything that it names, read and held against each other, before the first visitor.

All faults are found, not only the first: whoever sets up a study mends them in one go.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import TypeVar

from kiosk import BadInput
from kiosk.assistant.qtable import NONE, QTable
from kiosk.assistant.wording import CARD, Catalogue, sources_in
from kiosk.game.board import CARDS_IN_A_PAIR
from kiosk.language_codes import standard
from kiosk.settings import ASSETS, Game, Located, Practice, Settings, code_of, read_text
from kiosk.study.allocation import places
from kiosk.study.booth.chords import chords
from kiosk.study.condition import Condition
from kiosk.study.declared.checked import naming
from kiosk.study.declared.checked.alike import unclear_cards, unclear_names, unclear_purposes
from kiosk.study.declared.checked.forming import unformed
from kiosk.study.declared.information import Information, check_alike
from kiosk.study.declared.questionnaire import Pictures, Questionnaire
from kiosk.study.plan import Plan, Source, Study
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
    decks = {key: look.deck(key, board) for key, board in _boards(settings)}
    look.check_practice()
    if look.faults or condition is None or policy is None:
        raise BadInput(*look.faults)
    for language, catalogue in catalogues.items():
        catalogue.followed_by(other for each, other in catalogues.items() if each != language)
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
                deck=decks["game"],
                practice_deck=decks.get("practice", ()),
            )
            for language in settings.language_codes
        ),
        tuple(look.sources),
    )


def _boards(settings: Settings) -> Iterator[tuple[str, Game | Practice]]:
    """The boards that visitors see, by their section of the study file."""
    yield "game", settings.game
    if "practice" in settings.stages:
        yield "practice", settings.practice


class _Look:
    """Looks at what a study names; what is wrong becomes a sentence in ``faults``."""

    def __init__(self, settings: Settings) -> None:
        """Look at what these name."""
        self._settings = settings
        self._asked: list[tuple[Path, Questionnaire]] = []
        self.faults: list[str] = []
        self.sources: list[Source] = []

    def at(self, key: str, read: Callable[[], Read]) -> Read | None:
        """What is read, or None if the study file is to blame, at this key."""
        try:
            return read()
        except BadInput as error:
            self._blame(key, *error.sentences)
        except ValueError as error:
            self._blame(key, str(error))
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

    def _came(self, key: str, name: str, place: Located, sha256: str, version: str | None = None) -> None:
        """Keep in mind where something came from."""
        self.sources.append(Source(key, name, place.path, place.is_shipped, sha256, version, place.unused))

    def _drawn(self, key: str, name: str, place: Located, files: Iterable[Path]) -> None:
        """Keep in mind where pictures came from."""
        there = tuple(files)
        digest = _hash_of_files(there)
        source = Source(key, name, place.path, place.is_shipped, digest, unused=place.unused, pictures=there)
        self.sources.append(source)

    # What there is

    def catalogues(self) -> dict[str, Catalogue]:
        """The sentences of every language; each says all that the model language says."""
        found: dict[str, Catalogue] = {}
        model = Catalogue(ASSETS / "sentences" / MODEL_LANGUAGE)
        for name in self._settings.languages:
            catalogue = self._catalogue(name, model)
            if catalogue and catalogue.language in found:
                self._blame("languages", f"{catalogue.language!r} stands twice")
            elif catalogue:
                found[catalogue.language] = catalogue
        return found

    def _catalogue(self, name: str, model: Catalogue) -> Catalogue | None:
        """The sentences of one language, with the names of the cards that lie in the decks' own folders."""
        if self.at("languages", partial(standard, code_of(name))) is None:
            return None
        place = self.at("languages", partial(naming.located, self._settings, "sentences", name))
        if place is None:
            return None
        words = self._words_of_decks(code_of(name))
        sources = self.into(partial(sources_in, place.path))
        texts = {key: self.into(partial(read_text, f"the file {file}", file)) for key, file in words.items()}
        if sources is None or None in texts.values():
            return None
        sources |= {key: text for key, text in texts.items() if text is not None}
        catalogue = self.into(partial(Catalogue, place.path, sources, words))
        if catalogue is None:
            return None
        lacking = sorted(each for each in model.messages - catalogue.messages if not each.startswith(f"{CARD}-"))
        if lacking:
            self.faults.append(f"the sentences in {place.path} lack {', '.join(lacking)}")
        if words or not place.is_shipped:
            self.faults += unformed(
                catalogue, model, self._cards(), max(self._settings.game.rows, self._settings.game.columns)
            )
        self._came("languages", name, place, _hash(sources.items()))
        return catalogue

    def _words_of_decks(self, code: str) -> dict[str, Path]:
        """The files with which decks name their own cards in a language, by what to call them in records."""
        words: dict[str, Path] = {}
        for _, board in _boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            if place is not None:
                there = (file for file in sorted(place.path.glob("*.ftl")) if code_of(file.stem) == code)
                words |= {f"deck-{place.path.name}.ftl": file for file in there}
        return words

    def _cards(self) -> tuple[str, ...]:
        """The names of all cards that a visitor may see."""
        places = (self._settings.locate("cards", board.deck) for _, board in _boards(self._settings))
        return tuple(sorted({path.stem for place in places if place for path in place.path.glob("*.svg")}))

    def sheets(self) -> dict[str, Information]:
        """What visitors are told in every language; the same in each."""
        text = self._settings.consent.text
        place = self.at("consent.text", partial(naming.located, self._settings, "consent", text))
        if place is None:
            return {}
        read = {each: self.into(partial(Information.of, place.path, each)) for each in self._settings.language_codes}
        sheets = {language: sheet for language, sheet in read.items() if sheet}
        self.into(partial(check_alike, sheets, place.path))
        for sheet in [*sheets.values()][:1]:
            names = (purpose.id for purpose in sheet.consent.purposes)
            self.faults += (
                f"the information sheets in {place.path}: {sentence}" for sentence in unclear_purposes(names)
            )
        for language, sheet in sheets.items():
            self._came(f"consent.text ({language})", text, place, sheet.sha256, sheet.version)
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
        place = self.at(key, partial(naming.located, self._settings, "questionnaires", name))
        asked = self.into(partial(Questionnaire.read, place.path)) if place else None
        if place and asked:
            self._came(key, name, place, asked.sha256, asked.version)
            unworded = ((language, ", ".join(asked.unworded(language))) for language in self._settings.language_codes)
            what = f"the questionnaire {place.path}"
            self.faults += (f"{what} lacks words in {language!r} for {items}" for language, items in unworded if items)
            self.faults += (f"{what}: {sentence}" for sentence in self._unseen(asked))
        if place and asked:
            self._asked.append((place.path, asked))
        return asked

    def _unseen(self, asked: Questionnaire) -> Iterator[str]:
        """What is wrong with the pictures of its scales."""
        for item in asked.items:
            if not isinstance(item, Pictures):
                continue
            try:
                place = naming.located(self._settings, "scales", item.pictures)
            except BadInput as error:
                yield from (f"{item.id}: {sentence}" for sentence in error.sentences)
            else:
                needed = tuple(place.path / f"{number}.svg" for number in range(1, item.points + 1))
                self._drawn(f"{asked.id}, {item.id}: pictures", item.pictures, place, needed)
                yield from (f"{item.id}: there is no picture {file}" for file in needed if not file.is_file())

    def policy(self) -> QTable | None:
        """The frozen table."""
        name = self._settings.assistance.policy
        if name == NONE:
            return QTable.blank()
        place = self.at("assistance.policy", partial(naming.located, self._settings, "policies", name))
        table = self.into(partial(QTable.load, place.path)) if place else None
        if place and table:
            self._came("assistance.policy", name, place, table.sha256)
        return table

    def deck(self, key: str, board: Game | Practice) -> tuple[str, ...]:
        """The names of a deck's cards, in alphabetical order; there are enough for the board."""
        shape, places = f"a board of {board.rows} x {board.columns}", board.rows * board.columns
        if places % CARDS_IN_A_PAIR:
            self._blame(key, f"{shape} has {places} places, but cards come in pairs")
        place = self.at(f"{key}.deck", partial(naming.located, self._settings, "cards", board.deck))
        if place is None:
            return ()
        files = sorted(place.path.glob("*.svg"), key=lambda file: file.stem)
        self._drawn(f"{key}.deck", board.deck, place, files)
        cards = tuple(file.stem for file in files)
        self.faults += (f"the deck {place.path}: {sentence}" for sentence in unclear_cards(cards))
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


def _hash_of_files(files: Iterable[Path]) -> str:
    """The hash over files that belong together, by their names and what is in them."""
    return _hash((file.name, _digest(file)) for file in files)


def _digest(file: Path) -> str:
    try:
        with file.open("rb") as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()
    except OSError:
        # That it cannot be read is said elsewhere.
        return ""


def _hash(named: Iterable[tuple[str, str]]) -> str:
    return hashlib.sha256(json.dumps(sorted(named), ensure_ascii=False).encode()).hexdigest()
