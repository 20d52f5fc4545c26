"""The list of what visitors and other programs may try; each is done as they would do it, and none knows the kiosk."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from functools import partial
from operator import methodcaller

from Xlib import X

from tests.ui.exits.desktops import SIZE
from tests.ui.exits.hands import Hands
from tests.ui.exits.kiosk import TOUCHES

WIDTH, HEIGHT = SIZE
MIDDLE = (WIDTH // 2, HEIGHT // 2)
EDGES = {
    "left": ((0, HEIGHT // 2), (WIDTH // 2, HEIGHT // 2)),
    "right": ((WIDTH - 1, HEIGHT // 2), (WIDTH // 2, HEIGHT // 2)),
    "upper": ((WIDTH // 2, 0), (WIDTH // 2, HEIGHT // 2)),
    "lower": ((WIDTH // 2, HEIGHT - 1), (WIDTH // 2, HEIGHT // 2)),
}
FREE = (8, HEIGHT - 8)
"""A place without a card."""
LONG_S = 1.2

REMOVE, ADD = 0, 1
ICONIC = 3

SHORTCUTS = (
    *("alt+F4", "Escape", "ctrl+w", "ctrl+q", "ctrl+c", "ctrl+z", "alt+Tab", "alt+shift+Tab", "ctrl+alt+Tab"),
    *("alt+Escape", "alt+space", "alt+Return", "super", "super+d", "super+e", "super+l", "super+r", "super+Tab"),
    *("super+F1", "super+F2", "super+F3", "super+F4", "ctrl+alt+Left", "ctrl+alt+Right", "ctrl+alt+Up"),
    *("ctrl+alt+Down", "shift+alt+Left", "shift+alt+Right", "super+shift+Left", "super+shift+Right"),
    *("ctrl+alt+t", "ctrl+alt+Delete", "ctrl+alt+BackSpace", "ctrl+shift+Escape", "ctrl+Escape"),
    *("Print", "alt+Print", "Menu", "shift+F10", "Pause", "Scroll_Lock", "Num_Lock", "Caps_Lock"),
    *("Multi_key", "ISO_Level3_Shift", "dead_acute", "ctrl+space", "Zenkaku_Hankaku", "Henkan"),
    *("ctrl+shift+u", "shift+Insert", "ctrl+v", "ctrl+plus", "ctrl+minus", "ctrl+0"),
    *("XF86_Back", "XF86_HomePage", "XF86_WWW", "XF86_Calculator", "XF86_LogOff", "XF86_Sleep", "XF86_Search"),
)
FUNCTION_KEYS = tuple(f"F{number}" for number in range(1, 13))


class By(Enum):
    """Who can do it."""

    VISITOR = "visitor"
    PROGRAM = "program"


@dataclass(frozen=True)
class Attempt:
    """One way to leave, by name."""

    name: str
    do: Callable[[Hands], object]
    by: By = By.VISITOR


def _keys() -> list[Attempt]:
    all_of = {"F1 to F12": FUNCTION_KEYS, "Alt+F1 to Alt+F10": [f"alt+{key}" for key in FUNCTION_KEYS[:10]]}
    rows = [Attempt(name, partial(_press_all, shortcuts)) for name, shortcuts in all_of.items()]
    return [*(Attempt(_spelt(shortcut), methodcaller("key", shortcut)) for shortcut in SHORTCUTS), *rows]


def _press_all(shortcuts: Iterable[str], hands: Hands) -> None:
    for shortcut in shortcuts:
        hands.key(shortcut)


def _back_and_forward(hands: Hands) -> None:
    for button in ("back", "forward"):
        hands.press(button, FREE)


def _visit_corners(hands: Hands) -> None:
    for corner in ((0, 0), (WIDTH - 1, 0), (0, HEIGHT - 1)):
        hands.point(corner)


def _spelt(shortcut: str) -> str:
    """As people write it: Ctrl+Alt+T."""
    return "+".join(part[0].upper() + part[1:] for part in shortcut.split("+"))


MOUSE = [
    Attempt("right click", lambda hands: hands.press("right", FREE)),
    Attempt("right click on a card", lambda hands: hands.press("right", MIDDLE)),
    Attempt("middle click (pastes)", lambda hands: hands.press("middle", MIDDLE)),
    Attempt("double click", lambda hands: hands.press("left", FREE, times=2)),
    Attempt("triple click", lambda hands: hands.press("left", FREE, times=3)),
    Attempt("long press", lambda hands: hands.press("left", FREE, hold_s=LONG_S)),
    Attempt("long press of the right button", lambda hands: hands.press("right", FREE, hold_s=LONG_S)),
    Attempt("back and forward buttons", _back_and_forward),
    *(Attempt(f"drag from the {edge} edge", methodcaller("drag", *path)) for edge, path in EDGES.items()),
    Attempt("drag out of the window", lambda hands: hands.drag(MIDDLE, (WIDTH + 200, HEIGHT + 200))),
    Attempt("drag with Alt (moves windows)", lambda hands: hands.drag(MIDDLE, (50, 50), shortcut="alt")),
    Attempt("right drag with Alt (resizes)", lambda hands: hands.drag(MIDDLE, (50, 50), "right", "alt")),
    Attempt("drag with Super", lambda hands: hands.drag(MIDDLE, (50, 50), shortcut="super")),
    Attempt("middle click with Alt (lowers)", lambda hands: hands.press("middle", MIDDLE, shortcut="alt")),
    Attempt("right click with Alt", lambda hands: hands.press("right", MIDDLE, shortcut="alt")),
    Attempt("wheel with Ctrl (zooms)", lambda hands: hands.press("wheel up", MIDDLE, times=3, shortcut="ctrl")),
    Attempt(
        "wheel with Alt (changes desktops)", lambda hands: hands.press("wheel down", MIDDLE, times=2, shortcut="alt")
    ),
    Attempt("wheel with Ctrl+Alt", lambda hands: hands.press("wheel down", MIDDLE, shortcut="ctrl+alt")),
    Attempt("wheel with Alt+Shift", lambda hands: hands.press("wheel down", MIDDLE, shortcut="alt+shift")),
    Attempt("hot corners", _visit_corners),
]

TOUCH = [Attempt(f"fingers: {gesture}", methodcaller("touch", gesture)) for gesture in TOUCHES]


def _state(name: str, action: int) -> Callable[[Hands], None]:
    return lambda hands: hands.ask("_NET_WM_STATE", action, hands.display.intern_atom(name), 0, 1)


def _restack(hands: Hands) -> None:
    hands.window.configure(stack_mode=X.Below)
    hands.display.sync()


def _shrink(hands: Hands) -> None:
    hands.window.configure(x=300, y=200, width=400, height=300)
    hands.display.sync()


def _unmap(hands: Hands) -> None:
    hands.window.unmap()
    hands.display.sync()


def _take_focus(hands: Hands) -> None:
    hands.root.set_input_focus(X.RevertToParent, X.CurrentTime)
    hands.display.sync()


def _show_desktops(hands: Hands) -> None:
    for desktop in (1, 2, 0):
        hands.ask("_NET_CURRENT_DESKTOP", desktop, window=hands.root)


PROGRAMS = [
    Attempt("close by the window manager", lambda hands: hands.ask("_NET_CLOSE_WINDOW"), By.PROGRAM),
    Attempt("WM_DELETE_WINDOW", lambda hands: hands.tell("WM_DELETE_WINDOW"), By.PROGRAM),
    Attempt("minimise", lambda hands: hands.ask("WM_CHANGE_STATE", ICONIC), By.PROGRAM),
    Attempt("end full screen", _state("_NET_WM_STATE_FULLSCREEN", REMOVE), By.PROGRAM),
    Attempt("put below", _state("_NET_WM_STATE_BELOW", ADD), By.PROGRAM),
    Attempt("shade", _state("_NET_WM_STATE_SHADED", ADD), By.PROGRAM),
    Attempt(
        "move and resize", lambda hands: hands.ask("_NET_MOVERESIZE_WINDOW", 0xF00, 300, 200, 400, 300), By.PROGRAM
    ),
    Attempt("move and resize at the server", _shrink, By.PROGRAM),
    Attempt("lower at the server", _restack, By.PROGRAM),
    Attempt("unmap at the server", _unmap, By.PROGRAM),
    Attempt("take the focus away", _take_focus, By.PROGRAM),
    Attempt("change desktops", _show_desktops, By.PROGRAM),
    Attempt(
        "stay on another desktop", lambda hands: hands.ask("_NET_CURRENT_DESKTOP", 1, window=hands.root), By.PROGRAM
    ),
    Attempt("send to another desktop", lambda hands: hands.ask("_NET_WM_DESKTOP", 2, 1), By.PROGRAM),
    Attempt(
        "show the empty desktop", lambda hands: hands.ask("_NET_SHOWING_DESKTOP", 1, window=hands.root), By.PROGRAM
    ),
    Attempt("another window on top", lambda hands: hands.cover(), By.PROGRAM),
    Attempt("another window above all", lambda hands: hands.cover(state="_NET_WM_STATE_ABOVE"), By.PROGRAM),
    Attempt("another full screen", lambda hands: hands.cover(state="_NET_WM_STATE_FULLSCREEN"), By.PROGRAM),
    Attempt("an unmanaged window", lambda hands: hands.cover(managed=False), By.PROGRAM),
]

ATTEMPTS = (*_keys(), *MOUSE, *TOUCH, *PROGRAMS)
