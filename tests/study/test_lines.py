"""A refusal names the line in which the key stands."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import Settings
from kiosk.errors import toml_line, toml_lines
from kiosk.study.loader import read_study

TEXT = '''\
# a study
title = "A"

[game]
# the board
rows = 4
list = [
    1,
    2,
]
words = """
[no.table]
"""
[conditions.a]
timing = { mood_ms = 3 }
[[items]]
id = "one"
[[items]]
id = "two"
text.en = "Q"
[[items.options]]
id = "yes"
[[items.options]]
id = "no"
'''


@pytest.mark.parametrize(
    ("key", "line"),
    [
        (("title",), 2),
        (("game",), 4),
        (("game", "rows"), 6),
        (("game", "list", 1), 7),
        (("game", "words"), 11),
        (("game", "columns"), 4),
        (("conditions", "a", "timing", "mood_ms"), 15),
        (("items", 0), 16),
        (("items", 1, "likert", "text", "en"), 20),
        (("items", 1, "options", 1, "id"), 24),
        (("robot", "kind"), None),
        ((), None),
    ],
)
def test_the_line_of_a_key_is_found(key: tuple[str | int, ...], line: int | None) -> None:
    assert toml_line(TEXT, key) == line


def test_no_text_takes_long_to_look_into() -> None:
    assert toml_lines("x = [\n" + "1,\n" * 1000 + "]\n") == {}
    assert toml_lines("x = 1\n" * 100_000) == {}
    assert toml_lines("a = 1\nno toml\nb = 2\n") == {("a",): 1}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("title = 'A'\n[game]\n\nrows = 99\n", "game.rows must be from 1 to 12, but it is 99 (line 4)"),
        ("[game]\nrwos = 4\n", "game: there is no key 'rwos'; did you mean 'rows'? (line 2)"),
        ("[game]\ndeck = 'toys'\n", "game.deck: there is no deck 'toys' (shipped are animals, fruit)"),
        ("# x\nquestionnaires = [\n  'trust',\n  'no',\n]\n", "questionnaires: there is no questionnaire 'no'"),
        ("[randomisation]\nblock_size = 4\ntarget_n = { tomm = 3 }\n", "there is no condition 'tomm'"),
        ("languages = ['en', 'en']\n", "languages: 'en' stands twice"),
        (f"[timing]\nmood_ms = {'9' * 5000}\n", "but it is 999999999999... (line 2)"),
    ],
)
def test_a_refusal_of_a_study_file_names_file_key_and_line(text: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(text, "utf-8")
    with pytest.raises(UserInputError) as refused:
        read_study(Settings.read(file))
    (sentence,) = refused.value.sentences
    assert sentence.startswith(f"the study file {file}: ")
    assert said in sentence
    assert "(line " in sentence
