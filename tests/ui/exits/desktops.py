"""Virtual desktops to try the kiosk on: a bare X server, one with openbox as it comes or as it is shipped, and cage."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from queue import Empty, Queue
from tempfile import TemporaryDirectory
from threading import Thread
from time import monotonic, sleep
from typing import IO, Any

from Xlib import Xatom
from Xlib.display import Display

from tests.patience import limited

ROOT = Path(__file__).parents[3]
SIZE = (1280, 720)
START_S = 30
END_S = 10

SHIPPED = ROOT / "packaging" / "linux" / "openbox-kiosk" / "rc.xml"
STOCK = Path("/etc/xdg/openbox/rc.xml")

NOBODY = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
# The interpreter may lie where only root may look.
AS_NOBODY = (*NOBODY, "--inh-caps=+dac_read_search", "--ambient-caps=+dac_read_search")


class Desktop(Enum):
    """A kind of desktop, in words for the table."""

    BARE = "no window manager"
    STOCK = "openbox as it comes"
    SHIPPED = "openbox as shipped"
    CAGE = "cage"

    @property
    def missing(self) -> list[str]:
        """The programs that are not there but needed."""
        needed = {
            Desktop.BARE: ["Xvfb"],
            Desktop.STOCK: ["Xvfb", "openbox"],
            Desktop.SHIPPED: ["Xvfb", "openbox"],
            Desktop.CAGE: ["cage", "Xwayland", "setpriv"],
        }
        return [program for program in needed[self] if shutil.which(program) is None]


@dataclass
class Kiosk:
    """A kiosk on a desktop of its own, and what it tells."""

    process: subprocess.Popen[str]
    told: Queue[dict[str, Any]]
    environment: dict[str, str]
    begun: dict[str, Any] = field(default_factory=dict)

    @property
    def lives(self) -> bool:
        """Whether its process runs."""
        return self.process.poll() is None

    def forget(self) -> None:
        """Pass over what it told until now."""
        while not self.told.empty():
            self.told.get_nowait()

    def hear(self, key: str, within_s: float) -> dict[str, Any] | None:
        """Return the next thing it tells of this kind, or None if it does not in time."""
        try:
            while key not in (told := self.told.get(timeout=within_s)):
                pass
        except Empty:
            return None
        return told

    def ask(self, line: str) -> None:
        """Tell it to do something."""
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()


@contextmanager
def kiosk_on(desktop: Desktop) -> Iterator[Kiosk]:
    """Open the kiosk on a desktop of this kind, with its board on the screen."""
    with ExitStack() as started:
        folder = Path(started.enter_context(TemporaryDirectory(prefix="exits-", ignore_cleanup_errors=True)))
        if desktop is Desktop.CAGE:
            environment, before = _cage(folder)
        else:
            environment, before = started.enter_context(x_server(desktop)), ()
        command = [*before, sys.executable, "-m", "tests.ui.exits.kiosk", str(folder / "data")]
        kiosk = started.enter_context(_running(command, environment))
        begun = kiosk.hear("window", START_S)
        assert begun is not None, f"the kiosk did not open on {desktop.value}"
        kiosk.begun = begun
        kiosk.environment["DISPLAY"] = begun["display"]
        if begun["wayland"]:
            kiosk.environment["WAYLAND_DISPLAY"] = begun["wayland"]
        yield kiosk


def _cage(folder: Path) -> tuple[dict[str, str], tuple[str, ...]]:
    """Return what cage needs to run without a screen, and how it is called; it refuses to run as root."""
    runtime = folder / "runtime"
    runtime.mkdir(mode=0o700)
    environment = os.environ | {
        "XDG_RUNTIME_DIR": str(runtime),
        "HOME": str(folder),
        "WLR_BACKENDS": "headless",
        "WLR_RENDERER": "pixman",
        "WLR_LIBINPUT_NO_DEVICES": "1",
        "QT_QPA_PLATFORM": "xcb",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    if os.geteuid() != 0:
        return environment, ("cage", "--")
    for place in (folder, runtime):
        shutil.chown(place, "nobody")
    return environment, (*AS_NOBODY, "cage", "--")


@contextmanager
def x_server(desktop: Desktop) -> Iterator[dict[str, str]]:
    """Provide a virtual screen, and the window manager on it."""
    reading, writing = os.pipe()
    screen = "{}x{}x24".format(*SIZE)
    with ExitStack() as started:
        server = ["Xvfb", "-displayfd", str(writing), "-screen", "0", screen, "-nolisten", "tcp"]
        process = subprocess.Popen(server, pass_fds=(writing,), stderr=subprocess.DEVNULL)
        started.enter_context(_ended(process))
        os.close(writing)
        with os.fdopen(reading) as number, limited(process):
            environment = os.environ | {"DISPLAY": f":{number.readline().strip()}", "QT_QPA_PLATFORM": "xcb"}
        if desktop is not Desktop.BARE:
            rules = SHIPPED if desktop is Desktop.SHIPPED else STOCK
            started.enter_context(_openbox(rules, environment))
        yield environment


@contextmanager
def _openbox(rules: Path, environment: dict[str, str]) -> Iterator[None]:
    """Provide the window manager openbox with these rules, once it is at work."""
    command = ["openbox", "--config-file", str(rules)]
    process = subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL)
    with _ended(process), closing(Display(environment["DISPLAY"])) as display:
        at_work = display.intern_atom("_NET_SUPPORTING_WM_CHECK")
        root, end = display.screen().root, monotonic() + START_S
        while root.get_full_property(at_work, Xatom.WINDOW) is None and monotonic() < end:
            sleep(0.02)
        yield


@contextmanager
def _running(command: list[str], environment: dict[str, str]) -> Iterator[Kiosk]:
    process = subprocess.Popen(
        command, env=environment, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=None, text=True
    )
    assert process.stdout is not None
    told: Queue[dict[str, Any]] = Queue()
    listening = Thread(target=_listen, args=(process.stdout, told), daemon=True)
    listening.start()
    kiosk = Kiosk(process, told, dict(environment))
    with _ended(process):
        yield kiosk
        assert process.stdin is not None
        process.stdin.close()
        process.wait(END_S)
    listening.join(END_S)
    process.stdout.close()


def _listen(source: IO[str], told: Queue[dict[str, Any]]) -> None:
    for line in source:
        if line.startswith("{"):
            told.put(json.loads(line))


@contextmanager
def _ended(process: subprocess.Popen[Any]) -> Iterator[None]:
    """See that a process is gone afterwards."""
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
