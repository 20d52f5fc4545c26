"""Asking a process of our own that looks at the display: whatever becomes of it, there is an answer in words."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict

from kiosk.findings import Finding, State


def ask(what: str, command: Sequence[str], within_s: float, remedy: str) -> Iterator[Finding]:
    """What the process of this command found; ``remedy`` is for when it comes to nothing."""
    try:
        done = subprocess.run(  # noqa: S603 - our own program
            command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=within_s, check=False
        )
    except subprocess.TimeoutExpired:
        yield Finding.bad(what, f"no answer within {within_s:g} s", remedy)
        return
    if done.returncode == 0:
        yield from from_json(done.stdout)
        return
    yield Finding.bad(what, _said(done.stderr) or f"it ended with {done.returncode}", remedy)


def _said(stderr: str) -> str:
    """The line that tells most: the first, for others follow from it; but the last of what a fault of ours leaves."""
    lines = [line.strip() for line in stderr.splitlines() if line.strip()]
    if not lines:
        return ""
    return lines[-1] if lines[0].startswith("Traceback ") else lines[0]


def to_json(findings: Iterable[Finding]) -> str:
    """Findings as the process prints them."""
    return json.dumps([asdict(each) | {"state": each.state.value} for each in findings])


def from_json(text: str) -> Iterator[Finding]:
    """What ``to_json`` wrote."""
    return (Finding(**each | {"state": State(each["state"])}) for each in json.loads(text))
