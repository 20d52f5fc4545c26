"""What only the X server can do: show a window on every desktop, lower others, stay lit.

Law: once connected, nothing here raises; another program's window that is gone when it is asked about is no failure.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRect
from Xlib import X, Xatom
from Xlib.display import Display
from Xlib.error import CatchError, DisplayError, XError
from Xlib.protocol.event import ClientMessage
from Xlib.protocol.request import GetProperty
from Xlib.xobject.drawable import Window

EVERY_DESKTOP = 0xFFFFFFFF
AS_A_PAGER = 2
"""Says to a window manager that a person wants it."""
MESSAGE_VALUES = 5


class XServer:
    """The X server behind one window, on a connection of its own."""

    def __init__(self, window: int) -> None:
        """``window`` is the window's number at the server. Raises OSError if it cannot be reached."""
        self._display = _connect()
        # What is refused concerns other programs' windows; python-xlib would write it to the terminal.
        self._display.set_error_handler(lambda *_: None)
        self._root = self._display.screen().root
        self._window = self._display.create_resource_object("window", window)

    def show_on_every_desktop(self) -> None:
        """Show the window on every desktop.

        It is said to the window manager for now, and on the window for the next time.
        """
        desktop = self._display.intern_atom("_NET_WM_DESKTOP")
        self._window.change_property(desktop, Xatom.CARDINAL, 32, [EVERY_DESKTOP])
        self._ask("_NET_WM_DESKTOP", EVERY_DESKTOP, AS_A_PAGER)

    def activate(self) -> None:
        """Ask the window manager as a window switcher does, which is never refused; then take it."""
        self._ask("_NET_ACTIVE_WINDOW", AS_A_PAGER, X.CurrentTime)
        self._focus()

    def _focus(self) -> None:
        self._window.set_input_focus(X.RevertToParent, X.CurrentTime, onerror=CatchError())
        self._display.flush()

    def _focused(self) -> int:
        """Return the number of the window that keys are for.

        Qt cannot tell as long as it takes them all anyway.
        """
        focus = self._display.get_input_focus().focus
        return int(focus.id) if isinstance(focus, Window) else X.NONE

    def _ask(self, what: str, *values: int) -> None:
        data = [*values, *[0] * (MESSAGE_VALUES - len(values))]
        asked = ClientMessage(window=self._window, client_type=self._display.intern_atom(what), data=(32, data))
        self._root.send_event(asked, event_mask=X.SubstructureRedirectMask | X.SubstructureNotifyMask)
        self._display.flush()

    def clear(self) -> bool:
        """Lower every window that lies over ours; whether there was one, or another one had the keyboard."""
        over = self._over()
        for window in over:
            window.configure(stack_mode=X.Below, onerror=CatchError())
        self._display.flush()
        return bool(over) or self._focused() != self._window.id

    def close(self) -> None:
        """Let go of the connection."""
        self._display.close()

    def _over(self) -> list[Window]:
        try:
            return [window for window in self._above() if self._covers(window)]
        except XError:
            return []

    def _above(self) -> list[Window]:
        """Return the windows above ours, as the server stacks them."""
        ours = self._window
        while (parent := ours.query_tree().parent) and parent.id != self._root.id:
            ours = parent
        stacked: list[Window] = self._root.query_tree().children
        below = next((place for place, window in enumerate(stacked) if window.id == ours.id), len(stacked))
        return stacked[below + 1 :]

    def _covers(self, window: Window) -> bool:
        """Whether a window can be seen and takes some of our place."""
        try:
            seen = window.get_attributes()
            if seen.map_state != X.IsViewable or seen.win_class != X.InputOutput:
                return False
            theirs, ours = window.get_geometry(), self._window.get_geometry()
            place = self._root.translate_coords(self._window, 0, 0)
        except XError:
            return False
        return QRect(place.x, place.y, ours.width, ours.height).intersects(
            QRect(theirs.x, theirs.y, theirs.width, theirs.height)
        )


class XWayland(XServer):
    """An X server whose windows a Wayland compositor stacks and activates as it likes.

    What can be done is to come as a new window; so one that lies over ours is not lowered, but told of until then.
    """

    def __init__(self, window: int) -> None:
        """As with any X server."""
        super().__init__(window)
        self._below: set[int] = set()
        self._covered = False

    def show_on_every_desktop(self) -> None:
        """Start anew with a new window, which nothing covers yet."""
        self._below = {window.id for window in self._over()}
        self._covered = False

    def activate(self) -> None:
        """Do nothing: the compositor would refuse, and we would only seem to be active."""

    def clear(self) -> bool:
        """Whether a window has come over ours since it was new, or was made the active one."""
        over, focused = {window.id for window in self._over()}, self._focused()
        no_window = {X.NONE, self._root.id}
        others = {self._active(), focused} - no_window - {self._window.id}
        self._covered = self._covered or bool(over - self._below) or bool(others)
        if focused in no_window:
            self._focus()
        return self._covered

    def _active(self) -> int:
        """Return the number of the window that the compositor has made the active one."""
        active = self._root.get_full_property(self._display.intern_atom("_NET_ACTIVE_WINDOW"), Xatom.WINDOW)
        return int(active.value[0]) if active is not None and active.value else X.NONE


def keep_lit() -> Callable[[], None]:
    """Switch the server's screen saver and power saving off; the answer sets both as they were.

    Raises OSError if the server cannot be reached.
    """
    display = _connect()
    saver = display.get_screen_saver()
    display.set_screen_saver(0, 0, X.DefaultBlanking, X.DefaultExposures)
    saves_power = display.has_extension("DPMS") and bool(display.dpms_info().state)
    if saves_power:
        display.dpms_disable()
    display.sync()

    def restore() -> None:
        display.set_screen_saver(saver.timeout, saver.interval, saver.prefer_blanking, saver.allow_exposures)
        if saves_power:
            display.dpms_enable()
        display.sync()
        display.close()

    return restore


def _connect() -> Display:
    try:
        return Display()
    except DisplayError as error:
        raise OSError(str(error)) from error


def window_manager() -> str:
    """Return the name of the window manager; empty if there is none. Raises OSError if the server cannot be reached."""
    display = _connect()
    try:
        manager = _property(display, display.screen().root, "_NET_SUPPORTING_WM_CHECK")
        if manager is None:
            return ""
        name = _property(display, display.create_resource_object("window", manager.value[0]), "_NET_WM_NAME")
        return "one without a name" if name is None else bytes(name.value).decode(errors="replace")
    except XError:
        # It was here, and went.
        return ""
    finally:
        display.close()


def _property(display: Display, window: Window, name: str) -> GetProperty | None:
    return window.get_full_property(display.intern_atom(name), X.AnyPropertyType)
