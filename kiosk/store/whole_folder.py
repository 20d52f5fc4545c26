"""A folder that is there as a whole or not at all."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from kiosk import BadInput, unwritable

UNFINISHED = ".unfinished"


@contextmanager
def whole_folder(out: Path) -> Iterator[Path]:
    """A new folder beside ``out``, which takes its place at the end and is gone if anything goes wrong.

    Raises BadInput if it cannot be made, or if there is one already, which the end of the program cut off: it may hold
    what people said, so somebody should know of it. Raises OSError if the disk does not take all of it.
    """
    made = out.with_name(out.name + UNFINISHED)
    if made.exists():
        raise BadInput(f"{made} was left unfinished; remove it first")
    try:
        made.mkdir(mode=0o700, parents=True)
    except OSError as error:
        raise unwritable(f"the folder {out} cannot be used", error) from error
    try:
        yield made
        if out.exists():
            out.rmdir()
        made.rename(out)
    finally:
        shutil.rmtree(made, ignore_errors=True)
