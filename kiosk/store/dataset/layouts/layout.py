"""What every form of a data set does, and what it is told."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.followed import Followed
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.every import Tables
from kiosk.store.dataset.tables.flow import Flow

TASK = "concentration"


@dataclass(frozen=True)
class Contents:
    """What a data set is made of, but for the sittings."""

    study: Followed
    tables: Tables
    extras: frozenset[Extra]


class Layout(ABC):
    """Writes a data set into a folder, sitting by sitting."""

    def __init__(self, root: Path, contents: Contents) -> None:
        """Begin the files that sittings are added to."""
        self.root = root
        self.contents = contents

    @abstractmethod
    def add(self, kept: Kept) -> None:
        """Write what one sitting adds to the tables."""

    @abstractmethod
    def finish(self, flows: tuple[Flow, ...]) -> None:
        """Write what can only be told at the end, and all that describes the tables."""

    @abstractmethod
    def close(self) -> None:
        """Let go of all files, whether or not everything was written."""
