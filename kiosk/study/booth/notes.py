"""What is written down of the booth outside sittings, in the past tense, as events of sittings are."""

from __future__ import annotations

from enum import Enum


class Note(Enum):
    """The kinds of booth events."""

    CONDITION_CHOSEN = "ConditionChosen"
    BODY_CHOSEN = "BodyChosen"
    LANGUAGE_CHOSEN = "LanguageChosen"
    VOLUME_CHANGED = "VolumeChanged"
    SOUND_CHANGED = "SoundChanged"
    SITTING_STOPPED = "SittingStopped"
    SITTING_RESUMED = "SittingResumed"
    PIN_REFUSED = "PinRefused"
    PIN_ACCEPTED = "PinAccepted"
    PANEL_OPENED = "PanelOpened"
    KIOSK_LEFT = "KioskLeft"
    BACKUP_MADE = "BackupMade"
    BACKUP_FAILED = "BackupFailed"
    ROOM_CHANGED = "RoomChanged"


DEVIATIONS = frozenset(
    {
        Note.CONDITION_CHOSEN,
        Note.BODY_CHOSEN,
        Note.LANGUAGE_CHOSEN,
        Note.VOLUME_CHANGED,
        Note.SOUND_CHANGED,
        Note.SITTING_STOPPED,
        Note.SITTING_RESUMED,
        Note.PIN_REFUSED,
        Note.KIOSK_LEFT,
        Note.BACKUP_FAILED,
        Note.ROOM_CHANGED,
    }
)
"""What a day's protocol has to tell; the rest is routine."""
