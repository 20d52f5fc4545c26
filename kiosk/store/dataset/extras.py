"""What a data set may hold besides, for those who ask for it; without it nothing of this is told."""

from __future__ import annotations

from enum import Enum


class Extra(Enum):
    """Something that is left out unless it is asked for."""

    DATES = "dates"
    """When each sitting began."""
    REHEARSALS = "rehearsals"
    """Sittings in which nobody sat."""
    TRIALS = "trials"
    """Sittings at a kiosk without a PIN."""
    TEXTS = "texts"
    """What people typed, and what a failure said."""
    UNSHARED = "unshared"
    """Sittings whose visitor did not agree to publishing."""
