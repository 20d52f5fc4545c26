"""PyInstaller is given the instructions that it looks at, as it would have read them itself."""

from __future__ import annotations

import ast
import dis
from itertools import pairwise
from pathlib import Path
from types import CodeType, SimpleNamespace
from typing import Any

import pytest

from tests.packaging.scripts import load

SCRIPT = load("run_pyinstaller")

MANY = "".join(f"name_{number} = {number}.5\n" for number in range(300)) + "import os.path as last\n"
"""More names and constants than one byte can number."""
WITHIN = "class Shelf:\n    from os import sep, path\n    def take(self):\n        global lost\n        del lost\n"


def read_by_dis(code: CodeType) -> list[tuple[str, Any]]:
    """Return the instructions that matter, read as PyInstaller reads them."""
    found = [(each.opname, each.argval) for each in dis.get_instructions(code) if each.opname in SCRIPT.FOLLOWED]
    return found + [one for each in code.co_consts if isinstance(each, CodeType) for one in read_by_dis(each)]


@pytest.mark.parametrize("source", [WITHIN, MANY, Path(__file__).read_text("utf-8")], ids=["within", "many", "this"])
def test_it_is_given_what_it_would_have_read(source: str) -> None:
    code = compile(source, "a module", "exec")
    read = [each for each in SCRIPT.iterate_instructions(code) if each is not None]
    assert [tuple(each) for each in read if each.opname != "LOAD_CONST"] == read_by_dis(code)


def test_the_constants_before_an_import_say_what_is_imported_from_where() -> None:
    code = compile("from ..shelf import one, two\n", "a module", "exec")
    read = [each for each in SCRIPT.iterate_instructions(code) if each is not None]
    ((level, names),) = [
        pair for pair, end in zip(pairwise(read), read[2:], strict=False) if end.opname == "IMPORT_NAME"
    ]
    assert (level.argval, names.argval) == (2, ("one", "two"))


NESTED = """
import a
def f():
    async def g():
        async with x, y:
            import b
        async for z in w:
            pass
        else:
            from . import c
class C:
    if (lambda: 0)():
        from d import *
    elif [e for e in f]:
        import e.f as g
    else:
        import h
try:
    import i
except (A if B else C):
    import j
else:
    import k
finally:
    import l
while x:
    match y:
        case 1:
            from m import n, o
try:
    import p
except* A:
    import q
"""


def test_the_same_imports_are_found_in_the_statements_alone() -> None:
    modulegraph = pytest.importorskip("PyInstaller.lib.modulegraph.modulegraph")
    quick = type("Quick", (modulegraph._Visitor,), {"generic_visit": SCRIPT.visit_statements})
    found = []
    for visitor in (modulegraph._Visitor, quick):
        module = SimpleNamespace(_deferred_imports=[])
        visitor(None, module).visit(ast.parse(NESTED))
        found.append([(star, what[0], what[2:], told) for star, what, told in module._deferred_imports])
    assert len(found[0]) == 13
    assert found[0] == found[1]


def test_a_file_is_asked_for_its_libraries_once() -> None:
    asked: list[tuple[str, Any]] = []

    def look(*what: Any) -> int:
        asked.append(what)
        return len(asked)

    get_imports = SCRIPT.remembered(look)
    told = [get_imports("a"), get_imports("a", ["b"]), get_imports("a", ["b"]), get_imports("a", search_paths=None)]
    assert (told, asked) == ([1, 2, 2, 1], [("a", None), ("a", ("b",))])
