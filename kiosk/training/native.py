"""Compiles the long loops of the kernel as C when they are first used, and loads them.

A build brings its library along. Other installations look for one that the installation made, then for one in the
user's cache folder, and compile it into that. Where none of this works, the rules run as they are.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache, wraps
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, ParamSpec, TypeVar, cast, get_type_hints

from platformdirs import user_cache_path

from kiosk.files import replace_file
from kiosk.training.c_source import c_source, flat, plain_function

Given = ParamSpec("Given")
Back = TypeVar("Back")

MODULES = ("kiosk.training.learning", "kiosk.training.simulation")
"""Where the loops stand."""
FROZEN = bool(getattr(sys, "frozen", False))
"""Whether this is a build, which has no sources to compile."""


def _name_of_rules() -> str:
    """Return a name for the content of all rules: numba looks at the file of the outermost rule only."""
    if FROZEN:
        return "rules"
    names = Path(__file__).parents[1] / "assistance" / "policy.py"
    content = b"".join(file.read_bytes() for file in [names, *sorted(Path(__file__).parent.glob("*.py"))])
    return f"rules-{hashlib.sha256(content).hexdigest()[:16]}"


AHEAD = Path(sys.prefix) / "share" / "recollect" / _name_of_rules()
"""Where an installation keeps rules that it compiled beforehand; see ``kiosk.training.ahead``."""
SHIPPED = Path(__file__).with_name("loops.library")
"""The library of a build."""
COMPILER = None if FROZEN or sys.platform != "linux" else shutil.which("cc") or shutil.which("gcc")
"""The C compiler. It is looked for on Linux only: elsewhere the same name may ask people to install one."""
OPTIONS = ("-O2", "-ffp-contract=off", "-fPIC", "-shared", "-nostdlib", "-x", "c")
"""No step of the arithmetic may be joined with another, which would round differently on some processors."""
LONGEST = 60
"""Seconds after which a compiler is given up."""

_loops: list[Callable[..., Any]] = []


def is_switched_off() -> bool:
    """Whether NUMBA_DISABLE_JIT=1 asks that nothing be compiled."""
    return os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}


def may_be_native() -> bool:
    """Whether a library may be found or compiled here, so that arrays have to suit it."""
    return not is_switched_off() and (COMPILER is not None or any(place.is_file() for place in places()))


def places() -> list[Path]:
    """List where a library may lie, the best first; the user's own place is the last."""
    if FROZEN:
        return [SHIPPED]
    name = f"loops-{platform.machine() or 'machine'}.so"
    return [AHEAD / name, user_cache_path("recollect") / AHEAD.name / name]


@cache
def library() -> ctypes.CDLL | None:
    """Load the library, and compile it before if need be; None where that is impossible."""
    if is_switched_off():
        return None
    for place in places():
        with suppress(OSError):
            return ctypes.CDLL(str(place))
    if COMPILER is None:
        return None
    with suppress(OSError, subprocess.SubprocessError):
        return _compile_and_load(COMPILER)
    return None


def _compile_and_load(compiler: str) -> ctypes.CDLL:
    with TemporaryDirectory(prefix="recollect-", ignore_cleanup_errors=True) as folder:
        made = Path(folder) / "rules.so"
        compile_library(compiler, made)
        with suppress(OSError):
            keep(made, places()[-1])
        return ctypes.CDLL(str(made))


def compile_library(compiler: str, out: Path) -> None:
    """Write the loops in C and compile them; raises OSError or subprocess.SubprocessError."""
    for module in MODULES:
        import_module(module)
    subprocess.run(  # noqa: S603 - our own text and options
        [compiler, *OPTIONS, "-o", str(out), "-"],
        input=c_source(_loops),
        text=True,
        check=True,
        capture_output=True,
        timeout=LONGEST,
    )


def keep(made: Path, place: Path) -> None:
    """Copy a library to its place, whole or not at all."""
    place.parent.mkdir(parents=True, exist_ok=True)
    # What a power cut left of it cannot be loaded, and is compiled anew.
    replace_file(place, made.read_bytes(), 0o755, durable=False)


def native_loop(rule: Callable[Given, Back]) -> Callable[Given, Back]:
    """Mark a rule that plays many games in one call: it is taken from the library where there is one."""
    _loops.append(rule)
    function = plain_function(rule)

    @wraps(function)
    def played(*given: Given.args, **named: Given.kwargs) -> Back:
        found = library()
        if found is None or named:
            return rule(*given, **named)
        return cast("Back", entry_of(found, function)(*flattened(given)))

    return played


@cache
def entry_of(found: ctypes.CDLL, function: Any) -> Any:
    """Return the way into the library for a rule."""
    hints = get_type_hints(function)
    back = hints.pop("return")
    entry = getattr(found, function.__name__)
    entry.restype = {int: ctypes.c_longlong, float: ctypes.c_double}.get(back)
    entry.argtypes = [each for kind in hints.values() for part in flat(kind) for each in _ARGUMENTS[str(part)]]
    return entry


_ARGUMENTS: dict[str, tuple[Any, ...]] = {
    str(int): (ctypes.c_longlong,),
    str(float): (ctypes.c_double,),
    str(list[int]): (ctypes.c_void_p, ctypes.c_longlong),
    str(list[float]): (ctypes.c_void_p, ctypes.c_longlong),
}


def flattened(given: tuple[object, ...]) -> Iterator[Any]:
    """Yield what the way in takes: the address and length of each array, and each number."""
    for each in given:
        if isinstance(each, tuple):
            yield from flattened(each)
        elif isinstance(each, int | float):
            yield each
        else:
            whole = cast("Any", each)
            yield ctypes.addressof(ctypes.c_char.from_buffer(whole)) if len(whole) else None
            yield len(whole)
