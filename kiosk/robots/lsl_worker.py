"""The marker worker: a process that sends what happens in a session to a Lab Streaming Layer network.

A lab's recorder puts these markers beside gaze or EEG. The worker is a process of its own, so that the network's
threads and faults never touch the kiosk.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from typing import Any, TextIO

from kiosk.preflight import CheckResult

STREAM_TYPE = "Markers"
"""The type by which recorders find streams of events."""

LIBRARY = "pylsl"
CHECK = "markers"
_REMEDY = 'pip install "recollect[lsl]", or put lsl = false under [markers] of the study file'


def lsl_check(name: str) -> Iterator[CheckResult]:
    """Look for the library that sends a stream of this name."""
    if find_spec(LIBRARY) is None:
        yield CheckResult.error(CHECK, f"the library {LIBRARY} is not installed", _REMEDY)
        return
    yield CheckResult.ok(CHECK, f"the stream {name!r} of the type {STREAM_TYPE!r} will be sent on this network")


def run_lsl_worker(name: str, source: str, lines: TextIO = sys.stdin) -> None:
    """Send a marker for every line until the lines end.

    A line is a JSON object with ``happened``, the moment in s on the machine's monotonic clock, and the fields of the
    marker. Raises ImportError without the library.
    """
    # Only this process needs it; it starts threads and looks at the network when it is loaded.
    import pylsl  # noqa: PLC0415

    info = pylsl.StreamInfo(name, STREAM_TYPE, 1, pylsl.IRREGULAR_RATE, pylsl.cf_string, source)
    info.desc().append_child_value("manufacturer", "Recollect")
    outlet = pylsl.StreamOutlet(info)
    # Both clocks count alike but may begin at different moments; the difference is fixed while the machine runs.
    offset_s = pylsl.local_clock() - time.monotonic()
    for marker, happened_s in _markers(lines):
        outlet.push_sample([marker], happened_s + offset_s)


def _markers(lines: Iterable[str]) -> Iterator[tuple[str, float]]:
    """Yield each line's marker and moment; a line that the kiosk cannot have written is left out."""
    for line in lines:
        try:
            fields: dict[str, Any] = json.loads(line)
            happened_s = float(fields.pop("happened"))
        except (ValueError, KeyError, TypeError, AttributeError):
            continue
        yield json.dumps(fields), happened_s
