"""PyInstaller is given the instructions that it looks at, as it would have read them itself."""

from __future__ import annotations

import ast
import dis
import py_compile
import subprocess
from itertools import pairwise
from pathlib import Path
from shutil import copyfile
from types import CodeType, SimpleNamespace
from typing import Any

import pytest
from PySide6 import QtCore

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


def test_a_parsed_module_is_taken_from_what_python_keeps_while_that_is_new(tmp_path: Path) -> None:
    module = tmp_path / "shelf.py"
    module.write_text("kept = 1\n", "utf-8")
    py_compile.compile(str(module), doraise=True)
    parsed = ast.parse("parsed = 1\n")
    kept = SCRIPT.compile_once(parsed, str(module), "exec", 0)
    assert (kept.co_names, kept.co_filename) == (("kept",), str(module))
    module.write_text("changed_since = 1\n", "utf-8")
    assert SCRIPT.compile_once(parsed, str(module), "exec", 0).co_names == ("changed_since",)


def test_the_stub_of_an_extension_and_what_is_no_module_are_compiled(tmp_path: Path) -> None:
    extension = str(tmp_path / "shelf.so")
    stub = SCRIPT.compile_once("stub = 1\n", extension, "exec", ast.PyCF_ONLY_AST)
    assert isinstance(stub, ast.Module)
    assert SCRIPT.compile_once(stub, extension, "exec", 0).co_names == ("stub",)


@pytest.mark.parametrize("lost", [0, 1], ids=["found", "lost"])
def test_the_loader_lists_the_libraries_that_ldd_lists(
    lost: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bindepend = pytest.importorskip("PyInstaller.depend.bindepend")
    program = SCRIPT.loader()
    if program is None:
        pytest.skip("this system has another loader than glibc's")
    library = Path(QtCore.__file__)
    if lost:
        # Away from its folder it does not find the libraries beside it.
        library = Path(copyfile(library, tmp_path / library.name))
    by_ldd = bindepend.get_imports(str(library))
    monkeypatch.setattr(
        bindepend, "subprocess", SimpleNamespace(**vars(subprocess) | {"run": SCRIPT.without_ldd(program)})
    )
    assert bindepend.get_imports(str(library)) == by_ldd
    assert any(place is None for _, place in by_ldd) == bool(lost)


def test_a_system_without_that_loader_keeps_ldd(tmp_path: Path) -> None:
    maps = tmp_path / "maps"
    assert SCRIPT.loader(maps) is None
    maps.write_text("7f-80 r-xp 0 fe:00 33 /lib/ld-musl-x86_64.so.1\n7f-80 rw-p 0 00:00 0\n", "utf-8")
    assert SCRIPT.loader(maps) is None
