"""Find out who comes back: one code at a time, and no more than three in a visit."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from kiosk import StorageError
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.codes import hashes_of
from kiosk.store.participants import ReturningVisitor
from kiosk.store.recorder import Recorder
from kiosk.ui.event_loop import Executor, InlineExecutor
from kiosk.ui.screens.returning import ReturnScreen
from kiosk.ui.screens.shell import KioskScreen

MOST_TRIES = 3
"""Codes that one visitor may try. To guess one of a million participants takes 26 million tries on average."""


class ReturnDesk:
    """Looks for the code that a visitor typed, and tells who they are."""

    def __init__(self, recorder: Recorder, screen: ReturnScreen, kiosk: KioskScreen) -> None:
        """Ask on this screen."""
        self.work: Executor = InlineExecutor()
        """Hashes codes, which takes some milliseconds."""
        self.on_found: Callable[[ReturningVisitor], None] = lambda _: None
        self.on_failure: Callable[[StorageError], None] = lambda _: None
        self._recorder = recorder
        self._screen = screen
        self._kiosk = kiosk
        self._kind = SessionKind.STUDY
        self._tries = self._visitor = 0
        self._checks = False
        screen.entered.connect(self._look_for)

    def begin(self, kind: SessionKind, *, offered: bool) -> None:
        """Get ready for a visitor, who may say that they were here before if it is ``offered``."""
        self._kind, self._tries = kind, 0
        self._visitor += 1
        self._screen.clear()
        self._screen.offer(offered=offered, site=self._recorder.site)

    def end(self) -> None:
        """Let no visitor say so, and forget what was typed."""
        self.begin(self._kind, offered=False)

    def _look_for(self, code: str) -> None:
        # One check at a time.
        if self._checks or self._tries == MOST_TRIES:
            return
        try:
            keys = self._recorder.code_keys()
        except StorageError as failure:
            self.on_failure(failure)
            return
        self._tries += 1
        self._checks = True
        self._screen.wait(checks=True)
        self.work(partial(hashes_of, code, keys), partial(self._hashed, self._visitor, code))

    def _hashed(self, visitor: int, code: str, hashes: tuple[bytes, ...]) -> None:
        self._checks = False
        if visitor != self._visitor:
            return
        self._screen.wait(checks=False)
        try:
            found = self._recorder.returning_visitor(code, hashes, self._kind)
        except StorageError as failure:
            self.on_failure(failure)
            return
        if found is not None:
            self._screen.clear()
            self.on_found(found)
        elif self._tries < MOST_TRIES:
            self._screen.refuse()
        else:
            self.end()
            self._kiosk.ask("unknown")
