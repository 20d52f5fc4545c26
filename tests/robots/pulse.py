"""A sound server of a test's own with a virtual loudspeaker, and a microphone before it."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tests.patience import Program, limited, serving

PROGRAMS = ("pulseaudio", "pactl", "parec")
PATIENCE_S = 10.0


def is_installed() -> bool:
    """Whether this machine has what a virtual loudspeaker takes."""
    return all(shutil.which(name) for name in PROGRAMS)


def _program(name: str) -> str:
    return shutil.which(name) or name


class PulseServer:
    """PulseAudio with one null sink, reached over a socket in ``folder``; it can be ended and started again."""

    def __init__(self, folder: Path) -> None:
        self._socket = folder / "pulse.sock"
        self.environment = os.environ | {
            "PULSE_SERVER": f"unix:{self._socket}",
            "PULSE_RUNTIME_PATH": str(folder),
            "XDG_RUNTIME_DIR": str(folder),
            "HOME": str(folder),
        }
        self._server: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it, and wait until it answers."""
        self._server = self._launched()
        deadline = time.monotonic() + PATIENCE_S
        while self.control("info").returncode != 0:
            assert time.monotonic() < deadline, "the sound server does not answer"
            # It ends if it finds somebody at its socket, as a player that looks for the device may be.
            if self._server.poll() is not None:
                self._server = self._launched()

    def _launched(self) -> subprocess.Popen[bytes]:
        self._socket.unlink(missing_ok=True)
        # Without norewinds it may take two seconds of sound ahead, and then none for as long.
        modules = (
            "module-null-sink sink_name=booth rate=48000 norewinds=1",
            f"module-native-protocol-unix socket={self._socket}",
        )
        command = [_program("pulseaudio"), "-n", "--exit-idle-time=-1", "--daemonize=no", "--use-pid-file=no"]
        return subprocess.Popen(
            [*command, *(part for module in modules for part in ("-L", module))],
            env=self.environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def stop(self) -> None:
        """End it, as when a loudspeaker is pulled out."""
        if self._server is not None:
            self._server.kill()
            self._server.wait(PATIENCE_S)

    def control(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run ``pactl``."""
        return subprocess.run(
            [_program("pactl"), *arguments],
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )

    @contextmanager
    def microphone(self) -> Iterator[Program]:
        """Provide what the loudspeaker is given, as 16 bit mono at 48 kHz, while it is given."""
        command = [
            shutil.which("parec") or "",
            "-d",
            "booth.monitor",
            "--format=s16le",
            "--rate=48000",
            "--channels=1",
            "--latency-msec=2",
        ]
        with serving(command, env=self.environment, stdout=subprocess.PIPE) as recorder:
            yield recorder


def heard(recorder: Program, count: int) -> NDArray[np.int16]:
    """Return the next samples of a microphone."""
    with limited(recorder):
        return np.frombuffer(recorder.stdout.read(2 * count), dtype="<i2")
