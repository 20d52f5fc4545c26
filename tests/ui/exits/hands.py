"""Hands and eyes in front of an X server: keys, mouse, what other programs ask for, and what is to be seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import monotonic, sleep

from PySide6.QtCore import QRect
from Xlib import XK, X, Xatom
from Xlib.display import Display
from Xlib.error import XError
from Xlib.ext import xtest
from Xlib.protocol.event import ClientMessage
from Xlib.xobject.drawable import Window

from tests.ui.exits.desktops import SIZE, Kiosk

PAPER = 0xFBF6EC
"""The colour that the kiosk shows there."""
NEAR = 3
"""How many pixels from the edge the colour is looked at."""

GAPS = ((0, 7), (2, 9), (8, 15), (16, 23))
"""Pairs of cards with a place in their middle that belongs to no card."""

MODIFIERS = {"ctrl": "Control_L", "alt": "Alt_L", "shift": "Shift_L", "super": "Super_L"}
BUTTONS = {"left": 1, "middle": 2, "right": 3, "wheel up": 4, "wheel down": 5, "back": 8, "forward": 9}
STEPS = 12
ANSWER_S = 2
HEARD_S = 1
"""How long to wait for a window manager to answer; not every desktop has one."""

for group in ("xf86", "xkb"):
    XK.load_keysym_group(group)


@dataclass(frozen=True)
class Standing:
    """How the kiosk stands, seen from outside; every field is true until it is left."""

    lives: bool
    full_screen: bool
    on_top: bool
    active: bool
    to_be_seen: bool

    @property
    def holds(self) -> bool:
        """Whether it stands as it should."""
        return self.lives and self.full_screen and self.on_top and self.active and self.to_be_seen

    @property
    def lacks(self) -> str:
        """What is not as it should be, in words."""
        return ", ".join(f"not {name.replace('_', ' ')}" for name, value in vars(self).items() if not value)


class Devices:
    """Keyboard and mouse of an X server."""

    def __init__(self, display: str) -> None:
        """Take hold of those of this server."""
        self.display = Display(display)
        self.display.set_error_handler(lambda *_: None)
        self.root = self.display.screen().root

    def key(self, shortcut: str) -> None:
        """Press and release keys together: ``ctrl+alt+Right``."""
        *held, last = shortcut.split("+")
        codes = [self._code(MODIFIERS.get(name, name)) for name in (*held, last)]
        for code in codes:
            self._fake(X.KeyPress, code)
        for code in reversed(codes):
            self._fake(X.KeyRelease, code)

    def press(self, button: str, at: tuple[int, int], times: int = 1, hold_s: float = 0.0, shortcut: str = "") -> None:
        """Click somewhere, perhaps several times, for long, or with keys held down."""
        with_keys = [self._code(MODIFIERS[name]) for name in shortcut.split("+") if name]
        self.point(at)
        for code in with_keys:
            self._fake(X.KeyPress, code)
        for _ in range(times):
            self._fake(X.ButtonPress, BUTTONS[button])
            sleep(hold_s)
            self._fake(X.ButtonRelease, BUTTONS[button])
        for code in with_keys:
            self._fake(X.KeyRelease, code)

    def drag(
        self,
        start: tuple[int, int],
        end: tuple[int, int],
        button: str = "left",
        shortcut: str = "",
        steps: int = STEPS,
    ) -> None:
        """Press somewhere, move, and let go somewhere else."""
        with_keys = [self._code(MODIFIERS[name]) for name in shortcut.split("+") if name]
        self.point(start)
        for code in with_keys:
            self._fake(X.KeyPress, code)
        self._fake(X.ButtonPress, BUTTONS[button])
        for step in range(1, steps + 1):
            self.point(tuple(a + (b - a) * step // steps for a, b in zip(start, end, strict=True)))
            sleep(0.01)
        self._fake(X.ButtonRelease, BUTTONS[button])
        for code in with_keys:
            self._fake(X.KeyRelease, code)

    def point(self, at: Sequence[int]) -> None:
        """Move the mouse somewhere."""
        xtest.fake_input(self.display, X.MotionNotify, x=at[0], y=at[1])
        self.display.sync()

    def _code(self, name: str) -> int:
        """Return the code of a key; a key that the keyboard lacks is given a place on it."""
        symbol = XK.string_to_keysym(name)
        assert symbol, f"there is no key {name}"
        code = self.display.keysym_to_keycode(symbol)
        if not code:
            code = self.display.display.info.max_keycode
            self.display.change_keyboard_mapping(code, [[symbol] * 2])
            self.display.sync()
        return code

    def _fake(self, kind: int, detail: int) -> None:
        xtest.fake_input(self.display, kind, detail)
        self.display.sync()


class Hands(Devices):
    """A person in front of a kiosk."""

    def __init__(self, kiosk: Kiosk) -> None:
        """Stand in front of it."""
        super().__init__(kiosk.environment["DISPLAY"])
        self.kiosk = kiosk
        self.window = self.display.create_resource_object("window", kiosk.begun["window"])
        self.made: list[Window] = []

    def touch(self, gesture: str) -> None:
        """Let fingers do something on the kiosk's window."""
        self.kiosk.ask(gesture)
        assert self.kiosk.hear("touched", 5) is not None, gesture

    # What other programs ask for

    def ask(self, message: str, *data: int, window: Window | None = None) -> None:
        """Ask the window manager for something about the kiosk's window, or about another one, or the desktop."""
        self._message(message, data, window or self.window)
        # It takes messages in their order: once it has answered this one, what it was asked for has begun.
        asking = self.root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        answer, end = self.display.intern_atom("_NET_FRAME_EXTENTS"), monotonic() + HEARD_S
        self._message("_NET_REQUEST_FRAME_EXTENTS", (), asking)
        while asking.get_full_property(answer, Xatom.CARDINAL) is None and monotonic() < end:
            sleep(0.002)
        asking.destroy()
        self.display.sync()

    def _message(self, message: str, data: Sequence[int], about: Window) -> None:
        values = [*data, *([0] * (5 - len(data)))]
        event = ClientMessage(window=about, client_type=self.display.intern_atom(message), data=(32, values))
        self.root.send_event(event, event_mask=X.SubstructureRedirectMask | X.SubstructureNotifyMask)
        self.display.sync()

    def tell(self, protocol: str) -> None:
        """Tell the kiosk's window something that usually only a window manager tells."""
        atoms = [self.display.intern_atom(protocol), X.CurrentTime, 0, 0, 0]
        wm_protocols = self.display.intern_atom("WM_PROTOCOLS")
        self.window.send_event(ClientMessage(window=self.window, client_type=wm_protocols, data=(32, atoms)))
        self.display.sync()

    def cover(self, *, state: str = "", managed: bool = True) -> None:
        """Map another program's window over the kiosk."""
        window = self._create((200, 150, 500, 400), managed=managed)
        window.set_wm_name("another program")
        if state:
            atom = self.display.intern_atom(state)
            window.change_property(self.display.intern_atom("_NET_WM_STATE"), Xatom.ATOM, 32, [atom])
        window.map()
        self.display.sync()
        self.made.append(window)

    def _create(self, place: tuple[int, int, int, int], *, managed: bool) -> Window:
        screen = self.display.screen()
        window: Window = self.root.create_window(
            *(*place, 0, screen.root_depth), override_redirect=not managed, background_pixel=screen.black_pixel
        )
        return window

    def close(self) -> None:
        """Go away."""
        self.tidy()
        self.display.close()

    def tidy(self) -> None:
        """Take away the other programs' windows."""
        for window in self.made:
            window.destroy()
        self.made.clear()
        self.display.sync()

    # What is to be seen

    def look(self) -> Standing:
        """How the kiosk stands now."""
        try:
            return Standing(
                lives=self.kiosk.lives,
                full_screen=self._place() == (0, 0, *SIZE),
                on_top=self._is_in_front() if self._is_drawn_by_another else not self._over(),
                active=self._active(),
                to_be_seen=self._is_drawn_by_another or set(self.samples()) == {PAPER},
            )
        except (XError, OSError):
            return Standing(self.kiosk.lives, *[False] * 4)

    @property
    def _is_drawn_by_another(self) -> bool:
        """In cage, stacking and drawing are its own affair; on a headless screen it shows nothing to photograph."""
        return "WAYLAND_DISPLAY" in self.kiosk.environment

    def _is_in_front(self) -> bool:
        """Whether the kiosk is the window that cage has put in front: the one that it makes active."""
        active = self.root.get_full_property(self.display.intern_atom("_NET_ACTIVE_WINDOW"), Xatom.WINDOW)
        return active is not None and list(active.value) == [self.window.id]

    def samples(self) -> list[int]:
        """Return the colours near the four corners of the whole screen, and between cards."""
        places = [(x, y) for x in (NEAR, SIZE[0] - NEAR - 1) for y in (NEAR, SIZE[1] - NEAR - 1)]
        cards = self.kiosk.begun["places"]
        places += [_between(cards[one], cards[other]) for one, other in GAPS]
        pixels = [self.root.get_image(*place, 1, 1, X.ZPixmap, 0xFFFFFFFF).data for place in places]
        return [int.from_bytes(pixel[:3], "little") for pixel in pixels]

    def answers(self, card: int) -> bool:
        """Whether a click on a card is felt."""
        self.kiosk.forget()
        self.press("left", self.kiosk.begun["places"][card])
        while (told := self.kiosk.hear("tapped", ANSWER_S)) is not None and told != {"tapped": card}:
            # An attempt may have ended in a tap of its own, such as by a space.
            pass
        return told is not None

    def wait(self, seconds: float) -> Standing:
        """Wait until the kiosk stands as it should, for no longer than this."""
        end = monotonic() + seconds
        while not (standing := self.look()).holds and monotonic() < end:
            sleep(0.02)
        return standing

    def _place(self) -> tuple[int, int, int, int] | None:
        if self.window.get_attributes().map_state != X.IsViewable:
            return None
        shape, corner = self.window.get_geometry(), self.root.translate_coords(self.window, 0, 0)
        return (corner.x, corner.y, shape.width, shape.height)

    def _over(self) -> list[int]:
        """Return the windows that lie over the kiosk's."""
        stack, ids, outermost = [], [], self.window
        # A window that comes or goes meanwhile gets another frame, or none: then neither is true any more.
        while outermost.id not in ids:
            outermost = self.window
            while (parent := outermost.query_tree().parent).id != self.root.id:
                outermost = parent
            stack = self.root.query_tree().children
            ids = [window.id for window in stack]
        above = stack[ids.index(outermost.id) + 1 :]
        return [window.id for window in above if self._seen(window)]

    def _seen(self, window: Window) -> bool:
        attributes, shape = window.get_attributes(), window.get_geometry()
        drawn = bool(attributes.map_state == X.IsViewable and attributes.win_class == X.InputOutput)
        there = QRect(shape.x, shape.y, shape.width, shape.height)
        return drawn and there.intersects(QRect(0, 0, *SIZE))

    def _active(self) -> bool:
        focus = self.display.get_input_focus().focus
        return isinstance(focus, Window) and focus.id == self.window.id


def _between(one: Sequence[int], other: Sequence[int]) -> tuple[int, int]:
    return (one[0] + other[0]) // 2, (one[1] + other[1]) // 2
