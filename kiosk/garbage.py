"""When Python looks for objects that only refer to each other."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_RARELY = (50_000, 20, 100)


@contextmanager
def rare_collections() -> Iterator[None]:
    """Look for such objects rarely while much is read that holds none; it saves a fifth of the time."""
    before = gc.get_threshold()
    gc.set_threshold(*_RARELY)
    try:
        yield
    finally:
        gc.set_threshold(*before)


@contextmanager
def no_collections() -> Iterator[Callable[[], None]]:
    """Look for none while a program is loaded, of which nothing becomes garbage; gives what ends this early."""
    gc.disable()
    try:
        yield gc.enable
    finally:
        gc.enable()
