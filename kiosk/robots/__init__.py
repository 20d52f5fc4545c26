"""Embodiments that speak: what a body is, and the voice in a process of its own. No windows, no database."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from kiosk import program

if TYPE_CHECKING:
    from kiosk.config import VoiceConfig

LOUDNESS_MS = 40
"""Length of one step of a sentence's loudness, in ms: 25 steps a second, the rate at which a mouth moves."""


def voice_options(settings: VoiceConfig, language: str, *, probe: bool = False) -> str:
    """Describe the voice of a language as JSON; with ``probe`` only the sound device is tried."""
    given = {"language": language, "rate": settings.rate, "volume": settings.volume, "device": settings.device}
    given["speaker"] = settings.speakers.get(language, "")
    return json.dumps(given | ({"probe": True} if probe else {}))


def voice_program(settings: VoiceConfig, language: str, *, probe: bool = False) -> tuple[str, ...]:
    """Return the command that starts the voice's process for a language."""
    return program("_voice", voice_options(settings, language, probe=probe))
