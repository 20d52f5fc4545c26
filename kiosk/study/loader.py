"""Read a study file with everything that it names, or refuse it in one sentence."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from kiosk import UserInputError
from kiosk.assistance.policy import ACTIONS, NONE, ActionSpec, QTable, find_action
from kiosk.assistance.wording import CARD, REPLACING, Catalogue, sources_in
from kiosk.config import (
    ASSETS,
    NO_ROBOT,
    Game,
    Located,
    Practice,
    Settings,
    code_of,
    is_path,
    pictures_in,
    read_text,
    shipped_names,
)
from kiosk.experiment.condition import Condition, allocation_slots
from kiosk.experiment.experimenter import shortcuts
from kiosk.experiment.information import POINTER, RETURNING, Information, check_alike
from kiosk.experiment.items import Choice, Pictures
from kiosk.experiment.labels import alike, fold_name, is_reserved, read_as
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.session_config import SessionConfig, Source, StudyConfig
from kiosk.experiment.transitions import StageOrder
from kiosk.files import open_to_read
from kiosk.game import CARDS_IN_A_PAIR
from kiosk.language_codes import standard
from kiosk.study.decks import CardNames, deck_faults, picture_faults, read_names
from kiosk.study.package import study_hash

if TYPE_CHECKING:
    from kiosk.study.wording_drafts import SignedWording

_WORDS = {
    "sentences": "language",
    "consent": "folder of information sheets",
    "questionnaires": "questionnaire",
    "scales": "folder of pictures",
    "cards": "deck",
    "policies": "policy",
}
"""What people call what goes by a name."""


def located(settings: Settings, kind: str, name: str) -> Located:
    """Find something of this kind; raises UserInputError with the names that there are."""
    found = settings.locate(kind, name)
    if found is None:
        raise UserInputError(_nothing(settings, kind, name))
    return found


def _nothing(settings: Settings, kind: str, name: str) -> str:
    what = _WORDS[kind]
    if is_path(name):
        return f"there is no {what} at {settings.beside(name)}; a name with / or an ending is a path"
    shipped = sorted({*shipped_names(kind), *((NONE,) if kind == "policies" else ())})
    beside = f", and nothing at {settings.beside(name)}" if name else ""
    return f"there is no {what} {name!r} (shipped are {', '.join(shipped)}){beside}"


ONE_NAME = "are one name where capitals, - and _ do not count, as in file names and many statistics programs"


def unclear_names(asked: Sequence[tuple[Path, Questionnaire]]) -> Iterator[str]:
    """Yield a sentence for every name that a reader would lose or misread.

    Each names the files.
    """
    yield from _between("questionnaires", [(each.id, file) for file, each in asked])
    yield from _between("items", [(item.id, file) for file, each in asked for item in each.items])
    yield from _between("scales", [(scale, file) for file, each in asked for scale in each.scales])
    for file, each in asked:
        if is_reserved(each.id):
            yield f"the questionnaire {file}: id: Windows keeps the name {each.id!r} for a device; choose another"
        for item in each.items:
            yield from (f"the questionnaire {file}: {item.id}: {sentence}" for sentence in _of_options(item))


def unclear_cards(cards: Iterable[str]) -> Iterator[str]:
    """Yield the same for the cards of a deck."""
    for one, other in alike(cards):
        yield f"the cards {one!r} and {other!r} {ONE_NAME}"


def unclear_purposes(purposes: Iterable[str]) -> Iterator[str]:
    """Yield the same for the purposes of the consent."""
    for one, other in alike(purposes):
        yield f"the purposes {one!r} and {other!r} {ONE_NAME}"


def _between(what: str, named: Sequence[tuple[str, Path]]) -> Iterator[str]:
    """Names of one kind that are written in two ways; that the same one stands twice is said elsewhere."""
    first: dict[str, tuple[str, Path]] = {}
    for name, file in named:
        other, place = first.setdefault(fold_name(name), (name, file))
        if other != name:
            where = (
                f"the questionnaire {file}: the {what} {other!r} and {name!r}"
                if file == place
                else f"the {what} {other!r} in {place} and {name!r} in {file}"
            )
            yield f"{where} {ONE_NAME}"


def _unsaid(actions: Sequence[ActionSpec], catalogue: Catalogue) -> Iterator[str]:
    """Yield what a language has no wordings for, of what actions say."""
    for action in actions:
        lacking = [message for message in action.messages if not catalogue.wordings_of(message)]
        # What comes with Recollect is looked for with all other messages.
        if lacking and action not in ACTIONS:
            yield f"the action {action.label!r} lacks {', '.join(lacking)} in {catalogue.language!r}"


SIGNED_TEXTS = f"{REPLACING}wording.ftl"
"""What the signed wordings of hints are called."""

WORDING = "assistance.wording"

OWN_TEXTS = f"{REPLACING}study.ftl"
"""What the messages are called that a study file itself replaces."""


def _unknown_texts(catalogue: Catalogue, model: Catalogue) -> Iterator[str]:
    """Yield what a study rewords and no screen ever says."""
    replaced = {text for name, text in catalogue.sources.items() if name.startswith(REPLACING)}
    said = {name for name, text in catalogue.sources.items() if not name.startswith(REPLACING)}
    if not replaced:
        return
    known = model.messages | Catalogue(catalogue.folder, {name: catalogue.sources[name] for name in said}).messages
    for name, written in catalogue.written.items():
        if written.source in replaced and name not in known and not name.startswith((f"{CARD}-", "-")):
            from difflib import get_close_matches  # noqa: PLC0415 - only a mistake needs it

            close = get_close_matches(name, sorted(known), n=1)
            meant = f"; did you mean {close[0]!r}?" if close else ""
            yield f"{written.file}, line {written.line(written.entry)}: there is no message {name!r} to replace{meant}"


def _of_options(item: Item) -> Iterator[str]:
    if not isinstance(item, Choice):
        return
    for one, other in alike(item.ids):
        yield f"the options {one!r} and {other!r} {ONE_NAME}"
    for option in item.ids:
        misread = read_as(option)
        if misread:
            yield f"the option {option!r} is taken for {misread} by programs that read tables; choose another id"


_FONTS = (".ttf", ".otf", ".ttc")

MOST_ITEMS = 1000
"""Items of all questionnaires of a study; an export has a column for each, and spreadsheets slow down beyond."""

MODEL_LANGUAGE = "en"
"""The language that all others are held against."""

Read = TypeVar("Read")


def read_study(settings: Settings) -> StudyConfig:
    """Everything that a study file names, read; raises UserInputError with a sentence for everything that is wrong."""
    look = _Look(settings)
    look.at("stages", partial(StageOrder.of, settings.stages))
    look.at("shortcuts", partial(shortcuts, settings.shortcuts))
    look.check_allocation()
    look.read_tables()
    policy = look.policy()
    policies = look.policies(policy)
    look.check_hints(filter(None, (policy, *policies.values())))
    look.check_looks()
    actions = (action for table in (policy, *policies.values()) if table for action in table.actions)
    catalogues = look.catalogues(tuple(dict.fromkeys(actions)))
    sheets = look.sheets()
    asked = look.questionnaires()
    condition = look.condition("assistance.condition", settings.assistance.condition)
    decks = {key: look.deck(key, board) for key, board in _boards(settings)}
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


def _boards(settings: Settings) -> Iterator[tuple[str, Game | Practice]]:
    """Yield the boards that visitors see, by their section of the study file."""
    yield "game", settings.game
    if "practice" in settings.stages:
        yield "practice", settings.practice


class _Look:
    """Looks at what a study names; what is wrong becomes a sentence in ``faults``."""

    def __init__(self, settings: Settings) -> None:
        """Look at what these name."""
        self._settings = settings
        self._asked: list[tuple[Path, Questionnaire]] = []
        self._tables: dict[Path, dict[str, CardNames]] = {}
        self.faults: list[str] = []
        self.sources: list[Source] = []

    def at(self, key: str, read: Callable[[], Read]) -> Read | None:
        """Return what is read, or None if the study file is to blame, at this key."""
        try:
            return read()
        except UserInputError as error:
            self._blame(key, *error.sentences)
        except ValueError as error:
            self._blame(key, str(error))
        return None

    def into(self, read: Callable[[], Read]) -> Read | None:
        """Return what is read, or None if a file is to blame that its own sentence names."""
        try:
            return read()
        except UserInputError as error:
            self.faults += error.sentences
            return None

    def _blame(self, key: str, *sentences: str) -> None:
        line = self._settings.line_of(*key.split("."))
        where = "" if line is None else f" (line {line})"
        self.faults += (f"{self._settings.name}: {key}: {each.removeprefix(f'{key}: ')}{where}" for each in sentences)

    def _came(self, key: str, name: str, place: Located, sha256: str, version: str | None = None) -> None:
        """Keep in mind where something came from."""
        self.sources.append(Source(key, name, place.path, place.is_shipped, sha256, version, place.unused))

    def _drawn(self, key: str, name: str, place: Located, files: Iterable[Path]) -> None:
        """Keep in mind where pictures came from."""
        there = tuple(files)
        digest = _hash_of_files(there)
        source = Source(key, name, place.path, place.is_shipped, digest, unused=place.unused, pictures=there)
        self.sources.append(source)

    def check_logo(self) -> None:
        """See that the lab's logo is there."""
        name = self._settings.look.logo
        file = self._settings.beside(name)
        if name and not (file.is_file() and file.suffix.lower() == ".svg"):
            self._blame("look.logo", f"there is no SVG file {file}")
        elif name:
            self._drawn("look.logo", name, Located(file), (file,))
            self.faults += picture_faults(file)

    def check_fonts(self) -> None:
        """See that the study's own fonts are there."""
        for name, file in zip(self._settings.look.fonts, self._settings.own_fonts, strict=True):
            if file.is_file() and file.suffix.lower() in _FONTS:
                self.sources.append(Source("look.fonts", name, file, is_shipped=False, sha256=_digest(file)))
            else:
                self._blame("look.fonts", f"there is no font {file} that ends in {', '.join(_FONTS)}")

    # What there is

    def read_tables(self) -> None:
        """Read the tables in which decks name their cards."""
        for _, board in _boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            if place is not None and not place.is_shipped and place.path not in self._tables:
                self._tables[place.path] = self.into(partial(read_names, place.path)) or {}

    def catalogues(self, actions: Sequence[ActionSpec]) -> dict[str, Catalogue]:
        """Return the sentences of every language.

        Each says all that the model language says, and what the actions need.
        """
        found: dict[str, Catalogue] = {}
        model = Catalogue(ASSETS / "sentences" / MODEL_LANGUAGE)
        for name in self._settings.languages:
            catalogue = self._catalogue(name, model, actions)
            if catalogue and catalogue.language in found:
                self._blame("languages", f"{catalogue.language!r} stands twice")
            elif catalogue:
                found[catalogue.language] = catalogue
        return found

    def _catalogue(self, name: str, model: Catalogue, actions: Sequence[ActionSpec]) -> Catalogue | None:
        """Return the sentences of one language, with the names of the cards that lie in the decks' own folders."""
        if self.at("languages", partial(standard, code_of(name))) is None:
            return None
        place = self.at("languages", partial(located, self._settings, "sentences", name))
        read = place and self._sources(place.path, code_of(name), actions)
        if place is None or not read:
            return None
        sources, words = read
        lines = self._replace_messages(code_of(name), sources, words)
        catalogue = self.into(partial(Catalogue, place.path, sources, words, lines))
        if catalogue is None:
            return None
        self.faults += _unknown_texts(catalogue, model)
        self._check_wording(catalogue, words)
        lacking = catalogue.lacking(model.messages)
        if lacking:
            self.faults.append(f"the sentences in {place.path} lack {', '.join(lacking)}")
        self.faults += _unsaid(actions, catalogue)
        if words or not place.is_shipped:
            from kiosk.study.forming import unformed  # noqa: PLC0415 - what comes with Recollect was formed by the tests

            self.faults += unformed(
                catalogue, model, self._cards(), max(self._settings.game.rows, self._settings.game.columns)
            )
        self._came("languages", name, place, _hash(sources.items()))
        for file in self._own_file(code_of(name)).values():
            self._came(f"texts.{code_of(name)}", file.name, Located(file), _digest(file))
        return catalogue

    def _sources(
        self, folder: Path, code: str, actions: Sequence[ActionSpec]
    ) -> tuple[dict[str, str], dict[str, Path]] | None:
        """Return the texts of a language by what they are called in records, and the files of those from elsewhere."""
        words = self._words_of_decks(code) | self._words_of_actions(code, actions) | self._own_file(code)
        words |= self._signed_file(code)
        sources = self.into(partial(sources_in, folder))
        texts = {key: self.into(partial(read_text, f"the file {file}", file)) for key, file in words.items()}
        if sources is None or None in texts.values():
            return None
        sources |= {key: text for key, text in texts.items() if text is not None}
        named = self._names_of_decks(code)
        return (
            sources | {key: names.to_ftl() for key, names in named.items()},
            words | {key: names.file for key, names in named.items()},
        )

    def _replace_messages(self, code: str, sources: dict[str, str], words: dict[str, Path]) -> dict[str, int]:
        """Add the messages that the study file itself replaces; returns the lines in which they stand there."""
        own, lines = self._settings.own_texts(code), dict[str, int]()
        if own:
            from kiosk.study.forming import as_messages  # noqa: PLC0415 - it loads Fluent

            sources[OWN_TEXTS] = as_messages(own)
        for message in own:
            words[OWN_TEXTS], line = self._settings.texts_place(code, message)
            lines |= {message: line} if line else {}
        return lines

    def _own_file(self, code: str) -> dict[str, Path]:
        """Return the file of a study's own words for messages of a language."""
        file = self._settings.own_texts_file(code)
        return {} if file is None else {f"{REPLACING}own-{file.name}": file}

    @cached_property
    def _signed(self) -> SignedWording | None:
        """The wording of hints that a person signed, if the study names one."""
        name = self._settings.assistance.wording
        if not name:
            return None
        from kiosk.study.wording_drafts import missing_languages, read_signed  # noqa: PLC0415 - for few studies

        folder = self._settings.beside(name)
        signed = self.at(WORDING, partial(read_signed, folder))
        if signed is not None:
            for language in missing_languages(signed, self._settings.language_codes):
                self._blame(WORDING, f"nothing in {folder} is signed for the language {language!r}")
            self._came(WORDING, name, Located(folder), signed.sha256, f"signed by {signed.name} on {signed.date}")
        return signed

    def _signed_file(self, code: str) -> dict[str, Path]:
        """Return the file of signed wordings of a language."""
        file = self._signed.files.get(code) if self._signed else None
        return {} if file is None else {SIGNED_TEXTS: file}

    def _check_wording(self, catalogue: Catalogue, words: Mapping[str, Path]) -> None:
        """See that the signed wordings are of hints, and that nothing else in the study replaces the same messages."""
        if SIGNED_TEXTS not in words:
            return
        from kiosk.study.wording_drafts import hint_messages, messages_in  # noqa: PLC0415 - for few studies

        signed = messages_in(catalogue.sources[SIGNED_TEXTS])
        for name in sorted(signed - set(hint_messages(catalogue))):
            self._blame(WORDING, f"{words[SIGNED_TEXTS]} has the message {name}, which is not of a hint")
        for key, source in catalogue.sources.items():
            if key.startswith(REPLACING) and key != SIGNED_TEXTS:
                for name in sorted(signed & messages_in(source)):
                    self._blame(WORDING, f"{words[key]} replaces the message {name}, too; take it out there")

    def _names_of_decks(self, code: str) -> dict[str, CardNames]:
        """Return the tables in which decks name their cards in a language, by what to call them in records."""
        found: dict[str, CardNames] = {}
        for _, board in _boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            named = {} if place is None else self._tables.get(place.path, {})
            if place is not None and code in named:
                found[f"{REPLACING}deck-{place.path.name}-names.ftl"] = named[code]
        return found

    def _words_of_actions(self, code: str, actions: Sequence[ActionSpec]) -> dict[str, Path]:
        """Return the files in which packages say their actions in a language."""
        files = {f"action-{each.label}.ftl": each.sentences / f"{code}.ftl" for each in actions if each.sentences}
        return {name: file for name, file in files.items() if file.is_file()}

    def _words_of_decks(self, code: str) -> dict[str, Path]:
        """Return the files with which decks name their own cards in a language, by what to call them in records."""
        words: dict[str, Path] = {}
        for _, board in _boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            if place is not None:
                there = (file for file in sorted(place.path.glob("*.ftl")) if code_of(file.stem) == code)
                words |= {f"{REPLACING}deck-{place.path.name}.ftl": file for file in there}
        return words

    def _cards(self) -> tuple[str, ...]:
        """Return the names of all cards that a visitor may see."""
        places = (self._settings.locate("cards", board.deck) for _, board in _boards(self._settings))
        return tuple(sorted({card for place in places if place for card in pictures_in(place.path)}))

    def sheets(self) -> dict[str, Information]:
        """Return what visitors are told in every language; the same in each."""
        text = self._settings.consent.text
        place = self.at("consent.text", partial(located, self._settings, "consent", text))
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
        """Return the one about the visitor, and those after the game; none of their names is the same."""
        settings = self._settings
        names = (("about_you", settings.about_you), *(("questionnaires", name) for name in settings.questionnaires))
        asked = tuple(read for key, name in names if (read := self._questionnaire(key, name)))
        for one, other in combinations(asked, 2):
            names_of_other = {item.id for item in other.items}
            both = [item.id for item in one.items if item.id in names_of_other]
            if one.id == other.id:
                self._blame("questionnaires", f"two of them have the id {one.id!r}")
            elif both:
                self._blame("questionnaires", f"{one.id!r} and {other.id!r} both have the items {', '.join(both)}")
        self.faults += unclear_names(self._asked)
        items = sum(len(each.items) for _, each in self._asked)
        if items > MOST_ITEMS:
            self._blame("questionnaires", f"together they have {items:,} items; a study has at most {MOST_ITEMS:,}")
        return asked

    def _questionnaire(self, key: str, name: str) -> Questionnaire | None:
        place = self.at(key, partial(located, self._settings, "questionnaires", name))
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
        """Yield what is wrong with the pictures of its scales."""
        for item in asked.items:
            if not isinstance(item, Pictures):
                continue
            try:
                place = located(self._settings, "scales", item.pictures)
            except UserInputError as error:
                yield from (f"{item.id}: {sentence}" for sentence in error.sentences)
            else:
                needed = tuple(place.path / f"{number}.svg" for number in range(1, item.points + 1))
                self._drawn(f"{asked.id}, {item.id}: pictures", item.pictures, place, needed)
                yield from (f"{item.id}: there is no picture {file}" for file in needed if not file.is_file())
                drawn = () if place.is_shipped else (file for file in needed if file.is_file())
                yield from (f"{item.id}: {fault}" for file in drawn for fault in picture_faults(file))

    def policy(self) -> QTable | None:
        """Return the frozen table."""
        return self._table("assistance.policy", self._settings.assistance.policy)

    def _table(self, key: str, name: str) -> QTable | None:
        if name == NONE:
            return QTable.blank()
        place = self.at(key, partial(located, self._settings, "policies", name))
        table = self.into(partial(QTable.load, place.path)) if place else None
        if place and table:
            self._came(key, name, place, table.sha256)
        return table

    def policies(self, policy: QTable | None) -> dict[str, QTable]:
        """Return the tables of all conditions, if any has one of its own; ``policy`` is that of the others."""
        named = {name: each.policy for name, each in self._settings.conditions.items() if each.policy}
        if policy is None or not named:
            return {}
        own = {name: self._table(f"conditions.{name}.policy", table) for name, table in named.items()}
        return {name: own.get(name) or policy for name in self._settings.all_conditions}

    def check_hints(self, tables: Iterable[QTable]) -> None:
        """See that the tables have the actions that are taken without asking them, as states name the last one."""
        assistance = self._settings.assistance
        needed = {
            "timing": (ActionSpec.SUG_COL, ActionSpec.SUG_CARD) if assistance.timing == "model" else (),
            "hesitation_action": (find_action(assistance.hesitation_action),) if assistance.hesitation_max else (),
        }
        for table in tables:
            for key, actions in needed.items():
                lacking = ", ".join(action.label for action in actions if action not in table.actions)
                if lacking:
                    self._blame(f"assistance.{key}", f"a table that the study names has no action {lacking}")

    def check_looks(self) -> None:
        """See that a robot looks at places, if hints are nothing but looks."""
        robot = self._settings.robot
        if robot.kind == NO_ROBOT or robot.gaze:
            return
        for name, cell in self._settings.conditions.items():
            if cell.gaze_only:
                self._blame(f"conditions.{name}.gaze_only", "robot.gaze is false, so the robot would look nowhere")

    def condition(self, key: str, name: str) -> Condition | None:
        """Return the condition of a name, if there is one."""
        known = self.at(key, partial(self._settings.condition, name))
        misread = read_as(name)
        if misread:
            self._blame(key, f"the condition {name!r} is taken for {misread} by programs that read tables")
        return Condition(name) if known else None

    def deck(self, key: str, board: Game | Practice) -> tuple[str, ...]:
        """Return the names of a deck's cards, in alphabetical order; there are enough for the board."""
        shape, places = f"a board of {board.rows} x {board.columns}", board.rows * board.columns
        if places % CARDS_IN_A_PAIR:
            self._blame(key, f"{shape} has {places} places, but cards come in pairs")
        place = self.at(f"{key}.deck", partial(located, self._settings, "cards", board.deck))
        if place is None:
            return ()
        pictures = pictures_in(place.path)
        self._drawn(f"{key}.deck", board.deck, place, pictures.values())
        cards = tuple(pictures)
        self.faults += () if place.is_shipped else deck_faults(place.path)
        self.faults += (f"the deck {place.path}: {sentence}" for sentence in unclear_cards(cards))
        pairs = places // CARDS_IN_A_PAIR
        if len(cards) < pairs:
            self._blame(f"{key}.deck", f"{shape} needs {pairs} pictures, but the deck {board.deck!r} has {len(cards)}")
        return cards

    # What does not fit

    def check_practice(self) -> None:
        """Refuse a practice that shows the pictures of the game before it."""
        settings = self._settings
        if "practice" in settings.stages and settings.practice.deck == settings.game.deck:
            self._blame("practice.deck", f"the game has the pictures {settings.game.deck!r} too; choose others")

    def check_pointer(self, sheets: Mapping[str, Information]) -> None:
        """Refuse to record the way of the pointer where no visitor can agree to it."""
        offered = {purpose.id for sheet in sheets.values() for purpose in sheet.consent.purposes}
        if self._settings.privacy.pointer_trace and sheets and POINTER not in offered:
            self._blame(
                "privacy.pointer_trace", f"the consent has no purpose {POINTER!r} that a visitor could agree to"
            )

    def check_returning(self, sheets: Mapping[str, Information]) -> None:
        """Refuse to let visitors come back where they cannot say so, or cannot agree to it freely."""
        settings = self._settings
        if not settings.returning.enabled:
            return
        lacking = [stage for stage in ("about", "consent", "debrief") if stage not in settings.stages]
        if lacking:
            self._blame("returning.enabled", f"visitors can come back only in a study with the stage {lacking[0]!r}")
        for language, sheet in sheets.items():
            offered = {purpose.id: purpose for purpose in sheet.consent.purposes}
            if RETURNING not in offered:
                why = f"has no purpose {RETURNING!r} that a visitor could agree to"
            elif offered[RETURNING].required:
                why = f"requires the purpose {RETURNING!r}, which must be free to refuse: write required = false"
            else:
                continue
            self._blame("returning.enabled", f"the consent in {language!r} {why}")
            break
        if settings.returning.condition == "next" and len(settings.randomisation.target_n) < _FEWEST_IN_TURN:
            self._blame("returning.condition", "'next' needs two conditions or more in randomisation.target_n")

    def check_allocation(self) -> None:
        """Every quota is one of a condition, and every block holds them in ratio."""
        declared = self._settings.randomisation
        named = {name: self.condition("randomisation.target_n", name) for name in declared.target_n}
        quotas = {condition: declared.target_n[name] for name, condition in named.items() if condition}
        if quotas and len(quotas) == len(named):
            self.at(
                "randomisation.block_size", partial(allocation_slots, quotas, declared.block_size, declared.seed or 0)
            )


_FEWEST_IN_TURN = 2
"""Conditions that can follow one another."""


def _hash_of_files(files: Iterable[Path]) -> str:
    """Return the hash over files that belong together, by their names and what is in them."""
    return _hash((file.name, _digest(file)) for file in files)


def _digest(file: Path) -> str:
    try:
        with open_to_read(file) as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()
    except OSError:
        # That it cannot be read is said elsewhere.
        return ""


def _hash(named: Iterable[tuple[str, str]]) -> str:
    return hashlib.sha256(json.dumps(sorted(named), ensure_ascii=False).encode()).hexdigest()
