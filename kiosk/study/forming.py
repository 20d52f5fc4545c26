"""Form every message of a study's own sentences with sample values, before a visitor hears it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from itertools import product

from fluent.syntax.ast import (
    FunctionReference,
    Message,
    MessageReference,
    SyntaxNode,
    Term,
    TermReference,
    VariableReference,
)
from fluent.syntax.visitor import Visitor

from kiosk.assistance.fluent_messages import parsed
from kiosk.assistance.hint_sentences import given_with
from kiosk.assistance.wording import CARD, Catalogue, Written

_TEXTS = frozenset({CARD, "ago", "code", "contact", "free", "participant", "stage", "what", "when", "why"})
"""The variables that are texts; all others are whole numbers."""

_NUMBERS = (0, 1, 2, 3, 5, 8, 11, 21, 100)
"""Languages have up to six forms of a noun after a number; each of them is among these in most."""

_FUNCTIONS = frozenset({"NUMBER", "DATETIME"})

_MOST = 20
"""Faults that are told of one language; they tend to be the same one in many places."""

_DEPENDS = re.compile(rf"\${CARD}\b|\{{\s*-?[a-z]")
"""A card's name, or another message or term: what a study can bring into a message that it did not write."""


def unformed(catalogue: Catalogue, model: Catalogue, cards: Iterable[str], most_rows: int) -> Iterator[str]:
    """Yield a sentence for every message that cannot be said; ``model`` is a catalogue that says everything."""
    samples = _Samples(catalogue, tuple(cards), most_rows)
    told = 0
    for name, written in catalogue.written.items():
        if is_as_shipped(written):
            continue
        for fault in _faults(name, written, catalogue, model, samples):
            told += 1
            if told > _MOST:
                yield f"the sentences in {catalogue.language!r}: more messages cannot be said"
                return
            yield fault


def as_messages(own: Mapping[str, str | Mapping[str, str]]) -> str:
    """Return messages that a study file replaces as Fluent writes them; a table holds the wordings of a message."""
    return "".join(f"{name} ={_pattern(own[name])}\n" for name in own)


def _pattern(value: str | Mapping[str, str]) -> str:
    if isinstance(value, str):
        return f" {_indented(value)}"
    return "".join(f"\n    .{wording} = {_indented(text)}" for wording, text in value.items())


def _indented(text: str) -> str:
    return text.strip().replace("\n", "\n        ")


def card_forms(catalogue: Catalogue) -> tuple[str, ...]:
    """Return the forms of a card's name, besides the name, that the sentences of a language use."""
    used = (name for written in catalogue.written.values() for name in _Uses.of(written).names(VariableReference))
    return tuple(sorted({name.removeprefix(f"{CARD}-") for name in used if name.startswith(f"{CARD}-")}))


def is_as_shipped(written: Written) -> bool:
    """Whether nothing in a message is the study's, so that the tests have formed it."""
    return written.late is not None and not _DEPENDS.search(written.late)


def _faults(name: str, written: Written, catalogue: Catalogue, model: Catalogue, samples: _Samples) -> Iterator[str]:
    given = _given(name, model)
    found = tuple(_unknown(name, written, catalogue, given))
    yield from found
    if found or given is None or name.startswith("-"):
        return
    if name in model.written and _shape(model.written[name]) != _shape(written):
        wants = "one text after =" if _shape(model.written[name]) else "wordings, such as .a = and .b ="
        yield f"{_where(written, written.entry)}: the message {name} must have {wants}"
        return
    for values in samples.of(given):
        why = catalogue.fault(name, values)
        if why is not None:
            told = ", ".join(f"{key} = {value}" for key, value in values.items())
            yield f"{_where(written, written.entry)}: the message {name} cannot be said with {told or 'nothing'}: {why}"
            return


def _given(name: str, model: Catalogue) -> frozenset[str] | None:
    """Return the variables that a message is given; None for one that is said only inside of others."""
    if name.startswith(f"{CARD}-"):
        return frozenset()
    hint = given_with(name)
    if hint is not None:
        return hint
    written = model.written.get(name)
    return None if written is None else frozenset(_Uses.of(written).names(VariableReference))


def _shape(written: Written) -> bool:
    """Whether a message is one text, and not several wordings."""
    return _entry(written).value is not None


def _entry(written: Written) -> Message | Term:
    """Return a message as Fluent's parser gives it, without parsing the rest of a shipped file."""
    if written.late is None:
        return written.entry
    (entry,) = (each for each in parsed(written.late).body if isinstance(each, Message | Term))
    return entry


def _unknown(name: str, written: Written, catalogue: Catalogue, given: frozenset[str] | None) -> Iterator[str]:
    """Everything that a message refers to and that does not exist."""
    uses = _Uses.of(written)
    forms = {key for key in catalogue.forms if key != CARD}
    for node in uses.nodes:
        where = partial(_where, written, node)
        match node:
            case VariableReference() if given is not None:
                variable = node.id.name
                known = given | (forms if CARD in given else frozenset())
                if variable not in known:
                    there = ", ".join(f"${each}" for each in sorted(known)) or "none"
                    yield f"{where()}: the message {name} asks for the variable ${variable}; it is given {there}"
            case MessageReference() if node.id.name not in catalogue.written:
                yield f"{where()}: the message {name} refers to a message {node.id.name}, which does not exist"
            case TermReference() if f"-{node.id.name}" not in catalogue.written:
                yield f"{where()}: the message {name} refers to a term -{node.id.name}, which does not exist"
            case FunctionReference() if node.id.name not in _FUNCTIONS:
                yield f"{where()}: the message {name} calls {node.id.name}(), which does not exist"


def _where(written: Written, node: SyntaxNode) -> str:
    """Return the file and line of a part of a message; of a shipped one, the line where it begins."""
    return f"{written.file}, line {written.line(node if written.late is None else written.entry)}"


class _Uses(Visitor):
    """Collects what a message refers to."""

    def __init__(self) -> None:
        self.nodes: list[VariableReference | MessageReference | TermReference | FunctionReference] = []

    @classmethod
    def of(cls, written: Written) -> _Uses:
        """Collect it of this message."""
        uses = cls()
        uses.visit(_entry(written))
        return uses

    def names(self, kind: type[VariableReference]) -> set[str]:
        """Return the names of one kind of what it refers to."""
        return {node.id.name for node in self.nodes if isinstance(node, kind)}

    def visit_VariableReference(self, node: VariableReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.nodes.append(node)

    def visit_MessageReference(self, node: MessageReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.nodes.append(node)

    def visit_TermReference(self, node: TermReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.nodes.append(node)
        self.generic_visit(node)

    def visit_FunctionReference(self, node: FunctionReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.nodes.append(node)
        self.generic_visit(node)


class _Samples:
    """Sample values for the variables of messages: every card, every place, and numbers of every form."""

    def __init__(self, catalogue: Catalogue, cards: tuple[str, ...], most_rows: int) -> None:
        self._cards = [catalogue.forms_of(card) for card in cards] or [catalogue.forms_of(CARD)]
        self._places = tuple(range(1, most_rows + 1))

    def of(self, given: frozenset[str]) -> Iterator[Mapping[str, str | int]]:
        """Yield values for all of these, every card and every place among them."""
        places = sorted(given & {"row", "column"})
        others = sorted(given - {CARD, "row", "column"})
        cards: list[dict[str, str]] = self._cards if CARD in given else [{}]
        numbers = _NUMBERS if any(name not in _TEXTS for name in others) else (1,)
        for place in product(self._places, repeat=len(places)):
            for card, number in product(cards, numbers):
                told: dict[str, str | int] = {name: name if name in _TEXTS else number for name in others}
                yield told | dict(zip(places, place, strict=True)) | card
