"""A disk that can be full. It is real as far as SQLite is concerned: its file may not grow by another page."""

from __future__ import annotations

from pathlib import Path

from kiosk.store.recorder import Recorder


class _OnSmallDisk(Recorder):
    def may_grow_to(self, pages: int | None) -> None:
        """Let the database have so many pages; without a number, as many as it has."""
        [has] = self._connection.execute("PRAGMA page_count").fetchone()
        self._connection.execute(f"PRAGMA max_page_count = {has if pages is None else pages}")


class SmallDisk:
    """The disk under one recorder."""

    _MOST = 2**30 - 1
    """Pages; more than any test writes."""

    def open(self, folder: Path) -> Recorder:
        """Return a recorder for a data folder on this disk."""
        self._recorder = _OnSmallDisk(folder)
        return self._recorder

    def fill(self) -> None:
        """From now on the database may not grow."""
        self._recorder.may_grow_to(None)

    def empty(self) -> None:
        """There is room again."""
        self._recorder.may_grow_to(self._MOST)
