"""What may not be meant in a study that can be run, and what `recollect check` says about it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from kiosk.assistance.policy import NONE
from kiosk.assistance.wording import CARD, Catalogue, Written, card_message
from kiosk.config import (
    ASSETS,
    ExperimenterConfig,
    Game,
    Keys,
    Practice,
)
from kiosk.experiment.condition import Condition
from kiosk.experiment.information import PUBLISHING, Information, Page
from kiosk.experiment.items import ShortText, TextPage, in_language
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.game import CARDS_IN_A_PAIR
from kiosk.preflight import CheckResult
from kiosk.study.decks import NAMES
from kiosk.study.forming import card_forms
from kiosk.study.package import shipped_differences
from kiosk.study.texts import MODEL_LANGUAGE, WORDING
from kiosk.study.translations import is_untranslated
from kiosk.units import MS_PER_MINUTE

SHIPPED_TEXT = "study"
"""The information sheets that come as an example."""

_WITHOUT = {
    "consent": "without the stage 'consent', visitors are not asked before their session is stored",
    "age": "without the stage 'age', visitors are not asked whether they are old enough",
    "debrief": "without the stage 'debrief', visitors do not see the code with which to withdraw",
}

PAIR_MS = 15_000
"""For each pair of a game: the study's slower condition took 15 s."""
ANSWER_MS = 3000
TYPING_MS = 15_000
TAP_MS = 2000
"""Our own guesses: from having read an item to its answer, to a typed one, and from the end of a text to the tap."""


def study_warnings(study: StudyConfig) -> tuple[str, ...]:
    """Return a sentence for everything that can be run but may not be meant."""
    return (
        *_of_package(study),
        *_of_texts(study),
        *_of_translations(study),
        *_of_names(study),
        *_of_cards(study),
        *_of_keys(study),
    )


def _of_package(study: StudyConfig) -> Iterator[str]:
    """Yield what comes with Recollect and was different where the study was packed."""
    origin = study.settings.package
    differing = [] if origin is None else list(shipped_differences(origin, study.sources))
    if origin is not None and (differing or study.sha256 != origin.sha256):
        what = ", ".join(differing) or "settings that it did not know"
        yield (
            f"{origin.path} was packed with another version of Recollect, in which this was different: {what}; so "
            f"sessions here have the study's hash {study.sha256[:SHORT_SHA]} and not {origin.sha256[:SHORT_SHA]}"
        )


def _of_texts(study: StudyConfig) -> Iterator[str]:
    settings = study.settings
    yield from (sentence for stage, sentence in _WITHOUT.items() if stage not in settings.stages)
    if settings.consent.text == SHIPPED_TEXT:
        yield "consent.text: the information sheets are the shipped example; an ethics board approves those of a study"
    purposes = {purpose.id for plan in study.plans for purpose in plan.information.consent.purposes}
    if "consent" in settings.stages and PUBLISHING not in purposes:
        yield f"consent.text: no purpose is named {PUBLISHING!r}, so nothing is left out of a data set for publishing"
    for name in sorted(condition.name for condition in _given(study)):
        if not settings.condition(name).helps:
            yield f"in the condition {name!r} there is no help, but the introduction promises it to everybody"
    if not settings.consent.contact:
        yield "consent.contact is empty, so visitors are not told whom to write to"


def _of_translations(study: StudyConfig) -> Iterator[str]:
    """Yield what was copied and not translated or rewritten."""
    for plan in study.plans:
        yield from _of_example(plan)
        english = plan.language.partition("-")[0] == MODEL_LANGUAGE
        model = Catalogue(ASSETS / "sentences" / MODEL_LANGUAGE).written
        own = {} if english else plan.catalogue.written
        same = [
            name
            for name, written in own.items()
            if name in model and is_untranslated(_said(written), _said(model[name]))
        ]
        if same:
            yield f"the sentences in {plan.language!r} are still English in {_counted(same)}"
    first, *others = study.plans
    for plan in others:
        same = list(_unchanged_items((plan.about_you, *plan.questionnaires), first.language, plan.language))
        if same:
            yield f"in {plan.language!r}, items are still in {first.language!r}: {_counted(same)}"
        pages = [
            [text for page in _pages(each.information) for text in (*page.points, *page.paragraphs)]
            for each in (first, plan)
        ]
        if set(pages[0]) & set(pages[1]):
            yield f"the information sheet in {plan.language!r} has paragraphs that are still in {first.language!r}"


def _said(written: Written) -> str:
    """Return a message without its name."""
    return written.text.partition("=")[2]


def _counted(names: Sequence[str]) -> str:
    shown = ", ".join(names[:3])
    return shown if len(names) <= 3 else f"{len(names)} places, such as {shown}"  # noqa: PLR2004


def _pages(sheet: Information) -> tuple[Page, ...]:
    return (sheet.about, sheet.consent, sheet.debrief)


@cache
def _examples(language: str) -> tuple[Information, ...]:
    """Return the sheets that come with Recollect in a language: the example, and those of the templates."""
    folders = (ASSETS / "consent" / SHIPPED_TEXT, *(ASSETS / "templates").glob("*/information"))
    files = (folder / f"{language}.toml" for folder in folders)
    return tuple(Information.read(file) for file in files if file.is_file())


def _of_example(plan: SessionConfig) -> Iterator[str]:
    """Yield that a sheet, wherever it lies, says what a shipped example says."""
    if plan.settings.consent.text == SHIPPED_TEXT:
        return
    examples = [_pages(sheet) for sheet in _examples(plan.language)]
    same = [
        name
        for at, name in enumerate(("about", "consent", "debrief"))
        if any(_pages(plan.information)[at].paragraphs == example[at].paragraphs for example in examples)
    ]
    if same:
        yield (
            f"the information sheet in {plan.language!r} still has the example's text under {', '.join(same)}; an "
            "ethics board approves those of a study"
        )


def _unchanged_items(asked: Iterable[Questionnaire], source: str, language: str) -> Iterator[str]:
    for each in asked:
        if _is_copied(each.title or {}, source, language):
            yield f"the title of {each.id}"
        yield from (item.id for item in each.items if any(_is_copied(text, source, language) for text in item.texts()))


def _is_copied(words: Mapping[str, str], source: str, language: str) -> bool:
    return is_untranslated(words.get(source, ""), words.get(language, ""))


def _given(study: StudyConfig) -> set[Condition]:
    """Return the conditions that visitors can get without a decision of the experimenter's."""
    return {plan.condition for plan in study.plans} | {
        Condition(name) for name in study.settings.randomisation.target_n
    }


def _of_names(study: StudyConfig) -> Iterator[str]:
    """Names that mean something shipped, although something beside the study file has them too."""
    for source in study.sources:
        if source.unused is not None:
            yield (
                f"{source.key}: {source.name!r} is the shipped {source.path}, and {source.unused} is not used; "
                f"write {_as_path(source.unused)!r} to use it, or rename it"
            )


def _as_path(path: Path) -> str:
    """How a study file names what lies in its own folder."""
    return path.name if path.suffix else f"./{path.name}"


def _of_cards(study: StudyConfig) -> Iterator[str]:
    for plan in study.plans:
        boards: dict[str, tuple[str, ...]] = {plan.settings.practice.deck: plan.practice_deck}
        for deck, cards in (boards | {plan.settings.game.deck: plan.deck}).items():
            folder = plan.settings.resolve_asset("cards", deck)
            if not plan.settings.is_shipped("cards", deck):
                yield from _of_forms(plan, folder, cards)
            unnamed = [name for name in cards if not plan.catalogue.names(name)]
            if unnamed:
                yield (
                    f"the deck {deck!r} has cards without a name in {plan.language!r}: {', '.join(unnamed)}; "
                    f"until they have one, their files' names are said. {_where_to_write(folder, unnamed, plan)}"
                )


def _of_keys(study: StudyConfig) -> Iterator[str]:
    """Yield the letters of a language that no key on the screen types, where something is to be typed."""
    if study.settings.screen.keyboard == "never":
        return
    for plan in study.plans:
        items = [item for asked in (plan.about_you, *plan.questionnaires) for item in asked.items]
        if not any(isinstance(item, ShortText) for item in items):
            continue
        rows = plan.catalogue.key_rows
        missing = rows.missing(_words_of(plan, items))
        if missing:
            more = f" and {len(missing) - _KEYS_TOLD} more" if len(missing) > _KEYS_TOLD else ""
            yield (
                f"the keys on the screen lack letters of the words in {plan.language!r}: "
                f"{' '.join(missing[:_KEYS_TOLD])}{more}; visitors without a keyboard cannot type them. Give "
                f"the language a message 'keyboard-rows': one row of letters a line"
            )


_KEYS_TOLD = 20
"""Of the letters without a key, how many are named."""


def _words_of(plan: SessionConfig, items: Iterable[Item]) -> Iterator[str]:
    """Yield what visitors read in a language: the information sheet, the questions, and the names of the cards."""
    sheet = plan.information
    for page in (sheet.about, sheet.consent, sheet.debrief):
        yield page.title
        yield from (*page.points, *page.paragraphs)
    yield from (purpose.text for purpose in sheet.consent.purposes)
    yield from (in_language(words, plan.language) for item in items for words in item.texts())
    yield from (plan.catalogue.card(card)[CARD] for card in plan.deck if plan.catalogue.names(card))


def _where_to_write(folder: Path, unnamed: Sequence[str], plan: SessionConfig) -> str:
    """Say what to write into which file, so that cards have names."""
    if (folder / NAMES).exists() or not any(folder.glob("*.ftl")):
        return f"Write them into the column {plan.language!r} of {folder / NAMES}"
    file = folder / f"{plan.language}.ftl"
    return f"Write into {file}: {'; '.join(f'{card_message(name)} = ...' for name in unnamed)}"


def _of_forms(plan: SessionConfig, folder: Path, cards: Sequence[str]) -> Iterator[str]:
    """Yield the forms of cards' names that the sentences of a language need and that are not there."""
    needed = card_forms(plan.catalogue)
    lacking = {card: [form for form in needed if form not in plan.catalogue.own_forms(card)] for card in cards}
    without = [card for card in cards if lacking[card] and plan.catalogue.names(card)]
    if without:
        forms = ", ".join(dict.fromkeys(f"{plan.language}.{form}" for card in without for form in lacking[card]))
        yield (
            f"the sentences in {plan.language!r} need more of a card than its name; "
            f"{', '.join(without)} in {folder} lack {forms}, and their names are said as they stand. "
            f"Add these columns to {folder / NAMES}"
        )


def expected_minutes(plan: SessionConfig) -> float:
    """About how long a visitor needs who reads and answers everything, in minutes."""
    return sum(_stage_times(plan).get(stage, TAP_MS) for stage in plan.settings.stages) / MS_PER_MINUTE


def _stage_times(plan: SessionConfig) -> Mapping[str, float]:
    """Return what each stage takes in ms, as far as it can be known beforehand."""
    settings, pages = plan.settings, plan.information
    return {
        "about": _reading(plan, *pages.about.paragraphs),
        "consent": _reading(plan, *pages.consent.paragraphs, *(each.text for each in pages.consent.purposes)),
        "about_you": sum(_answering(plan, item) for item in plan.about_you.items),
        "introduction": settings.timing.reading_ms_per_char * _INTRODUCTION + TAP_MS,
        "practice": min(settings.practice.max_duration_ms, _playing(settings.practice)),
        "game": _playing(settings.game),
        "questions": sum(_answering(plan, item) for asked in plan.questionnaires for item in asked.items),
        "debrief": _reading(plan, *pages.debrief.paragraphs),
    }


_INTRODUCTION = 200
"""Characters that the assistant says to a visitor who comes."""


def _reading(plan: SessionConfig, *texts: str) -> int:
    return sum(plan.settings.timing.reading_ms_per_char * len(text) for text in texts) + TAP_MS


def _answering(plan: SessionConfig, item: Item) -> int:
    answer = 0 if isinstance(item, TextPage) else TYPING_MS if isinstance(item, ShortText) else ANSWER_MS
    return plan.settings.timing.reading_ms_per_char * len(in_language(item.text, plan.language)) + answer


def _playing(board: Game | Practice) -> int:
    return PAIR_MS * board.rows * board.columns // CARDS_IN_A_PAIR


FILE, POLICY, LANGUAGES, PIN, KEYS = "study file", "policy", "languages", "PIN", "shortcuts"

POLICY_CARD = ".md"
"""Beside a policy's numbers stands a page that says what they were made for."""

SHORT_SHA = 8
_MEND = "mend the study file; 'recollect study check FILE' reads it again"


def faults_check(sentences: Sequence[str]) -> Iterator[CheckResult]:
    """Whatever keeps a study file from being used."""
    return (CheckResult.error(FILE, sentence, _MEND) for sentence in sentences)


def study_file_check(study: StudyConfig) -> Iterator[CheckResult]:
    """Yield what the study is, and what of it may not be meant."""
    longest = max(round(expected_minutes(plan)) for plan in study.plans)
    yield CheckResult.ok(FILE, f"{study.settings.title!r}, about {longest} minutes, {study.sha256[:SHORT_SHA]}")
    for caution in study_warnings(study):
        yield CheckResult.warning(FILE, caution, "change the study, if this is not intended")


def policy_check(study: StudyConfig) -> Iterator[CheckResult]:
    """Yield the frozen table, and the page about it."""
    table = study.plans[0].policy
    words = f"{table.name} {table.sha256[:SHORT_SHA]}"
    name = study.settings.assistance.policy
    card = None if name == NONE else study.settings.resolve_asset("policies", name).with_suffix(POLICY_CARD)
    if card is None or card.is_file():
        yield CheckResult.ok(POLICY, words)
    else:
        yield CheckResult.warning(POLICY, f"{words}; no page says how it was made", f"write {card}")


def wording_check(study: StudyConfig) -> Iterator[CheckResult]:
    """Yield who signed the wording of the hints, if it is not the shipped one."""
    for source in study.sources:
        if source.key == WORDING:
            yield CheckResult.ok("wording", f"{source.name}, {source.version}, {source.sha256[:SHORT_SHA]}")


def languages_check(study: StudyConfig) -> Iterator[CheckResult]:
    """Yield the languages that a visitor can choose, with their sentences and sheets."""
    plans = ", ".join(f"{plan.language} ({len(plan.catalogue.messages)} messages)" for plan in study.plans)
    yield CheckResult.ok(LANGUAGES, plans)


def pin_check(experimenter: ExperimenterConfig) -> Iterator[CheckResult]:
    """Whether the kiosk is closed, or open for trials alone."""
    if experimenter.pin_hash:
        yield CheckResult.ok(PIN, "set")
    else:
        remedy = "put what 'recollect study set-pin' prints into the study file, under [experimenter]"
        words = "none: every session is a trial, which is not exported, and 'recollect run --supervise' does not start"
        yield CheckResult.warning(PIN, words, remedy)


def shortcuts_check(shortcuts: Keys) -> Iterator[CheckResult]:
    """Whether the experimenter can get in and out; shortcuts that are none, or double, are refused with the file."""
    without = [name for name in ("panel", "quit") if not getattr(shortcuts, name)]
    if without:
        remedy = f"give shortcuts.{without[0]} a shortcut, such as 'Ctrl+Shift+P'"
        yield CheckResult.warning(KEYS, f"there is none for {' and '.join(without)}", remedy)
    else:
        yield CheckResult.ok(KEYS, f"{shortcuts.panel} opens the panel, {shortcuts.quit} leaves the kiosk")
