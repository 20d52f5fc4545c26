"""In what two contents of a questionnaire differ, and what an item asks, in words."""

from __future__ import annotations

from collections.abc import Iterable

from kiosk.study.declared.questionnaire import Integer, Item, Multiple, Questionnaire, Rating, Single, TextPage
from kiosk.study.declared.words import in_language


def differences(one: Questionnaire, other: Questionnaire) -> list[str]:
    """The items and scales in which two contents of a questionnaire differ, in the languages that both have."""
    both = [{item.id: item for item in each.items} for each in (one, other)]
    languages = set.intersection(*({code for item in each.items for code in item.text} for each in (one, other)))
    names = dict.fromkeys((*both[0], *both[1]))
    found = [name for name in names if _differs(both[0].get(name), both[1].get(name), languages)]
    scales = [{name: summed(items) for name, items in each.scales.items()} for each in (one, other)]
    found += [name for name in dict.fromkeys((*scales[0], *scales[1])) if scales[0].get(name) != scales[1].get(name)]
    return found


def _differs(one: Item | None, other: Item | None, languages: Iterable[str]) -> bool:
    if one is None or other is None:
        return True
    return one.kind != other.kind or any(facts(one, code) != facts(other, code) for code in (*languages, ""))


def summed(items: Iterable[Rating]) -> tuple[object, ...]:
    """What a scale is the sum of."""
    return tuple((item.id, item.ends, item.reverse) for item in items)


def facts(item: Item, language: str) -> str:
    """What an item asks and what can be answered, in a language; in none of them, what can be answered."""
    match item:
        case Single() | Multiple():
            kind = "one of" if isinstance(item, Single) else "any of"
            told = (
                option.id + (f" ({in_language(option.text, language)})" if language else "") for option in item.options
            )
            answer = f"{kind} {', '.join(told)}"
        case Integer():
            answer = f"a whole number from {item.lowest} to {item.highest}"
        case _ if isinstance(item, Rating):
            least, most = item.ends
            answer = f"{least} to {most}" + (", turned round" if item.reverse else "")
            _, *ends = (f'"{in_language(words, language)}"' for words in item.texts())
            answer += f", from {' to '.join(ends)}" if language else ""
        case TextPage():
            answer = "a page to read"
        case _:
            answer = "a text"
    return f'"{in_language(item.text, language).strip()}" {answer}' if language else answer
