"""Runs PyInstaller faster: it reads only the instructions and statements that matter, and collects no garbage.

PyInstaller itself has :mod:`dis` make an object of each of two million instructions, which takes a third of its time.
Looking for what it could free takes another sixth. It visits every expression of a million in search of imports, and
asks again for the libraries that a file needs, as its cache lives only as long as the call. What it finds is the same.
"""

from __future__ import annotations

import ast
import dis
import gc
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from types import CodeType
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
    bindepend.get_imports = remembered(bindepend.get_imports)
    run()


if __name__ == "__main__":
    main()
