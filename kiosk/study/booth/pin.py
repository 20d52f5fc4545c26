"""The experimenter's PIN: how it is kept, how it is compared, and how long a wrong one makes everybody wait."""

from __future__ import annotations

import hashlib
import hmac
import re
from dataclasses import dataclass

from kiosk import BadInput

LEAST, MOST = 4, 12
"""How many digits a PIN has."""

SALT_BYTES = 16
LONGEST_WAIT_MS = 60_000
_FIRST_WAIT_MS = 1_000
_COST, _BLOCK, _LANES = 2**14, 8, 1
"""What scrypt is made to cost: about 50 ms and 16 MB for each try."""

_KEY_BYTES = 32
_PIN = re.compile(rf"[0-9]{{{LEAST},{MOST}}}", re.ASCII)


def kept(pin: str, salt: bytes) -> str:
    """A PIN as the study file keeps it; raises BadInput if it is none. ``salt`` is 16 bytes of chance."""
    if not _PIN.fullmatch(pin):
        raise BadInput(f"a PIN has {LEAST} to {MOST} digits and nothing else")
    return f"scrypt:{salt.hex()}:{_key(pin, salt).hex()}"


def matches(pin: str, line: str) -> bool:
    """Whether this is the PIN that the study file keeps; takes about 50 ms, as long for a wrong one as for a right."""
    _, salt, key = line.split(":")
    return hmac.compare_digest(_key(pin, bytes.fromhex(salt)), bytes.fromhex(key))


@dataclass(frozen=True)
class Wrong:
    """How many wrong PINs there were in a row, and when the last one came, in ms since 1970."""

    times: int = 0
    last_ms: int = 0

    @property
    def wait_ms(self) -> int:
        """How long the last one makes everybody wait, in ms."""
        if not self.times:
            return 0
        # A power with a limit: the records may hold any number of them.
        return min(LONGEST_WAIT_MS, _FIRST_WAIT_MS << min(self.times - 1, LONGEST_WAIT_MS.bit_length()))

    def left_ms(self, now_ms: int) -> int:
        """How long that still is; a clock that was set back makes nobody wait longer than from now."""
        return min(self.wait_ms, max(0, self.last_ms + self.wait_ms - now_ms))


def _key(pin: str, salt: bytes) -> bytes:
    return hashlib.scrypt(pin.encode(), salt=salt, n=_COST, r=_BLOCK, p=_LANES, dklen=_KEY_BYTES)
