"""Recollect: a kiosk for studies in which a robot helps a person play Concentration.

The packages, from the bottom: game, assistance, experiment, then study, robots and store, which never import each
other, then export, ui, training and analysis, and cli on top. ``tests/test_walls.py`` checks the direction of imports.
"""

import errno
import os
import re
import shutil
import sys
from pathlib import Path

__version__ = "0.2.0"


_LONG_WORD = re.compile(r"\S{600,}")
"""Longer than any path that was meant; a value of thousands of characters would hide the sentence about it."""


class UserInputError(Exception):
    """Something that was handed to Recollect cannot be used; each sentence says what and where.

    Mostly there is one; a file that is checked as a whole has one for everything that is wrong with it. At the command
    line they become one line each and exit code 2. Nothing has been changed when it is raised.
    """

    def __init__(self, *sentences: str) -> None:
        """Say what is wrong."""
        self.sentences = tuple(_LONG_WORD.sub(lambda word: f"{word[0][:40]}...", each) for each in sentences)
        super().__init__(*self.sentences)

    def __str__(self) -> str:
        """Return the sentences, one per line."""
        return "\n".join(self.sentences)


class StorageError(Exception):
    """The disk did not take what happened; nothing of it was written. The message is for the experimenter.

    At the command line it becomes one line and exit code 1, as the same command may succeed later.
    """


DISK_FULL = "disk full"

NEARLY_NOTHING = 1024 * 1024
"""Bytes; where less is left, programs fail in ways that do not name the full disk as their reason."""


def is_nearly_full(folder: Path) -> bool:
    """Return whether the disk of a folder, which need not be there yet, has almost no room left."""
    there = next((place for place in (folder, *folder.absolute().parents) if place.is_dir()), folder)
    try:
        if sys.platform != "win32" and os.statvfs(there).f_flag & os.ST_RDONLY:
            # An image that is read only has no room and is not full.
            return False
        return shutil.disk_usage(there).free < NEARLY_NOTHING
    except OSError:
        return False


def why(error: OSError) -> str:
    """Say in words why the system refused; a full disk has one name, whatever the system calls it."""
    return DISK_FULL if error.errno in {errno.ENOSPC, errno.EDQUOT} else error.strerror or str(error)


def unwritable(what: str, error: OSError) -> UserInputError | StorageError:
    """Return what to raise when a file cannot be written; on a full disk the same command may succeed later."""
    words = why(error)
    return StorageError(f"{what}: {words}") if words == DISK_FULL else UserInputError(f"{what}: {words}")


def program(*arguments: str) -> tuple[str, ...]:
    """Return the command that runs ``recollect`` with these arguments in another process.

    It works from a checkout and from a build.
    """
    return (sys.executable, *(() if getattr(sys, "frozen", False) else ("-m", "kiosk")), *arguments)
