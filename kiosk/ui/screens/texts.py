"""The fixed texts of the screens, from the language's catalogue."""

from __future__ import annotations

from kiosk.assistance.wording import Catalogue

FIXED = (
    "about-continue",
    "consent-required",
    "consent-optional",
    "consent-missing",
    "consent-agree",
    "consent-decline",
    "age-line",
    "age-yes",
    "age-no",
    "introduction-title",
    "introduction-turn",
    "introduction-match",
    "introduction-help",
    "introduction-continue",
    "practice-title",
    "practice-skip",
    "result-title",
    "result-pairs-label",
    "result-moves-label",
    "result-time-label",
    "result-continue",
    "form-next",
    "form-skip",
    "form-missing",
    "form-refused",
    "form-none",
    "form-type",
    "form-less",
    "form-more",
    "keyboard-shift",
    "keyboard-delete",
    "keyboard-space",
    "keyboard-done",
    "debrief-code",
    "debrief-continue",
    "thanks-title",
    "thanks-line",
    "thanks-continue",
    "control-stop",
    "control-language",
    "control-text-size",
    "control-sound-on",
    "control-sound-off",
    "control-say-again",
    "control-back",
    "stop-title",
    "stop-yes",
    "stop-no",
    "scroll-more",
    "still-there-title",
    "still-there-line",
    "still-there-yes",
    "pause-title",
    "pause-line",
    "wait-title",
    "wait-line",
    "replay-line",
    "replay-differs",
)
"""Every message that QML shows as it stands; those with variables are filled in by the screens' objects."""


def fixed_texts(catalogue: Catalogue) -> dict[str, str]:
    """The fixed texts, by the names of their messages."""
    return {message: catalogue.text(message) for message in FIXED}
