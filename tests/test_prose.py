"""Docstrings and pages are written in short, plain sentences."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
CODE = [*sorted((ROOT / "kiosk").rglob("*.py")), *sorted((ROOT / "packaging").rglob("*.py"))]
TESTS = sorted((ROOT / "tests").rglob("*.py"))
SCREENS = sorted((ROOT / "kiosk").rglob("*.qml"))
FOLDERS = ("docs", "packaging", "tests", ".github")
PAGES = [
    *(page for page in sorted(ROOT.glob("*.md")) if page.name != "CHANGELOG.md"),
    *(page for folder in FOLDERS for page in sorted((ROOT / folder).rglob("*.md"))),
]

AVOIDED = re.compile(r"\b(whoever|whosever|nobody|somebody|lies\s+with|is\s+told|be\s+it|shall)\b", re.IGNORECASE)
ARTICLE = re.compile(r"\ba (?!one|once|eu)[aeio][a-z]{3,}", re.IGNORECASE)
"""What has to be "an": renaming a thing leaves the article of its old name."""
FIRST_LINE_WORDS = 20
SENTENCE_WORDS = 40


ENTRY_WORDS = 6
"""By so many words, an entry of the changelog is about the same thing as another one."""


def avoided_words(text: str) -> list[str]:
    """Find avoided words and wrong articles, each with its line."""
    found = [*AVOIDED.finditer(text), *ARTICLE.finditer(text)]
    return [f"line {text.count(chr(10), 0, each.start()) + 1}: {each[0]}" for each in found]


DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def docstrings(source: str) -> list[str]:
    """Return all docstrings, of private things too."""
    return [ast.get_docstring(node) or "" for node in statements(ast.parse(source)) if isinstance(node, DOCUMENTED)]


def statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and the statements in it, and no expressions, which are nine nodes in ten."""
    yield node
    for block in ("body", "handlers", "orelse", "finalbody", "cases"):
        for each in getattr(node, block, ()):
            yield from statements(each)


def long_first_lines(source: str) -> list[str]:
    """Find the docstrings that begin with too long a line."""
    first_lines = [doc.partition("\n")[0] for doc in docstrings(source)]
    return [line for line in first_lines if len(line.split()) > FIRST_LINE_WORDS]


def long_sentences(page: str) -> list[str]:
    """Find long sentences in the running text of a page: not in code, tables, headings or generated parts."""
    text = re.sub(r"<!-- (\w+) -->.*?<!-- /\1 -->|^ *```.*?^ *```", "\n", page, flags=re.M | re.S)
    text = re.sub(r"^(\||#|    ).*$", "\n", re.sub(r"\]\([^)]*\)", "]", text), flags=re.M)
    paragraphs = re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", text)
    sentences = [each for paragraph in paragraphs for each in re.split(r"(?<=[.!?])[*)\"_]*\s", paragraph)]
    return [" ".join(each.split()) for each in sentences if len(each.split()) > SENTENCE_WORDS]


def test_avoided_words_and_wrong_articles_are_found_by_their_lines() -> None:
    assert avoided_words("An item, a user,\nonce a one and a euro") == []
    assert avoided_words("An item\nof nobody, a item") == ["line 2: nobody", "line 2: a item"]


def test_the_code_and_its_messages_use_plain_words() -> None:
    found = {path.relative_to(ROOT).as_posix(): avoided_words(path.read_text("utf-8")) for path in [*CODE, *SCREENS]}
    assert {path: words for path, words in found.items() if words} == {}


def test_the_docstrings_of_tests_use_plain_words() -> None:
    found = {path.relative_to(ROOT).as_posix(): docstrings(path.read_text("utf-8")) for path in TESTS}
    said = {path: [word for doc in docs for word in avoided_words(doc)] for path, docs in found.items()}
    assert {path: words for path, words in said.items() if words} == {}


def test_the_docstrings_begin_with_a_short_line() -> None:
    found = {path.relative_to(ROOT).as_posix(): long_first_lines(path.read_text("utf-8")) for path in CODE}
    assert {path: lines for path, lines in found.items() if lines} == {}


def test_a_page_has_plain_words_and_short_sentences() -> None:
    texts = {page.relative_to(ROOT).as_posix(): page.read_text("utf-8") for page in PAGES}
    assert {page: words for page, text in texts.items() if (words := avoided_words(text))} == {}
    assert {page: long for page, text in texts.items() if (long := long_sentences(text))} == {}


def test_avoided_words_are_found() -> None:
    assert avoided_words("Ask whoever is there.\nIt is\ntold. The nobody_set is a name.") == [
        "line 1: whoever",
        "line 2: is\ntold",
    ]


def test_long_lines_and_sentences_are_found() -> None:
    words = "word " * FIRST_LINE_WORDS
    assert long_first_lines(f'def short():\n    """{words.strip()}."""\n') == []
    assert long_first_lines(f'class Long:\n    """{words}and."""\n') == [f"{words}and."]
    assert long_sentences(f"A page. {words * 2}and more.\n\n| {words * 3} |\n") == [f"{words * 2}and more."]


def test_the_changelog_says_each_thing_once() -> None:
    # Two changes to one entry that meet leave both, and one of them is out of date.
    entries = re.findall(r"^- (.*(?:\n  .*)*)", (ROOT / "CHANGELOG.md").read_text("utf-8"), flags=re.M)
    beginnings = Counter(" ".join(entry.split()[:ENTRY_WORDS]) for entry in entries)
    assert [beginning for beginning, times in beginnings.items() if times > 1] == []
