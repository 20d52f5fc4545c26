"""The settings of the window, its colours, its keys, and of the experimenter's panel."""

from __future__ import annotations

import re
from datetime import time
from typing import Annotated, Literal, Self

from pydantic import (
    Field,
    field_validator,
    model_validator,
)

from kiosk.config.models import MOST_CHARACTERS, MOST_ENTRIES, ConfigModel
from kiosk.units import Unit

MOST_REMINDER = 200
"""Characters of a line of the morning checklist."""

Side = Literal["left", "right"]


class Screen(ConfigModel):
    """The window."""

    display: Annotated[int, Field(ge=0, le=63, description="Which screen it covers; 0 is the primary one.")] = 0
    operator_display: Annotated[
        int,
        Field(ge=-1, le=63, description="Which screen has the experimenter's strip of one line; -1 is none."),
    ] = -1
    text_size: Annotated[float, Field(ge=0.5, le=1.3, description="All texts, as a factor of their usual size.")] = 1.0
    motion: Annotated[bool, Field(description="Whether cards turn and screens fade; off for reduced motion.")] = True
    contrast: Annotated[
        Literal["normal", "high"], Field(description="Whether colours differ as usual, or as much as they can.")
    ] = "normal"
    keyboard: Annotated[
        Literal["touch", "always", "never"],
        Field(
            description="When the keys on the screen come: for fields that are touched, for those that are clicked "
            "too, or never."
        ),
    ] = "touch"
    board_side: Annotated[Side, Field(description="On which side of the assistant the board is, on a wide screen.")] = (
        "left"
    )

    @model_validator(mode="after")
    def _keep_the_screens_apart(self) -> Self:
        if self.operator_display == self.display:
            raise ValueError("operator_display must not be the screen of the visitors, which display names")
        return self


_TEXT_COLOURS = ("#22313F", "#4A5A68", "#8A4B00")
"""What is written on the background, besides what has the accent's colour."""

_BOX = "#FFFBF2"
"""What is written on buttons, and the colour of boxes in which the accent's colour is written."""

_LEAST_CONTRAST = 4.5
"""WCAG 2.2, level AA."""

_SRGB_LINEAR, _SRGB_OFFSET, _SRGB_GAMMA = 0.04045, 0.055, 2.4


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours such as ``#22313F``, 1 to 21, by WCAG 2.2."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def luminance(colour: str) -> float:
    """Return how light a colour such as ``#22313F`` is, 0 to 1, by WCAG 2.2."""
    shares = (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    red, green, blue = (
        share / 12.92 if share <= _SRGB_LINEAR else ((share + _SRGB_OFFSET) / (1 + _SRGB_OFFSET)) ** _SRGB_GAMMA
        for share in shares
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _mixed(colour: str, end: int, share: float) -> str:
    """Return a colour that is so far on its way to black (0) or white (255)."""
    parts = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return "#" + "".join(f"{round(part + (end - part) * share):02X}" for part in parts)


def _passing(colour: str, end: int, others: tuple[str, ...]) -> str | None:
    """Return the colour closest to this one that stands out from all the others.

    It is on the way to black or white.
    """
    tried = (_mixed(colour, end, step / 50) for step in range(51))
    return next((each for each in tried if min(contrast(each, other) for other in others) >= _LEAST_CONTRAST), None)


class Look(ConfigModel):
    """The lab's own look: its name and logo on the start screen, and two of the colours."""

    name: Annotated[
        str, Field(max_length=60, description="The lab's name, on the start screen and on the card to take home.")
    ] = ""
    logo: Annotated[
        str, Field(max_length=MOST_CHARACTERS, description="The path of the lab's logo, an SVG file; empty: none.")
    ] = ""
    fonts: Annotated[
        tuple[str, ...],
        Field(
            strict=False,
            max_length=MOST_ENTRIES,
            description="The paths of fonts (.ttf, .otf or .ttc) for letters that the shipped one lacks.",
        ),
    ] = ()
    accent: Annotated[
        str, Field(description="The colour of buttons and titles; at 4.5:1 against light boxes and the background.")
    ] = "#1F5F6B"
    background: Annotated[
        str, Field(description="The colour behind everything, on which dark text is read at 4.5:1.")
    ] = "#FBF6EC"

    @field_validator("accent", "background")
    @classmethod
    def _be_a_colour(cls, colour: str) -> str:
        if not re.fullmatch(r"#[0-9A-Fa-f]{6}", colour):
            raise ValueError(f"{colour!r} is no colour such as '#1F5F6B'")
        return colour

    @model_validator(mode="after")
    def _be_readable(self) -> Self:
        self._check("background", self.background, 255, _TEXT_COLOURS, "the texts on it")
        self._check("accent", self.accent, 0, (_BOX, self.background), "what it is written on")
        return self

    def _check(self, key: str, colour: str, end: int, others: tuple[str, ...], what: str) -> None:
        least = min(contrast(colour, other) for other in others)
        if least < _LEAST_CONTRAST:
            passing = _passing(colour, end, others)
            # Rounded down: 4.49 is not to be read as 4.5.
            raise ValueError(
                f"{key}: the contrast of {colour!r} to {what} is {int(least * 10) / 10}:1, and must be 4.5:1; "
                f"{passing!r} would pass"
            )


class Keys(ConfigModel):
    """The experimenter's shortcuts, in Qt's spelling; an empty one switches the key off."""

    panel: Annotated[str, Field(description="Opens and closes the panel.")] = "Ctrl+Shift+P"
    condition: Annotated[str, Field(description="Chooses the next visitor's condition, one after another.")] = (
        "Ctrl+Shift+C"
    )
    embodiment: Annotated[str, Field(description="Lets the robot or the avatar help from the next session on.")] = (
        "Ctrl+Shift+B"
    )
    repeat: Annotated[str, Field(description="Says the last sentence again.")] = "Ctrl+Shift+A"
    mute: Annotated[str, Field(description="Makes the voice and the sounds silent, or heard again.")] = "Ctrl+Shift+M"
    pause: Annotated[str, Field(description="Stops the session for a while, and lets it go on.")] = "Ctrl+Shift+Space"
    abort: Annotated[str, Field(description="Ends the session, with a reason.")] = "Ctrl+Shift+E"
    volume: Annotated[str, Field(description="Makes voice and sounds louder, step by step, and soft again.")] = (
        "Ctrl+Shift+V"
    )
    next: Annotated[str, Field(description="Gets ready for the next visitor at once.")] = "Ctrl+Shift+N"
    quit: Annotated[str, Field(description="Leaves the kiosk.")] = "Ctrl+Shift+Q"

    @field_validator("*")
    @classmethod
    def _be_out_of_a_visitors_way(cls, shortcut: str) -> str:
        if shortcut and not re.fullmatch(
            r"(Shift\+)?F[1-9]\d?|(?=.*(Ctrl|Alt|Meta)\+)((Ctrl|Shift|Alt|Meta)\+)+[^+\s]+", shortcut
        ):
            raise ValueError(f"{shortcut!r} is no shortcut, such as 'Ctrl+Shift+P', and no function key")
        return shortcut

    @model_validator(mode="after")
    def _name_each_once(self) -> Self:
        shortcuts: dict[frozenset[str], str] = {}
        for key, shortcut in self.model_dump().items():
            other = shortcuts.setdefault(frozenset(shortcut.lower().split("+")), key) if shortcut else key
            if other != key:
                raise ValueError(f"{shortcut!r} stands for {other!r} and for {key!r}")
        return self


def read_hours(text: str) -> tuple[time, time]:
    """Read hours such as ``10:00-18:00``: from when, and until when.

    Raises ValueError for any other form, and where the end does not come after the beginning.
    """
    form = re.fullmatch(r"(\d\d:\d\d) ?- ?(\d\d:\d\d)", text, re.ASCII)
    try:
        opens, closes = map(time.fromisoformat, form.groups() if form is not None else ())
    except ValueError:
        opens = closes = time.min
    if opens >= closes:
        raise ValueError(f"{text!r} is not of the form '10:00-18:00', with the opening first")
    return opens, closes


class ExperimenterConfig(ConfigModel):
    """Who may change a running study."""

    pin_hash: Annotated[
        str,
        Field(
            exclude=True,
            description="The PIN, salted and hashed, as 'study set-pin' prints it; never recorded. Empty: none.",
        ),
    ] = ""
    hold_corner: Annotated[
        bool, Field(description="Whether holding an upper corner of the screen for 3 s asks for the PIN.")
    ] = True
    backup_every: Annotated[
        int,
        Unit("minutes"),
        Field(
            ge=1, le=10_080, description="How long after the last one a backup is made, in minutes, between sessions."
        ),
    ] = 60
    backups: Annotated[int, Field(ge=1, le=1000, description="How many backups are kept.")] = 24
    opening_hours: Annotated[
        str,
        Field(description="When visitors can come, such as '10:00-18:00'; for the alarm that none does. Empty: none."),
    ] = ""
    alone_alarm: Annotated[
        int,
        Unit("minutes"),
        Field(ge=1, le=1440, description="After how many of those minutes without a visitor it comes."),
    ] = 30
    alarm_sound: Annotated[
        Literal["between", "always", "never"],
        Field(description="When alarms sound: between sessions only, always, or never; they are shown in any case."),
    ] = "between"
    reminders: Annotated[
        tuple[Annotated[str, Field(min_length=1, max_length=MOST_REMINDER)], ...],
        Field(
            max_length=MOST_ENTRIES,
            strict=False,
            description="What 'recollect open-day' reminds you of, such as 'Put out fresh information sheets'.",
        ),
    ] = ()

    @field_validator("opening_hours")
    @classmethod
    def _open_before_closing(cls, hours: str) -> str:
        if hours:
            read_hours(hours)
        return hours

    @field_validator("pin_hash")
    @classmethod
    def _hash_the_pin(cls, pin: str) -> str:
        # It is not repeated: it may be the PIN itself.
        if not re.fullmatch(r"(scrypt:1[0-8]:[0-9a-f]{32}:[0-9a-f]{64})?", pin):
            raise ValueError("this is no hashed PIN, such as 'recollect study set-pin' prints")
        return pin
