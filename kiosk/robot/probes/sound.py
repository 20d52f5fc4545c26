"""Whether there is something that plays, and somewhere to play it: a tenth of a second of silence."""

from __future__ import annotations

import subprocess
import tempfile
import wave
from collections.abc import Iterator
from pathlib import Path

from kiosk.findings import Finding

WHAT = "sound"

_RATE, _SILENCE_S = 22_050, 0.1
_WITHIN_S = 3.0
_UNHEARD = "sentences are shown, and nothing is heard"


def sound(command: tuple[str, ...] | None, *, busy: bool) -> Iterator[Finding]:
    """Play silence with a player's command; not while a kiosk is ``busy``, which may need the card itself."""
    if command is None:
        yield Finding.warning(
            WHAT, f"{_UNHEARD}: there is no program that plays sound", "install alsa-utils (Debian), for aplay"
        )
    elif busy:
        yield Finding.good(WHAT, f"{Path(command[0]).name} plays; not tried while a kiosk is open here")
    else:
        yield _played(command)


def _played(command: tuple[str, ...]) -> Finding:
    with tempfile.TemporaryDirectory(prefix="recollect-check-") as folder:
        file = Path(folder) / "silence.wav"
        _write_silence(file)
        try:
            done = subprocess.run(  # noqa: S603 - the player's own command
                (*command, str(file)), stdin=subprocess.DEVNULL, capture_output=True, timeout=_WITHIN_S, check=False
            )
        except subprocess.TimeoutExpired:
            return _fails(f"{Path(command[0]).name} does not come to an end")
        except OSError as error:
            return _fails(f"{command[0]} cannot be started: {error.strerror}")
    if done.returncode == 0:
        return Finding.good(WHAT, f"{Path(command[0]).name} plays on the sound card")
    said = done.stderr.decode(errors="replace").strip().splitlines()
    return _fails(said[-1] if said else f"the player ended with {done.returncode}")


def _fails(why: str) -> Finding:
    return Finding.warning(
        WHAT, f"{_UNHEARD}: {why}", "plug in a loudspeaker, choose it in the system's settings, and play it any sound"
    )


def _write_silence(file: Path) -> None:
    with wave.open(str(file), "wb") as silence:
        silence.setnchannels(1)
        silence.setsampwidth(2)
        silence.setframerate(_RATE)
        silence.writeframes(bytes(2 * int(_RATE * _SILENCE_S)))
