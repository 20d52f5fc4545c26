"""Which gesture shows which mood on a Furhat: only what the robot offers is asked for."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any

from kiosk.study.commands import Mood

WISHES: Mapping[Mood, tuple[str, ...]] = MappingProxyType(
    {
        Mood.IDLE: (),
        Mood.HAPPY: ("BigSmile", "Smile"),
        Mood.CONFUSED: ("BrowFrown", "Thoughtful"),
        Mood.SAD: ("ExpressSad",),
        Mood.THINKING: ("Thoughtful", "GazeAway"),
        Mood.LISTENING: ("Nod", "BrowRaise"),
    }
)
"""Built-in gestures for a mood, the best first; they end by themselves, so that idle needs none."""

CONFUSED: Mapping[str, Any] = MappingProxyType(
    {
        "name": "RecollectConfused",
        "frames": [
            {
                "time": [0.4, 1.6],
                "persist": False,
                "params": {
                    "BROW_UP_LEFT": 0.8,
                    "BROW_DOWN_RIGHT": 0.7,
                    "EYE_SQUINT_RIGHT": 0.4,
                    "MOUTH_RIGHT": 0.4,
                    "NECK_ROLL": 10,
                },
            },
            {"time": [2.2], "params": {"reset": True}},
        ],
        "class": "furhatos.gestures.Gesture",
    }
)
"""Nothing built in looks confused: one brow up, one down, the head to one side. Our own."""


def gesture(mood: Mood, offered: Collection[str]) -> str | None:
    """The best gesture for a mood among those that the robot offers, if there is any."""
    return next((wish for wish in WISHES[mood] if wish in offered), None)
