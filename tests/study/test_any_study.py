"""Random studies: what the check accepts is played, stored and exported, and what has a fault planted in it is refused.

RECOLLECT_STUDIES=300 tries so many of them; a run of all tests tries fewer.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings
from kiosk.experiment.outcomes import Stage
from kiosk.study.loader import read_study
from tests.experiment.driver import Driver, with_memory
from tests.study.storing import store_and_export

STUDIES = int(os.environ.get("RECOLLECT_STUDIES", "15"))
PAIRS = 4
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 240"><circle cx="120" cy="120" r="80"/></svg>'
BEGINS = {".svg": SVG.encode(), ".png": b"\x89PNG\r\n\x1a\n", ".jpg": b"\xff\xd8\xff", ".webp": b"RIFF0000WEBP"}


@dataclass
class Study:
    """A study as it is drawn, before it is written; a fault changes one of its parts."""

    languages: list[str]
    deck: dict[str, str]
    """The endings of the cards' files, by the cards."""
    names: dict[str, dict[str, str]]
    """The names of the cards by language; none is written where this is empty."""
    items: list[dict[str, object]]
    target_n: dict[str, int]
    texts: dict[str, str]
    seed: int
    per_page: int
    more: str = ""
    files: dict[str, bytes] = field(default_factory=dict)

    def write(self, folder: Path) -> Path:
        """Write all of it; the study file."""
        for name in ("cards", "sheets"):
            shutil.rmtree(folder / name, ignore_errors=True)
        (folder / "cards").mkdir()
        shutil.copytree(ASSETS / "consent" / "study", folder / "sheets")
        for card, ending in self.deck.items():
            (folder / "cards" / f"{card}{ending}").write_bytes(BEGINS[ending.lower()])
        if self.names:
            rows = [",".join(("card", *self.names))]
            rows += [",".join((card, *(self.names[each].get(card, "") for each in self.names))) for card in self.deck]
            (folder / "cards" / "names.csv").write_text("\n".join(rows), "utf-8")
        lines = "".join(f"[[items]]\n{_toml(item)}" for item in self.items)
        (folder / "own.toml").write_text(
            f'id = "own"\nversion = "1"\nnote = "ours"\nper_page = {self.per_page}\n{lines}', "utf-8"
        )
        texts = "".join(f"{name} = {json.dumps(text)}\n" for name, text in self.texts.items())
        for name, content in self.files.items():
            (folder / name).write_bytes(content)
        study = folder / "study.toml"
        named = {"languages": self.languages, "questionnaires": ["own.toml"]}
        parts = {
            f"texts.{self.languages[0]}": texts,
            "game": f'rows = 2\ncolumns = {PAIRS}\ndeck = "./cards"\n',
            "consent": 'text = "./sheets"\n',
            "randomisation": f"target_n = {_inline(self.target_n)}\nblock_size = {sum(self.target_n.values())}\n",
        }
        sections = "".join(f"[{name}]\n{lines}" for name, lines in parts.items())
        study.write_text(f"{_toml(named)}{sections}{self.more}", "utf-8")
        return study


def _toml(table: Mapping[str, object]) -> str:
    return "".join(f"{key} = {_inline(value)}\n" for key, value in table.items())


def _inline(value: object) -> str:
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {_inline(each)}' for key, each in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(_inline, value))}]"
    return json.dumps(value, ensure_ascii=False)


CARDS = st.text("abcdefgh äöü_-()1", min_size=1, max_size=8).map(str.strip).filter(lambda name: name.strip("-_ ()"))
WORDS = st.text("abc déñ '{}\"\\$#[]*.=-", min_size=1, max_size=12).filter(str.strip)
TEXTS = st.sampled_from(
    [
        ("about-continue", "On"),
        ("game-pairs", "{ $found } / { $all }"),
        ("form-next", 'words { "{" }'),
        ("result-line", "{ about-continue }"),
    ]
)


@st.composite
def studies(draw: st.DrawFn) -> Study:
    """Draw a study that is right."""
    languages = draw(st.lists(st.sampled_from(["en", "it", "es"]), min_size=1, max_size=2, unique=True))
    cards = draw(st.lists(CARDS, min_size=PAIRS, max_size=PAIRS + 2, unique_by=lambda name: name.replace("-", "_")))
    deck = {card: draw(st.sampled_from([*BEGINS, ".PNG"])) for card in cards}
    named = draw(st.lists(st.sampled_from(languages), unique=True))
    plain = WORDS.map(lambda text: text.replace('"', "").replace("\\", "") or "x")
    names = {language: {card: draw(plain) for card in cards} for language in named}
    items = [draw(_items(f"i{number}", languages)) for number in range(draw(st.integers(1, 4)))]
    for number, item in enumerate(items):
        if draw(st.booleans()):
            item["relevant"] = draw(_conditions(items[:number]))
    conditions = st.sampled_from(["tom", "notom", "mentalised_unexplained", "random_explained", "no_assistance"])
    target_n = dict.fromkeys(draw(st.lists(conditions, min_size=1, max_size=3, unique=True)), 2)
    texts, seed, per_page = dict(draw(st.lists(TEXTS, max_size=2))), draw(st.integers(0, 99)), draw(st.integers(1, 3))
    return Study(languages, deck, names, items, target_n, texts, seed, per_page)


@st.composite
def _items(draw: st.DrawFn, name: str, languages: list[str]) -> dict[str, object]:
    def words() -> dict[str, str]:
        return {language: draw(WORDS) for language in languages}

    kind = draw(st.sampled_from(["likert", "slider", "single", "multiple", "integer", "text", "page", "pictures"]))
    item: dict[str, object] = {"id": name, "kind": kind, "text": words()}
    if kind in {"likert", "pictures"}:
        item |= {"points": 5, "lowest": words(), "highest": words()}
    if kind == "pictures":
        item["pictures"] = "faces"
    if kind == "slider":
        item |= {"left": words(), "right": words()}
    if kind != "page":
        item |= {"required": draw(st.booleans()), "not_applicable": draw(st.booleans())}
    if kind in {"single", "multiple"}:
        item["options"] = [{"id": f"o{number}", "text": words()} for number in range(draw(st.integers(2, 3)))]
    return item


NUMBERS = {"likert": 3, "pictures": 3, "slider": 50, "integer": 7}
"""An answer to the items whose answers are numbers."""


@st.composite
def _conditions(draw: st.DrawFn, earlier: list[dict[str, object]]) -> str:
    """Draw a condition that is true of one set of answers, so that a study may have it; empty if nothing was asked.

    The answers: each number as above, the first option of the others, and every text written.
    """
    asked = [item for item in earlier if item["kind"] != "page"]
    parts = [draw(_simple(draw(st.sampled_from(asked)))) for _ in range(draw(st.integers(1, 3)) if asked else 0)]
    true = [text if holds else f"not ({text})" for text, holds in parts]
    joined = f" {draw(st.sampled_from(['and', 'or']))} ".join(true)
    return f"({joined})" if draw(st.booleans()) and joined else joined


@st.composite
def _simple(draw: st.DrawFn, item: dict[str, object]) -> tuple[str, bool]:
    """Draw a condition on an item, and whether it is true of that set of answers."""
    name, kind = item["id"], str(item["kind"])
    if draw(st.booleans()) or kind == "text":
        return f"answered({name})", True
    if kind in NUMBERS:
        sign, holds = draw(st.sampled_from([("=", True), ("!=", False), (">=", True), ("<", False), (">", False)]))
        return f"{name} {sign} {NUMBERS[kind]}", holds
    option = draw(st.sampled_from(["o0", "o1"]))
    if kind == "multiple" or draw(st.booleans()):
        return f"selected({name}, '{option}')", option == "o0"
    return f"{name} != '{option}'", option != "o0"


def _condition(study: Study, condition: str) -> None:
    """Ask a question, and another one on a condition."""
    first, last = ({"id": name, "kind": "text", "text": study.items[0]["text"]} for name in ("x", "y"))
    study.items += [first, last | {"relevant": condition}]


def _first(study: Study) -> str:
    return next(iter(study.deck))


FAULTS: dict[str, Callable[[Study], object]] = {
    "too few cards": lambda study: [study.deck.pop(_first(study)) for _ in range(len(study.deck) - PAIRS + 1)],
    "an empty picture": lambda study: study.files.update({"cards/zz.png": b""}),
    "a picture of another kind": lambda study: study.files.update({"cards/zz.jpg": BEGINS[".png"]}),
    "a photo that no screen shows": lambda study: study.files.update({"cards/zz.heic": b"heic"}),
    "a script": lambda study: study.files.update({"cards/zz.svg": SVG.replace("<circle", "<script/><circle").encode()}),
    "a card twice": lambda study: study.files.update({"cards/zz.svg": SVG.encode(), "cards/zz.png": BEGINS[".png"]}),
    "a name for no card": lambda study: study.files.update({"cards/names.csv": b"card,en\nno such card,x\n"}),
    "a column that is none": lambda study: study.files.update({"cards/names.csv": b"card,english\n"}),
    "no such variable": lambda study: study.texts.update({"game-pairs": "{ $gefunden }"}),
    "no such message": lambda study: study.texts.update({"game-peers": "words"}),
    "a text that is not closed": lambda study: study.texts.update({"form-next": "{ $"}),
    "one wording for several": lambda study: study.texts.update({"point-first-row": "Row { $row }"}),
    "no such condition": lambda study: study.target_n.update({"tomm": 2}),
    "no such language": lambda study: study.languages.append("xx"),
    "a language twice": lambda study: study.languages.append(study.languages[0]),
    "an item twice": lambda study: study.items.append(study.items[0]),
    "a kind that is none": lambda study: study.items[0].update(kind="likkert"),
    "a word that is missing": lambda study: study.items[0].update(text={"fr": "mot"}),
    "a condition that cannot be read": lambda study: _condition(study, "answered(x"),
    "a condition on no item": lambda study: _condition(study, "answered(nothing)"),
    "a condition on a later item": lambda study: _condition(study, "answered(y)"),
    "a condition that is never true": lambda study: _condition(study, "answered(x) and not answered(x)"),
    "a key that is none": lambda study: setattr(study, "more", "[timing]\nmood = 3\n"),
    "a number out of bounds": lambda study: setattr(study, "more", f"[timing]\nmood_ms = {10**30}\n"),
    "half a sheet": lambda study: study.files.update({f"sheets/{study.languages[0]}.toml": b'version = "1"\n'}),
    "a file that is missing": lambda study: setattr(study, "more", '[look]\nlogo = "none.svg"\n'),
    "a file that is not text": lambda study: study.files.update({"own.toml": b"\xff\xfe\x00"}),
}

RANDOM = settings(
    max_examples=STUDIES,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@RANDOM
@given(study=studies())
def test_a_study_without_a_fault_is_accepted_played_stored_and_exported(study: Study, tmp_path: Path) -> None:
    read = read_study(Settings.read(study.write(tmp_path)))
    drivers = []
    for language in read.languages:
        for condition in study.target_n:
            driver = Driver(read.plan(language, read.condition(condition)), seed=study.seed)
            driver.whole_session(with_memory(2))
            assert driver.stage is Stage.OVER
            drivers.append(driver)
    store_and_export(drivers[-1].plan, drivers[-1], tmp_path / "data")


@RANDOM
@given(study=studies(), fault=st.sampled_from(sorted(FAULTS)))
def test_a_study_with_a_fault_is_refused_in_sentences_that_name_a_file(
    study: Study, fault: str, tmp_path: Path
) -> None:
    FAULTS[fault](study)
    event(fault)
    with pytest.raises(UserInputError) as refused:
        read_study(Settings.read(study.write(tmp_path)))
    assert all(str(tmp_path) in each or str(ASSETS) in each for each in refused.value.sentences)
    assert all(len(each) < 600 and "Traceback" not in each for each in refused.value.sentences)
