"""Who sits there: a participant of the study, a program, or a person who tries the kiosk before it is one."""

from __future__ import annotations

from enum import IntEnum

from kiosk.settings import Settings


class SessionKind(IntEnum):
    """The kinds of sittings. Each numbers its own people, follows its own list of places and is counted by itself.

    The numbers stand in the database, in the columns ``simulated``. ``False`` and ``True`` mean the first two.
    """

    STUDY = 0
    """A participant, at a kiosk that only the PIN leaves."""
    SIMULATED = 1
    """A program, in a rehearsal."""
    TRIAL = 2
    """A person at a kiosk without a PIN."""


def kind_of(settings: Settings) -> SessionKind:
    """Return what people's sittings at a kiosk with these settings are."""
    return SessionKind.STUDY if settings.experimenter.pin else SessionKind.TRIAL
