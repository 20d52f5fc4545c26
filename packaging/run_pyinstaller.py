"""Runs PyInstaller faster: it reads only the instructions and statements that matter, and collects no garbage.

PyInstaller itself has :mod:`dis` make an object of each of two million instructions, which takes a third of its time.
Looking for what it could free takes another sixth. It visits every expression of a million in search of imports, and
asks again for the libraries that a file needs, as its cache lives only as long as the call. It compiles each module,
though Python keeps it compiled, and lists the libraries of a file by a shell script. What it finds is the same.
"""

from __future__ import annotations

import ast
import builtins
import dis
import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType, SimpleNamespace
from typing import Any, NamedTuple


class Instruction(NamedTuple):
    """What PyInstaller reads of an instruction."""

    opname: str
    argval: Any


CONSTANT = dis.opmap["LOAD_CONST"]
FOLLOWED = ("IMPORT_NAME", "STORE_NAME", "STORE_GLOBAL", "DELETE_NAME", "DELETE_GLOBAL")
NAMED = {dis.opmap[name]: name for name in FOLLOWED}
"""The instructions that PyInstaller looks at. It also reads the two constants before an import."""


def iterate_instructions(code: CodeType) -> Iterator[Instruction | None]:
    """Yield what PyInstaller looks at in a code object and in those within it; None ends each of them."""
    high = 0
    codes = code.co_code
    for operation, low in zip(codes[::2], codes[1::2], strict=True):
        if operation == dis.EXTENDED_ARG:
            high = (high | low) << 8
            continue
        if operation == CONSTANT:
            yield Instruction("LOAD_CONST", code.co_consts[high | low])
        elif operation in NAMED:
            yield Instruction(NAMED[operation], code.co_names[high | low])
        high = 0
    yield None
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from iterate_instructions(constant)


BLOCKS = ("body", "handlers", "cases", "orelse", "finalbody")
"""What holds further statements, in the order of the source; an expression holds none."""


def visit_statements(visitor: ast.NodeVisitor, node: ast.AST) -> None:
    """Visit the statements within a node, in place of everything within it."""
    for block in BLOCKS:
        for each in getattr(node, block, ()):
            visitor.visit(each)


def remembered(get_imports: Callable[..., Any]) -> Callable[..., Any]:
    """Return PyInstaller's function for the libraries that a file needs, which looks at each file once."""
    looked = cache(get_imports)

    def remember(filename: str, search_paths: Sequence[str] | None = None) -> Any:
        return looked(filename, search_paths if search_paths is None else tuple(search_paths))

    return remember


def compile_once(source: Any, filename: str, *settings: Any) -> Any:
    """Compile as Python does, but take a module that is parsed already from ``__pycache__``, if that is up to date.

    PyInstaller also parses the stub beside a compiled extension, and compiles it by the name of the extension.
    """
    if isinstance(source, ast.AST) and filename.endswith(".py"):
        return SourceFileLoader("", filename).get_code("")
    return builtins.compile(source, filename, *settings)


def loader(maps: Path = Path("/proc/self/maps")) -> str | None:
    """Return where the program is that loads libraries with glibc; None on other systems."""
    if not maps.is_file():
        return None
    files = (line.split(maxsplit=5)[-1] for line in maps.read_text("utf-8", "replace").splitlines())
    return next((file for file in files if Path(file).name.startswith("ld-linux")), None)


def without_ldd(program: str) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Return a way to run commands that has the loader itself list libraries, as ldd does, which calls it twice."""

    def run(command: Sequence[str], **options: Any) -> subprocess.CompletedProcess[str]:
        if command[0] != "ldd":
            return subprocess.run(command, check=False, **options)
        # With its own option, --list, it would end at a library that is missing.
        environment = os.environ | {"LD_TRACE_LOADED_OBJECTS": "1"}
        return subprocess.run((program, *command[1:]), env=environment, check=False, **options)

    return run


def main() -> None:
    """Run PyInstaller with the arguments of this program."""
    gc.disable()
    # The files of this folder must not pass for modules of the program or of PyInstaller.
    del sys.path[0]
    from PyInstaller.__main__ import run  # noqa: PLC0415 - only a build needs it
    from PyInstaller.depend import bindepend  # noqa: PLC0415
    from PyInstaller.lib.modulegraph import modulegraph, util  # noqa: PLC0415

    util.iterate_instructions = iterate_instructions
    modulegraph._Visitor.generic_visit = visit_statements
    # A module's own name goes before Python's.
    modulegraph.compile = compile_once
    if program := loader():
        bindepend.subprocess = SimpleNamespace(**vars(subprocess) | {"run": without_ldd(program)})
    bindepend.get_imports = remembered(bindepend.get_imports)
    run()


if __name__ == "__main__":
    main()
