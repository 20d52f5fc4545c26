"""Finds out whether Qt can open a window here, and on which screens, and prepares Qt before there is one.

Where no window can be opened, Qt itself would end the process with an abort. Finding that out imports nothing of Qt;
the functions that need Qt import it themselves.
"""

from __future__ import annotations

import builtins
import ctypes
import os
import re
import sys
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from kiosk.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from PySide6.QtGui import QScreen

HEADLESS = "'recollect rehearse --headless' and 'recollect replay N --headless' need none"

_PACKAGES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libfontconfig.so.1": "libfontconfig1",
    "libfreetype.so.6": "libfreetype6",
    "libglib-2.0.so.0": "libglib2.0-0",
    "libgthread-2.0.so.0": "libglib2.0-0",
    "libwayland-client.so.0": "libwayland-client0",
    "libwayland-cursor.so.0": "libwayland-cursor0",
    "libwayland-egl.so.1": "libwayland-egl1",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libX11-xcb.so.1": "libx11-xcb1",
    "libX11.so.6": "libx11-6",
    "libxcb.so.1": "libxcb1",
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-glx.so.0": "libxcb-glx0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-image.so.0": "libxcb-image0",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-randr.so.0": "libxcb-randr0",
    "libxcb-render.so.0": "libxcb-render0",
    "libxcb-render-util.so.0": "libxcb-render-util0",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxcb-shm.so.0": "libxcb-shm0",
    "libxcb-sync.so.1": "libxcb-sync1",
    "libxcb-xfixes.so.0": "libxcb-xfixes0",
    "libxcb-xkb.so.1": "libxcb-xkb1",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
}
"""The packages of Debian and Ubuntu that hold the libraries of the system that Qt needs."""

_PROGRAM = False
"""For ``of_the_screen``."""
_X11 = ("libxcb", "libX11", "libxkbcommon-x11")
_PYTHONS_OWN = "__orig_import__"
"""Where PySide keeps Python's ``import``, which it replaces."""
_MISSING = re.compile(r"(?P<library>lib[\w.+-]+\.so[.\d]*): cannot open shared object file")


@dataclass(frozen=True)
class Obstacle:
    """Why no window can be opened, and what to do about it."""

    words: str
    remedy: str
    of_the_screen: bool = True
    """Whether the screen is to blame; otherwise it is the program, or what the system lacks."""

    def __str__(self) -> str:
        """Both, as one sentence."""
        return f"{self.words}; {self.remedy}"


def draw_in_software() -> None:
    """Have Qt draw in software and on one thread; call it before the application object is made.

    Qt gives every fill of a hundred lines or more to a pool of threads, and the interface waits for each of them. That
    gains nothing with a picture of this size, and beside other programs the wait can be longer than a frame.
    """
    os.environ.setdefault("QT_QUICK_BACKEND", "software")
    os.environ.setdefault("QSG_RENDER_LOOP", "basic")
    os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")


def remove_import_hook() -> None:
    """Let ``import`` do again what it does without PySide; it may be called more than once.

    PySide replaces Python's ``import`` to offer ``from __future__ import snake_case``. To find out which modules may
    ask for that, its hook reads the source of each module that is imported, 280 files at the start of a kiosk. No
    module here uses such a feature.
    """
    import PySide6.QtCore  # noqa: F401, PLC0415 - it installs the hook

    builtins.__import__ = getattr(builtins, _PYTHONS_OWN, builtins.__import__)


def numbered_screens() -> list[QScreen]:
    """Return the screens as a study file counts them: the primary one first, the others in the system's order."""
    from PySide6.QtGui import QGuiApplication  # noqa: PLC0415 - it is loaded once there is an application

    primary = QGuiApplication.primaryScreen()
    return [primary, *(screen for screen in QGuiApplication.screens() if screen is not primary)]


def obstacle(environment: Mapping[str, str] = os.environ) -> Obstacle | None:
    """Return what keeps Qt from opening a window, or None if one of its platforms would do."""
    if not sys.platform.startswith("linux"):
        return None
    names = tuple(_platforms(environment))
    if not names:
        return Obstacle("there is no screen here", HEADLESS)
    found = [_in_the_way(name, environment) for name in names]
    return None if None in found else found[0]


def missing_library(error: Exception) -> Obstacle | None:
    """Return what to install, if this is how a library that lacks one of the system's is refused."""
    told = _MISSING.search(str(error))
    return None if told is None else _install(told["library"])


def _platforms(environment: Mapping[str, str]) -> Iterator[str]:
    """Yield the platforms that Qt tries, by name."""
    asked = environment.get("QT_QPA_PLATFORM", "")
    if asked:
        yield from (name.partition(":")[0].lower() for name in asked.split(";") if name)
        return
    for name, variable in (("xcb", "DISPLAY"), ("wayland", "WAYLAND_DISPLAY")):
        if environment.get(variable):
            yield name


def _in_the_way(platform: str, environment: Mapping[str, str]) -> Obstacle | None:
    return _plugin_fails(platform, environment) or _display_fails(platform, environment)


def _plugin_fails(platform: str, environment: Mapping[str, str]) -> Obstacle | None:
    """Load the platform's plugin as Qt will, which needs libraries that Qt does not bring along."""
    spec = find_spec("PySide6")
    places = (spec.submodule_search_locations or ()) if spec else ()
    plugins = [file for place in places for file in Path(place, "Qt", "plugins", "platforms").glob("libq*.so")]
    if not plugins or {"QT_PLUGIN_PATH", "QT_QPA_PLATFORM_PLUGIN_PATH"} & environment.keys():
        # Qt knows other plugins, of which nothing can be told.
        return None
    by_name = {file.stem.removeprefix("libq"): file for file in plugins}
    plugin = by_name.get(platform) or by_name.get(platform.partition("-")[0])
    if plugin is None:
        words = f"Qt has no platform {platform!r}, which QT_QPA_PLATFORM names"
        return Obstacle(words, f"unset it, or choose from {', '.join(sorted(by_name))}", _PROGRAM)
    try:
        ctypes.CDLL(str(plugin))
    except OSError as error:
        failed = Obstacle(f"Qt's platform {platform!r} cannot be loaded: {error}", _ANEW, _PROGRAM)
        return missing_library(error) or failed
    return None


_ANEW = "install Recollect anew, with the system's packages that packaging/README.md names"


def _install(library: str) -> Obstacle:
    """Say which packages hold a missing library, and what else is missing beside it."""
    missing = [library]
    if library.startswith(_X11):
        # The linker names one at a time, which would send people for one package after another.
        missing += [each for each in _PACKAGES if each.startswith(_X11) and each != library and _library(each) is None]
    words = f"the library {missing[0]} is missing, without which no window can be opened"
    if len(missing) > 1:
        words = f"the libraries {', '.join(missing)} are missing, without which no window can be opened"
    packages = [_PACKAGES[each] for each in missing if each in _PACKAGES]
    if not packages:
        return Obstacle(words, "install the package of the system that holds it", _PROGRAM)
    wanted = f"sudo apt-get install {' '.join(packages)}"
    return Obstacle(words, f"on Debian and Ubuntu, install what holds it with: {wanted}", _PROGRAM)


def _display_fails(platform: str, environment: Mapping[str, str]) -> Obstacle | None:
    """Connect to the display as Qt will."""
    if platform == "xcb":
        name = environment.get("DISPLAY", "")
        if not name:
            return Obstacle("DISPLAY names no screen", HEADLESS)
        return None if _x_server_answers(name) else _unreachable(name, "DISPLAY")
    if platform.startswith("wayland"):
        name = environment.get("WAYLAND_DISPLAY", "wayland-0")
        return None if _compositor_answers(name) else _unreachable(name, "WAYLAND_DISPLAY")
    return None


def _unreachable(name: str, variable: str) -> Obstacle:
    return Obstacle(
        f"the screen {name}, which {variable} names, cannot be reached",
        f"run this in the session that has the screen, as the user who owns it; {HEADLESS}",
    )


def _x_server_answers(name: str) -> bool:
    """Tell whether an X server lets this user in."""
    xcb = _library("libxcb.so.1")
    if xcb is None:
        return True
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(os.fsencode(name), None))
    failed: int = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return not failed


def _compositor_answers(name: str) -> bool:
    """Tell whether a Wayland compositor takes a connection."""
    wayland = _library("libwayland-client.so.0")
    if wayland is None:
        return True
    wayland.wl_display_connect.restype = ctypes.c_void_p
    display: int | None = wayland.wl_display_connect(os.fsencode(name))
    if display is None:
        return False
    wayland.wl_display_disconnect(ctypes.c_void_p(display))
    return True


def _library(name: str) -> ctypes.CDLL | None:
    """Load a library that Qt's platform is linked with; without it Qt has its own way to the screen."""
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None
