"""Check what the sentence of a hint claims against the player's history, as far as its words decide it.

The shipped sentences keep to a few phrases for "never", "once" and "more than once". A sentence that says the same in
other words is not recognised, and counts as wrong: a person can see that it is true, a program cannot.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from itertools import product

from kiosk.assistance.mentaliser import OFTEN, HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class ClaimPhrases:
    """The phrases, as regular expressions, by which a language's reasons say how often cards were turned up."""

    never: str
    """One of the two cards was never turned up; a reason says so if and only if it is true."""
    often: str
    """One of the two was turned up twice or more; of the open card ``known`` is said instead."""
    once: str
    """One of the two was turned up exactly once, after ``often`` and ``first_time`` are taken out."""
    new: str
    """The open card was never up before."""
    known: str
    """The open card was up before."""
    first_time: str
    """Words for "the first time", which do not claim that a card was up once."""
    row: str
    column: str
    pair: str
    """A pair was found, unless ``miss`` is said."""
    miss: str
    """No pair was found."""


CLAIM_PHRASES: Mapping[str, ClaimPhrases] = {
    "en": ClaimPhrases(
        never=r"never|\bnot\b|unseen|somewhere new|for the first time\.$|new, and its partner",
        often="more than once|at least twice",
        once=r"\bonce\b|one time|single time",
        new=r"is new\b|up for the first time",
        known=r"have (seen|met) this|was up before|have both been up",
        first_time="first time",
        row="row",
        column="column",
        pair=r"\bpair\b",
        miss=r"\bno pair\b",
    ),
    "it": ClaimPhrases(
        never=r"\bmai\b|non ancora|non sono ancora|ancora no\b|non l'hai ancora|non è ancora|non l'altr"
        r"|un[oa] sol[oa], |non hai ancora|tutta da scoprire|posto nuovo",
        often="più di una volta|almeno due volte",
        once=r"\buna volta\b|soltanto una\b",
        new=r"è nuova|prima volta",
        known=r"l'avevi già|era già uscita|avevi già incontrato quest",
        first_time="prima volta",
        row="riga",
        column="colonna",
        pair=r"\bcoppia\b",
        miss=r"niente coppia",
    ),
    "es": ClaimPhrases(
        never=r"nunca|ninguna|todavía no|aún no|no (el|la) otr|solo has visto un[oa], |por descubrir|sitio nuevo",
        often="más de una vez|al menos dos veces",
        once=r"\buna vez\b|\buna sola\b|solo una\b",
        new=r"es nueva|primera vez",
        known=r"la habías visto|ya había salido|ya te había salido est",
        first_time="primera vez",
        row="fila",
        column="columna",
        pair=r"\bpareja\b",
        miss=r"no hay pareja",
    ),
}
"""The languages whose claims can be checked."""

_MOST = OFTEN + 1
"""The largest number of flips that is tried: "twice or more" has two examples."""


def histories(card: FlipInMove, reason: HintReason) -> tuple[tuple[int, int], ...]:
    """Return the counts (mate, target), each up to 3, that a reason stands for.

    On a second card the mate is the open card, this flip included, so that its count is at least 1.
    """
    least = 1 if card is FlipInMove.SECOND else 0
    pairs = product(range(least, _MOST + 1), range(_MOST + 1))
    return tuple(pair for pair in pairs if HintReason.of(card, *pair) is reason)


def false_claims(sentence: str, language: str, card: FlipInMove, mate: int, target: int) -> Iterator[str]:
    """Yield what a reason claims wrongly, or leaves out, if the two cards were turned up so often.

    Raises KeyError for a language that is not in CLAIM_PHRASES.
    """
    phrases, is_second = CLAIM_PHRASES[language], card is FlipInMove.SECOND
    counts = (mate, target)
    yield from _both_ways(
        re.search(phrases.never, sentence, re.IGNORECASE), 0 in counts, "that a card was never turned up"
    )
    # "Before" is said of an open card that was up more than once.
    most = target if is_second else max(counts)
    yield from _both_ways(
        re.search(phrases.often, sentence, re.IGNORECASE), most >= OFTEN, "that a card was turned up more than once"
    )
    rest = re.sub(f"{phrases.often}|{phrases.first_time}", "", sentence, flags=re.IGNORECASE)
    if re.search(phrases.once, rest, re.IGNORECASE) and 1 not in counts:
        yield "it says that a card was turned up once"
    if is_second and re.search(phrases.new, sentence, re.IGNORECASE) and mate != 1:
        yield "it says that the open card is new"
    if is_second and re.search(phrases.known, sentence, re.IGNORECASE) and mate < OFTEN:
        yield "it says that the open card was up before"


def _both_ways(claimed: object, is_true: bool, what: str) -> Iterator[str]:  # noqa: FBT001 - what is compared
    if claimed and not is_true:
        yield f"it says {what}"
    elif is_true and not claimed:
        yield f"it does not say {what}"


def false_places(sentence: str, language: str, place: Mapping[str, str | int]) -> Iterator[str]:
    """Yield how a sentence gives away another place than ``place``, with its row and column counted from 1.

    Raises KeyError for a language that is not in CLAIM_PHRASES.
    """
    phrases = CLAIM_PHRASES[language]
    words = {"row": phrases.row, "column": phrases.column}
    for key, word in words.items():
        wanted = [str(place[key])] if key in place else []
        if re.findall(rf"\b{word}\b (\d+)", sentence, re.IGNORECASE) != wanted:
            yield f"it must say '{word} {wanted[0]}' once" if wanted else f"it must not name a {key}"
        elif not wanted and re.search(rf"\b{word}", sentence, re.IGNORECASE):
            yield f"it must not speak of a {key}"
    if len(re.findall(r"\d+", sentence)) != len(place):
        yield "it has other figures than those of the place"


def false_comments(sentence: str, language: str, *, matched: bool) -> Iterator[str]:
    """Yield what a comment on a move claims wrongly; it may say whether a pair was found, and nothing else.

    Raises KeyError for a language that is not in CLAIM_PHRASES.
    """
    phrases = CLAIM_PHRASES[language]
    miss = re.search(phrases.miss, sentence, re.IGNORECASE)
    if miss and matched:
        yield "it says that no pair was found"
    if not miss and not matched and re.search(phrases.pair, sentence, re.IGNORECASE):
        yield "it says that a pair was found"
    seen = (phrases.never, phrases.often, phrases.once, phrases.new, phrases.known)
    if any(re.search(phrase, sentence, re.IGNORECASE) for phrase in seen):
        yield "it must not say how often a card was turned up"
    yield from false_places(sentence, language, {})


def other_cards(sentence: str, names: Mapping[str, str], allowed: Collection[str]) -> tuple[str, ...]:
    """Return the cards that a sentence names besides those that it may; ``names`` gives the card of each lower word."""
    found = {names[word] for word in re.findall(r"\w+", sentence.lower()) if word in names}
    return tuple(sorted(found - set(allowed)))
