"""Read the texts of a study in every language: its sentences, and what decks, packages and the study itself add."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING

from kiosk.assistance.policy import ACTIONS, ActionSpec
from kiosk.assistance.wording import CARD, REPLACING, Catalogue, sources_in
from kiosk.config import ASSETS, Located, code_of, pictures_in, read_text
from kiosk.language_codes import standard
from kiosk.study.decks import CardNames, boards, read_names
from kiosk.study.findings import Findings, digest, hash_of, located

if TYPE_CHECKING:
    from kiosk.study.wording_drafts import SignedWording

SIGNED_TEXTS = f"{REPLACING}wording.ftl"
"""What the signed wordings of hints are called."""

WORDING = "assistance.wording"

OWN_TEXTS = f"{REPLACING}study.ftl"
"""What the messages are called that a study file itself replaces."""

MODEL_LANGUAGE = "en"
"""The language that all others are held against."""


class StudyTexts:
    """Reads the texts of a study; what is wrong becomes a finding."""

    def __init__(self, found: Findings) -> None:
        """Read what the settings of these findings name."""
        self._found = found
        self._settings = found.settings
        self._tables: dict[Path, dict[str, CardNames]] = {}

    def read_tables(self) -> None:
        """Read the tables in which decks name their cards."""
        for _, board in boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            if place is not None and not place.is_shipped and place.path not in self._tables:
                self._tables[place.path] = self._found.into(partial(read_names, place.path)) or {}

    def catalogues(self, actions: Sequence[ActionSpec]) -> dict[str, Catalogue]:
        """Return the sentences of every language.

        Each says all that the model language says, and what the actions need.
        """
        found: dict[str, Catalogue] = {}
        model = Catalogue(ASSETS / "sentences" / MODEL_LANGUAGE)
        for name in self._settings.languages:
            catalogue = self._catalogue(name, model, actions)
            if catalogue and catalogue.language in found:
                self._found.blame("languages", f"{catalogue.language!r} stands twice")
            elif catalogue:
                found[catalogue.language] = catalogue
        return found

    def _catalogue(self, name: str, model: Catalogue, actions: Sequence[ActionSpec]) -> Catalogue | None:
        """Return the sentences of one language, with the names of the cards that lie in the decks' own folders."""
        if self._found.at("languages", partial(standard, code_of(name))) is None:
            return None
        place = self._found.at("languages", partial(located, self._settings, "sentences", name))
        read = place and self._sources(place.path, code_of(name), actions)
        if place is None or not read:
            return None
        sources, words = read
        lines = self._replace_messages(code_of(name), sources, words)
        catalogue = self._found.into(partial(Catalogue, place.path, sources, words, lines))
        if catalogue is None:
            return None
        self._found.faults += _unknown_texts(catalogue, model)
        self._check_wording(catalogue, words)
        lacking = catalogue.lacking(model.messages)
        if lacking:
            self._found.faults.append(f"the sentences in {place.path} lack {', '.join(lacking)}")
        self._found.faults += _unsaid(actions, catalogue)
        if words or not place.is_shipped:
            from kiosk.study.forming import unformed  # noqa: PLC0415 - what comes with Recollect was formed by the tests

            self._found.faults += unformed(
                catalogue, model, self._cards(), max(self._settings.game.rows, self._settings.game.columns)
            )
        self._found.came("languages", name, place, hash_of(sources.items()))
        for file in self._own_file(code_of(name)).values():
            self._found.came(f"texts.{code_of(name)}", file.name, Located(file), digest(file))
        return catalogue

    def _sources(
        self, folder: Path, code: str, actions: Sequence[ActionSpec]
    ) -> tuple[dict[str, str], dict[str, Path]] | None:
        """Return the texts of a language by what they are called in records, and the files of those from elsewhere."""
        words = self._words_of_decks(code) | self._words_of_actions(code, actions) | self._own_file(code)
        words |= self._signed_file(code)
        sources = self._found.into(partial(sources_in, folder))
        texts = {key: self._found.into(partial(read_text, f"the file {file}", file)) for key, file in words.items()}
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
        signed = self._found.at(WORDING, partial(read_signed, folder))
        if signed is not None:
            for language in missing_languages(signed, self._settings.language_codes):
                self._found.blame(WORDING, f"nothing in {folder} is signed for the language {language!r}")
            self._found.came(WORDING, name, Located(folder), signed.sha256, f"signed by {signed.name} on {signed.date}")
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
            self._found.blame(WORDING, f"{words[SIGNED_TEXTS]} has the message {name}, which is not of a hint")
        for key, source in catalogue.sources.items():
            if key.startswith(REPLACING) and key != SIGNED_TEXTS:
                for name in sorted(signed & messages_in(source)):
                    self._found.blame(WORDING, f"{words[key]} replaces the message {name}, too; take it out there")

    def _names_of_decks(self, code: str) -> dict[str, CardNames]:
        """Return the tables in which decks name their cards in a language, by what to call them in records."""
        found: dict[str, CardNames] = {}
        for _, board in boards(self._settings):
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
        for _, board in boards(self._settings):
            place = self._settings.locate("cards", board.deck)
            if place is not None:
                there = (file for file in sorted(place.path.glob("*.ftl")) if code_of(file.stem) == code)
                words |= {f"{REPLACING}deck-{place.path.name}.ftl": file for file in there}
        return words

    def _cards(self) -> tuple[str, ...]:
        """Return the names of all cards that a visitor may see."""
        places = (self._settings.locate("cards", board.deck) for _, board in boards(self._settings))
        return tuple(sorted({card for place in places if place for card in pictures_in(place.path)}))


def _unsaid(actions: Sequence[ActionSpec], catalogue: Catalogue) -> Iterator[str]:
    """Yield what a language has no wordings for, of what actions say."""
    for action in actions:
        lacking = [message for message in action.messages if not catalogue.wordings_of(message)]
        # What comes with Recollect is looked for with all other messages.
        if lacking and action not in ACTIONS:
            yield f"the action {action.label!r} lacks {', '.join(lacking)} in {catalogue.language!r}"


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
