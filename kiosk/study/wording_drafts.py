"""Draft the sentences of hints with a language model, let a person choose among them, and freeze what was signed.

A folder of wording holds ``draft-<language>.json`` while people work on it, and ``<language>.ftl`` with ``signed.toml``
once it is signed. Only the signed files are ever spoken.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import asdict, field, replace
from datetime import date
from enum import StrEnum
from itertools import product
from pathlib import Path
from typing import Any

from kiosk import UserInputError
from kiosk.assistance.claims import CLAIM_PHRASES, false_claims, false_places, histories, other_cards
from kiosk.assistance.hint_sentences import given_with
from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.assistance.wording import CARD, REPLACING, Catalogue
from kiosk.config import parse_toml, read_text
from kiosk.files import parse_json, write_file
from kiosk.lazy_dataclass import dataclass

SIGNED = "signed.toml"
LONGEST = 120
"""Characters of a sentence with its card and place filled in; longer ones do not fit a bubble in large text."""
MOST_PLACES = 6
_REASON = re.compile(r"reason-(first|second)-(.+)")
_VARIABLE = re.compile(r"\{\s*\$([A-Za-z][\w-]*)\s*\}")
_PLACEHOLDER = re.compile(r"\{\s*\$?([A-Za-z][\w-]*)\s*\}")
_BULLET = re.compile(r"^\s*(?:[-*•]|\(?\d{1,2}[.):])\s*")
_SENTENCES = re.compile(r"[A-Za-z-]+\.ftl")
_QUOTES = "\"'“”„«» "

Ask = Callable[[str, str], str]
"""Sends a system and a user text to a model, and returns its answer."""


class State(StrEnum):
    """What a person decided about a draft."""

    OPEN = "open"
    TAKEN = "taken"
    LEFT = "left"


@dataclass(frozen=True)
class Candidate:
    """One drafted wording of a message, as Fluent writes it, and everything found wrong with it."""

    text: str
    faults: tuple[str, ...] = ()
    state: State = State.OPEN


@dataclass
class Draft:
    """The drafted wordings of one language."""

    language: str
    style: str
    model: str = ""
    drafted: str = ""
    """The date, as in 2026-11-29."""
    messages: dict[str, list[Candidate]] = field(default_factory=dict)

    @classmethod
    def read(cls, folder: Path, language: str) -> Draft | None:
        """Return what a folder holds for a language, if anything; raises UserInputError."""
        file = _draft_file(folder, language)
        if not file.is_file():
            return None
        try:
            held = parse_json(read_text(f"the draft {file}", file))
            messages = {
                name: [Candidate(each["text"], tuple(each["faults"]), State(each["state"])) for each in candidates]
                for name, candidates in held.pop("messages").items()
            }
            return cls(**held, messages=messages)
        except (ValueError, LookupError, TypeError, AttributeError) as error:
            raise UserInputError(f"the draft {file} is damaged; remove it and draft anew") from error

    def write(self, folder: Path) -> None:
        """Put it into a folder; raises UserInputError."""
        folder.mkdir(parents=True, exist_ok=True)
        write_file(_draft_file(folder, self.language), json.dumps(self.as_dict(), ensure_ascii=False, indent=1) + "\n")

    def decide(self, message: str, number: int, state: State) -> None:
        """Take or leave a wording, counted from 1; raises UserInputError if it cannot be taken."""
        candidates = self.messages.get(message, [])
        if not 1 <= number <= len(candidates):
            raise UserInputError(f"there is no draft {message}.{number}")
        candidate = candidates[number - 1]
        if state is State.TAKEN and candidate.faults:
            raise UserInputError(f"{message}.{number} cannot be taken: {'; '.join(candidate.faults)}")
        candidates[number - 1] = replace(candidate, state=state)

    def check(self, checker: Checker) -> list[str]:
        """Check every wording anew and leave those that fail; returns what is wrong with those that were taken."""
        failed: list[str] = []
        for message, candidates in self.messages.items():
            for index, candidate in enumerate(candidates):
                faults = checker.faults(message, candidate.text)
                if faults and candidate.state is State.TAKEN:
                    failed.append(f"{self.language}: {message}.{index + 1}: {faults[0]}")
                candidates[index] = Candidate(candidate.text, faults, State.LEFT if faults else candidate.state)
        return failed

    def of_state(self, state: State) -> list[tuple[str, int]]:
        """Return the wordings of a state: their message and their number from 1."""
        return [
            (message, number)
            for message, candidates in self.messages.items()
            for number, candidate in enumerate(candidates, 1)
            if candidate.state is state
        ]

    def as_dict(self) -> dict[str, Any]:
        """Return what the file of the draft holds."""
        return asdict(self)

    def to_ftl(self, signed_by: str, on: date) -> str:
        """Return the wordings that were taken as a file of messages."""
        lines = [
            f"### Signed by {signed_by} on {on}.",
            f"### Drafted by {self.model or 'a language model'} on {self.drafted}, in the style: {self.style}",
        ]
        for message, candidates in self.messages.items():
            taken = [candidate.text for candidate in candidates if candidate.state is State.TAKEN]
            if taken:
                lines.append(f"{message} =")
                lines += [f"    .{_letter(index)} = {text}" for index, text in enumerate(taken)]
        return "\n".join(lines) + "\n"


def _letter(index: int) -> str:
    return chr(ord("a") + index) if index < 26 else f"z{index}"  # noqa: PLR2004 - letters


def _draft_file(folder: Path, language: str) -> Path:
    return folder / f"draft-{language}.json"


def hint_messages(catalogue: Catalogue) -> tuple[str, ...]:
    """Return the messages that can be drafted: the reasons and the places of hints."""
    return tuple(name for name in catalogue.written if name.startswith(("reason-", "point-")))


def messages_in(source: str) -> set[str]:
    """Return the names of the messages in a text of sentences."""
    from fluent.syntax import parse  # noqa: PLC0415 - a study is read without it where it can be
    from fluent.syntax.ast import Message  # noqa: PLC0415 - as above

    return {entry.id.name for entry in parse(source).body if isinstance(entry, Message)}


def prompt(message: str, catalogue: Catalogue, style: str, count: int) -> tuple[str, str]:
    """Return the system and the user text that ask for wordings of a message."""
    system = (
        "You rewrite one sentence that a friendly helper says in a memory game with picture cards. Keep exactly what "
        "it says about how often cards were seen, or where a card lies. Keep every placeholder in braces as it is. "
        "Add no fact, no number, no name. Answer with the sentences only, one on each line."
    )
    shipped = "\n".join(_as_placeholders(text) for text in _patterns(catalogue, message))
    user = (
        f"Language: {catalogue.language}. Style: {style}. Write {count} new short wordings of this sentence:\n{shipped}"
    )
    return system, user


def _patterns(catalogue: Catalogue, message: str) -> Iterator[str]:
    """Yield the wordings of a message that are written in one line, without cases for the kinds of cards."""
    for line in catalogue.written[message].text.splitlines():
        name, equals, text = line.partition("=")
        if equals and name.strip().startswith(".") and not text.endswith("->"):
            yield text.strip()


def _as_placeholders(text: str) -> str:
    return _VARIABLE.sub(lambda found: f"{{{found[1]}}}", text)


def wordings_in(answer: str, most: int) -> list[str]:
    """Return the wordings in a model's answer, each on a line of its own, as Fluent writes them."""
    found: list[str] = []
    for line in answer.splitlines():
        text = _BULLET.sub("", line).strip(_QUOTES)
        text = _PLACEHOLDER.sub(lambda name: f"{{ ${name[1]} }}", text)
        if text and text not in found and not text.endswith(":"):
            found.append(text)
    return found[:most]


class Checker:
    """Finds everything about a drafted wording that a program can decide."""

    def __init__(self, catalogue: Catalogue, cards: Iterable[str], most_rows: int) -> None:
        """Check against the sentences of a language, the names of all cards, and rows and columns up to a number."""
        self._catalogue = catalogue
        self._cards = tuple(cards)
        self._rows = range(1, min(most_rows, MOST_PLACES) + 1)
        self._names = {
            word.lower(): card for card in self._cards for word in catalogue.forms_of(card).values() if " " not in word
        }

    @property
    def checks_claims(self) -> bool:
        """Whether it can tell if a sentence of this language is true."""
        return self._catalogue.language in CLAIM_PHRASES

    def faults(self, message: str, text: str) -> tuple[str, ...]:
        """Return what is wrong with a wording; a fault that recurs with every card stands once."""
        if "\n" in text:
            return ("it must be one line",)
        if re.search(r"\d", text):
            return ("it has a figure; rows and columns come from the variables",)
        source = f"{REPLACING}draft.ftl"
        try:
            tried = Catalogue(
                self._catalogue.folder, {**self._catalogue.sources, source: f"{message} =\n    .a = {text}\n"}
            )
        except UserInputError:
            return ("it is not well-formed Fluent",)
        written = tried.written[message]
        if written.source != f"{message} =\n    .a = {text}\n" or tried.wordings_of(message) != 1:
            return ("it is not one wording",)
        return (*self._wrong_variables(message, text), *dict.fromkeys(self._when_said(message, tried)))

    def _wrong_variables(self, message: str, text: str) -> Iterator[str]:
        given = given_with(message) or frozenset()
        used = set(_VARIABLE.findall(text))
        known = {name for name in used if name in given or (CARD in given and name in self._catalogue.forms)}
        yield from (f"it asks for {{ ${name} }}, which does not exist here" for name in sorted(used - known))
        yield from (f"it lacks {{ ${name} }}" for name in sorted(given - {CARD} - used))
        names_none = f"${CARD}" not in self._catalogue.written[message].text
        if message.startswith("reason-") and known and names_none:
            yield "it names the card, of which this player knows nothing yet"

    def _when_said(self, message: str, tried: Catalogue) -> Iterator[str]:
        """Say it with every card, or with every place, and yield what is wrong each time."""
        reason = _REASON.fullmatch(message)
        for card in self._cards if reason else ("",):
            for place in ({},) if reason else self._places(message):
                values = tried.forms_of(card) if reason else place
                said = tried.wordings(message, **values) if tried.fault(message, values) is None else ()
                if not said:
                    yield "it cannot be said"
                    continue
                yield from self._of_sentence(said[0], card)
                if reason and self.checks_claims:
                    yield from self._of_reason(said[0], reason)
                elif self.checks_claims:
                    yield from false_places(said[0], self._catalogue.language, place)

    def _of_sentence(self, said: str, card: str) -> Iterator[str]:
        if len(said) > LONGEST:
            yield f"it is longer than {LONGEST} characters with some card or place"
        for other in other_cards(said, self._names, {card}):
            yield f"it names another card, {other}"

    def _of_reason(self, said: str, reason: re.Match[str]) -> Iterator[str]:
        card = FlipInMove.FIRST if reason[1] == "first" else FlipInMove.SECOND
        for mate, target in histories(card, HintReason(reason[2])):
            yield from false_claims(said, self._catalogue.language, card, mate, target)

    def _places(self, message: str) -> Iterator[dict[str, str | int]]:
        given = sorted(given_with(message) or ())
        for numbers in product(self._rows, repeat=len(given)):
            yield dict(zip(given, numbers, strict=True))


@dataclass(frozen=True)
class Drafter:
    """Asks a model for ``count`` wordings of a message, and checks each of them."""

    catalogue: Catalogue
    checker: Checker
    ask: Ask
    count: int

    def add_to(self, draft: Draft, message: str) -> None:
        """Replace the draft's wordings of a message by new ones, with what is wrong with each."""
        system, user = prompt(message, self.catalogue, draft.style, self.count)
        shipped = set(_patterns(self.catalogue, message))
        # Models like to repeat what they were shown.
        texts = [text for text in wordings_in(self.ask(system, user), 2 * self.count) if text not in shipped]
        texts = texts[: self.count]
        draft.messages[message] = [self._candidate(message, text) for text in texts]

    def _candidate(self, message: str, text: str) -> Candidate:
        faults = self.checker.faults(message, text)
        return Candidate(text, faults, State.LEFT if faults else State.OPEN)


# Signing


@dataclass(frozen=True)
class SignedWording:
    """A folder of wording that a person has signed; ``files`` are its sentences by language."""

    name: str
    date: date
    sha256: str
    files: Mapping[str, Path]


def sign_wording(folder: Path, drafts: Iterable[Draft], name: str, on: date) -> SignedWording:
    """Freeze the wordings that were taken; raises UserInputError while one is undecided or none was taken."""
    name = " ".join(name.split())
    if not name:
        raise UserInputError("--name: who signs?")
    drafts = tuple(drafts)
    undecided = [f"{draft.language}: {message}.{n}" for draft in drafts for message, n in draft.of_state(State.OPEN)]
    if undecided:
        raise UserInputError(
            f"{len(undecided)} wordings are neither taken nor left, such as {undecided[0]}; review them first"
        )
    for draft in drafts:
        if not draft.of_state(State.TAKEN):
            raise UserInputError(f"no wording in {draft.language!r} was taken, so there is nothing to sign")
    texts = {draft.language: draft.to_ftl(name, on) for draft in drafts}
    for language, text in texts.items():
        write_file(folder / f"{language}.ftl", text)
    hashes = {f"{language}.ftl": hashlib.sha256(text.encode()).hexdigest() for language, text in texts.items()}
    import tomlkit  # noqa: PLC0415 - few studies are signed

    document = tomlkit.document()
    document.add(tomlkit.comment("Written by 'recollect study wording sign'. A changed file has to be signed again."))
    document |= {"name": name, "date": on, "files": hashes}
    # Last, so that a signing that stops half way leaves sentences that do not match, and are refused.
    write_file(folder / SIGNED, tomlkit.dumps(document))
    return read_signed(folder)


def read_signed(folder: Path) -> SignedWording:
    """Return a signed folder; raises UserInputError if it is not signed, or has changed since."""
    file = folder / SIGNED
    if not file.is_file():
        raise UserInputError(f"the wording in {folder} is not signed; run 'recollect study wording sign'")
    text = read_text(f"the file {file}", file)
    try:
        held, _ = parse_toml(f"the file {file}", text)
        name, on, hashes = str(held["name"]), held["date"], dict(held["files"])
        is_sound = isinstance(on, date) and hashes and all(_SENTENCES.fullmatch(each) for each in hashes)
    except (UserInputError, ValueError, LookupError, TypeError) as error:
        raise UserInputError(f"{file} is damaged; sign the wording again") from error
    if not is_sound:
        raise UserInputError(f"{file} is damaged; sign the wording again")
    unsigned = sorted({each.name for each in folder.glob("*.ftl")} - set(hashes))
    changed = [each for each in sorted(hashes) if _sha256(folder / each) != hashes[each]]
    if changed or unsigned:
        raise UserInputError(
            f"{folder / (changed or unsigned)[0]} is not what {name} signed on {on}; review and sign the wording again"
        )
    sha256 = hashlib.sha256(json.dumps(hashes, sort_keys=True).encode()).hexdigest()
    return SignedWording(name, on, sha256, {each.removesuffix(".ftl"): folder / each for each in sorted(hashes)})


def _sha256(file: Path) -> str | None:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else None


def missing_languages(signed: SignedWording, languages: Collection[str]) -> tuple[str, ...]:
    """Return the languages of a study in which nothing was signed."""
    return tuple(language for language in languages if language not in signed.files)
