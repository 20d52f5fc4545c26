"""Files of a study that were changed at random end in a sentence, or are played, stored and exported.

RECOLLECT_FUZZ_S=600 tries for so many seconds and prints how many files there were; a run of all tests tries a few.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random

import pytest

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings
from kiosk.experiment.outcomes import Stage
from kiosk.study.checks import study_warnings
from kiosk.study.csv_import import Heading, as_toml, read_items
from kiosk.study.loader import read_study
from tests.experiment.driver import Driver
from tests.study.storing import store_and_export

FUZZ_S = float(os.environ.get("RECOLLECT_FUZZ_S", "0"))
"""For how long to try by hand; 0: SEEDS files."""
SEEDS = 60
LONGEST_SENTENCE = 1500
LONGEST_S = 5.0
"""How long one file may take, on a busy machine; the worst take less than one."""

STUDY = """
title = "A study"
languages = ["en"]
questionnaires = ["own.toml"]
[texts.en]
about-continue = "On"
[game]
rows = 2
columns = 4
deck = "./cards"
[consent]
text = "./sheets"
[conditions.mine]
target_rule = "random"
[conditions.tom]
[randomisation]
target_n = { tom = 2, mine = 2 }
block_size = 4
[robot]
kind = "furhat"
host = "robot"
board_middle = [0.4, -0.2, 0.5]
[look]
accent = "#22313F"
[experimenter]
opening_hours = "10:00-18:00"
"""
TABLE = "id,kind,points,text_en,lowest_en,highest_en,options_en,relevant\none,likert,5,How?,no,yes,,\n"
TABLE += 'two,single,,Which?,,,"a=A;b=B",one > 2\n'
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 240"><circle cx="120" cy="120" r="80"/></svg>'
VALUES = (
    *("", "0", "-1", "1e999", "inf", "-nan", "true", "[]", "{}", "[[]]", "''", '"\\u0000"', '"\\u202E"', '"\\n"'),
    *("9" * 30, "9" * 5000, "0x" + "f" * 5000, "1979-05-27T07:32:00Z", '"../../../etc/passwd"', '"/"', '"."', '".."'),
    *('"con"', '"participant_id"', '"{ $x }"', "'" + "x" * 3000 + "'", '"' + "a/" * 200 + '"', '"x.toml"', '"$HOME"'),
    *('{ en = "x" }', "{ en = {} }", '[1, "a", {}]', '"%s"', '"\\U0001F469\\u200D\\U0001F467"', "[" * 500, '"~"'),
)
PIECES = (
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    '"',
    "'",
    '"""',
    ",",
    "\n",
    ".",
    "\\",
    "#",
    "é",
    "\x00",
    "\x1b",
    ";",
    "<",
    "&",
)


def _values(text: str, chance: Random) -> str:
    """Put another value behind a key."""
    found = list(re.finditer(r"(?<=[=:])[^\n]+", text))
    if not found:
        return text
    place = chance.choice(found)
    return text[: place.start()] + chance.choice(VALUES) + text[place.end() :]


def _lines(text: str, chance: Random) -> str:
    """Take a line out, or write one or a thousand of them more, somewhere."""
    lines = text.splitlines(keepends=True)
    line = chance.choice(lines)
    at = chance.randrange(len(lines))
    return "".join([*lines[:at], *[line] * chance.choice((0, 1, 1, 1000)), *lines[at + 1 :]])


def _pieces(text: str, chance: Random) -> str:
    """Put something that files are made of somewhere."""
    at = chance.randrange(len(text) + 1)
    return text[:at] + chance.choice(PIECES) * chance.choice((1, 1, 1, 3000)) + text[at + chance.choice((0, 1, 20)) :]


def _keys(text: str, chance: Random) -> str:
    """Call a key otherwise."""
    words = list(re.finditer(r"[A-Za-z_-]{2,}", text))
    if not words:
        return text
    place, other = chance.choice(words), chance.choice(words)
    name = chance.choice((other[0], other[0].upper(), "k" * 500, "a.b.c", '"\\u0000"', '""', "__class__", place[0] * 2))
    return text[: place.start()] + name + text[place.end() :]


def _bytes(content: bytes, chance: Random) -> bytes:
    """Change single bytes, or the encoding of all of them."""
    if chance.random() < 0.2:
        return content.decode("utf-8", "replace").encode(chance.choice(("utf-16", "utf-8-sig", "utf-32")))
    changed = bytearray(content)
    for _ in range(chance.choice((1, 3, 30))):
        changed[chance.randrange(len(changed))] = chance.randrange(256)
    return bytes(changed[: chance.randrange(len(changed))] if chance.random() < 0.2 else changed)


CHANGES: tuple[Callable[[str, Random], str], ...] = (_values, _values, _values, _lines, _pieces, _keys)


def changed(content: bytes, chance: Random) -> bytes:
    """Return a file with one to four faults."""
    for _ in range(chance.choice((1, 1, 2, 4))):
        if chance.random() < 0.15 and content:
            content = _bytes(content, chance)
        elif text := content.decode("utf-8", "replace"):
            content = chance.choice(CHANGES)(text, chance).encode("utf-8", "replace")
    return content


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study with files of every kind."""
    here = tmp_path_factory.mktemp("any")
    (here / "cards").mkdir()
    for card in ("moon", "sun", "star", "cloud"):
        (here / "cards" / f"{card}.svg").write_text(SVG, "utf-8")
    (here / "cards" / "names.csv").write_text("card,en\nmoon,moon\nsun,sun\nstar,star\ncloud,cloud\n", "utf-8")
    shutil.copytree(ASSETS / "consent" / "study", here / "sheets")
    gallery = (ASSETS / "questionnaires" / "gallery.toml").read_text("utf-8")
    (here / "own.toml").write_text(re.sub('^id = "gallery"', 'id = "own"', gallery, flags=re.MULTILINE), "utf-8")
    (here / "study.toml").write_text(STUDY, "utf-8")
    (here / "table.csv").write_text(TABLE, "utf-8")
    return here


FILES = ("study.toml",) * 2 + ("own.toml",) * 2 + ("sheets/en.toml", "cards/names.csv", "cards/sun.svg", "table.csv")


def _tried(folder: Path, name: str) -> str:
    """Read everything, play, store and export what is accepted, and return what became of it."""
    try:
        if name == "table.csv":
            (folder / "own.toml").write_text(as_toml(read_items(folder / name, Heading("own", "1", "x"))), "utf-8")
        read = read_study(Settings.read(folder / "study.toml"))
        json.dumps([*study_warnings(read)], ensure_ascii=False).encode()
    except UserInputError as refusal:
        longest = max(refusal.sentences, key=len)
        return "refused" if len(longest) < LONGEST_SENTENCE else f"said at length: {longest[:200]}"
    driver = Driver(read.plans[0], seed=1)
    driver.to(Stage.OVER)
    store_and_export(read.plans[0], driver, folder / "data")
    return "exported"


def seeds() -> Iterator[int]:
    """Yield seeds: so many, or for so long."""
    if not FUZZ_S:
        yield from range(SEEDS)
        return
    end, seed = time.monotonic() + FUZZ_S, int(os.environ.get("RECOLLECT_FUZZ_SEED", "1000"))
    while time.monotonic() < end:
        yield seed
        seed += 1


@pytest.mark.slow
def test_a_file_that_was_changed_at_random_ends_in_a_sentence_or_is_exported(folder: Path) -> None:
    became: Counter[str] = Counter()
    slowest = (0.0, 0)
    faults: dict[str, int] = {}
    own = (folder / "own.toml").read_bytes()
    for seed in seeds():
        chance = Random(seed)
        name = chance.choice(FILES)
        file = folder / name
        whole = file.read_bytes()
        file.write_bytes(changed(whole, chance))
        began = time.monotonic()
        try:
            became[_tried(folder, name)] += 1
        except Exception as error:  # noqa: BLE001 - the test names the seed of every error
            faults.setdefault(f"{name}: {type(error).__name__}: {error}"[:300], seed)
        finally:
            slowest = max(slowest, (time.monotonic() - began, seed))
            file.write_bytes(whole)
            (folder / "own.toml").write_bytes(own)
    told = f"{became.total()} files: {dict(became)}; the slowest took {slowest[0]:.2f} s (seed {slowest[1]})"
    assert faults == {}, told
    assert set(became) <= {"exported", "refused"}, told
    assert became["refused"] > became["exported"] > 0, told
    assert slowest[0] < LONGEST_S, told
    if FUZZ_S:
        pytest.skip(told)
