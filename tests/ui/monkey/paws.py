"""What the monkey does with keyboard, mouse and fingers, and how it learns where a press leads on."""

from __future__ import annotations

import json
import socket
from collections import Counter, defaultdict, deque
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from random import Random

from kiosk.config import Keys
from tests.ui.exits.attempts import FUNCTION_KEYS, SHORTCUTS
from tests.ui.exits.desktops import SIZE
from tests.ui.exits.hands import Devices
from tests.ui.monkey.kiosk import FINGERS

Place = tuple[int, int]

PLAIN = (
    *("Tab", "Return", "space", "Left", "Right", "Up", "Down", "BackSpace", "Delete", "Home", "End", "Prior", "Next"),
    *("a", "e", "n", "z", "0", "1", "2", "3", "7", "9", "period", "minus", "adiaeresis"),
)
EXPERIMENTERS = tuple(shortcut.lower() for shortcut in Keys().model_dump().values() if shortcut != Keys().quit)
"""The experimenter's shortcuts; the one that leaves comes more rarely, by itself."""
RETURNS = (*EXPERIMENTERS, "Return", "Escape", "Tab", "space")
KEPT_PLACES = 40
"""So many places that led on are remembered for each screen and kind of event."""
ON_PURPOSE = (0.0, 0.5, 0.75)
"""How often a press goes to one of them, by how many kinds of events are known on the screen."""
LEADS_ON = frozenset(
    (
        *("SessionStarted", "ContinuePressed", "ConsentPurposeToggled", "ConsentSubmitted"),
        *("AgeConfirmed", "PracticeSkipped", "CardSelected", "ResponseGiven", "PresenceConfirmed"),
    )
)
"""Events that are worth another press at the same place; to decline, to stop or to go back is not."""
WEIGHTS: dict[str, float] = {
    "click": 40,
    "touch": 12,
    "swipe": 4,
    "pinch": 2,
    "drag": 3,
    "button": 4,
    "wheel": 6,
    "move": 4,
}
WEIGHTS |= {"key": 14, "exit": 6, "experimenter": 1, "pin": 0.5, "wrong pin": 0.5}


class Monkey:
    """Presses anything."""

    def __init__(self, devices: Devices, folder: Path, pin: str, seed: int) -> None:
        """Take hold of keyboard and mouse; the kiosk in FOLDER takes its fingers."""
        self.inputs: Counter[str] = Counter()
        self._devices = devices
        self._pin = pin
        self._chance = Random(seed)
        self._glass = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._glass_at = str(folder / FINGERS)
        self._learnt: dict[str, dict[str, deque[Place]]] = defaultdict(dict)
        self._pressed: Place = (0, 0)
        self._kinds: dict[str, Callable[[str], None]] = {
            "click": self._click,
            "touch": lambda screen: self._fingers([self._place(screen)] * 2),
            "swipe": lambda _: self._fingers([self._anywhere(), self._anywhere()]),
            "pinch": lambda _: self._fingers(*([self._anywhere(), self._anywhere()] for _ in range(2))),
            "drag": lambda _: self._drag(),
            "button": self._other_button,
            "wheel": lambda _: devices.press(self._chance.choice(("wheel up", "wheel down")), self._anywhere()),
            "move": lambda _: devices.point(self._anywhere()),
            "key": lambda _: devices.key(self._chance.choice(PLAIN)),
            "exit": lambda _: devices.key(self._chance.choice((*SHORTCUTS, *FUNCTION_KEYS))),
            "experimenter": lambda _: devices.key(self._chance.choice(RETURNS)),
            "pin": lambda _: self._type(self._pin),
            "wrong pin": lambda _: self._type(f"{self._chance.randrange(10**6):06}"),
        }

    def act(self, screen: str) -> None:
        """Do one thing; ``screen`` is what is shown."""
        [kind] = self._chance.choices([*WEIGHTS], [*WEIGHTS.values()])
        self._kinds[kind](screen)
        self.inputs[kind] += 1

    def learn(self, screen: str, event: str) -> None:
        """Remember the last press if it led on."""
        if event in LEADS_ON:
            self._learnt[screen].setdefault(event, deque(maxlen=KEPT_PLACES)).append(self._pressed)

    def close(self) -> None:
        """Let go."""
        self._glass.close()
        self._devices.display.close()

    def _anywhere(self) -> Place:
        return self._chance.randrange(SIZE[0]), self._chance.randrange(SIZE[1])

    def _place(self, screen: str) -> Place:
        learnt = [*self._learnt[screen].values()]
        purpose = self._chance.random() < ON_PURPOSE[min(len(learnt), len(ON_PURPOSE) - 1)]
        self._pressed = self._chance.choice(self._chance.choice(learnt)) if purpose else self._anywhere()
        return self._pressed

    def _click(self, screen: str) -> None:
        self._devices.press("left", self._place(screen), times=self._chance.choice((1, 1, 1, 2)))

    def _other_button(self, screen: str) -> None:
        button = self._chance.choice(("right", "middle", "back", "forward"))
        self._devices.press(button, self._place(screen), shortcut=self._chance.choice(("", "", "alt", "ctrl", "super")))

    def _drag(self) -> None:
        self._devices.drag(self._anywhere(), self._anywhere(), steps=2)

    def _type(self, digits: str) -> None:
        for digit in digits:
            self._devices.key(digit)
        self._devices.key("Return")

    def _fingers(self, *paths: list[Place]) -> None:
        moves: list[tuple[str, int, int, int]] = []
        for what, place in (("press", 0), ("move", 1), ("release", 1)):
            moves += [(what, finger, *path[place]) for finger, path in enumerate(paths)]
        # There may be no kiosk just now.
        with suppress(OSError):
            self._glass.sendto(json.dumps(moves).encode(), self._glass_at)
