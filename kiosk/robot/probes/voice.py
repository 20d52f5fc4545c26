"""Whether a language can be spoken, and how fast: its process is started, renders a sentence and plays nothing."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

from kiosk.findings import Finding

WITHIN_S = 12.0
"""The process takes half a second to start; on a machine that does much else, many times that."""

SLOW_MS = 800
"""The kiosk waits this long for a sentence to begin before it takes the engine for hung."""

_SHOWN = "sentences are only shown"


def voice(command: Sequence[str], language: str, sentence: str) -> Iterator[Finding]:
    """Have the voice's process, started by this command, render a sentence of a language."""
    what = f"voice: {language}"
    try:
        told = _run(command, {"render": sentence}, {"quit": True})
    except subprocess.TimeoutExpired:
        remedy = "start the machine again, and see that espeak-ng speaks"
        yield Finding.warning(what, f"{_SHOWN}: the speech engine hangs", remedy)
        return
    except OSError as error:
        words = f"{_SHOWN}: the voice cannot be started: {error.strerror}"
        yield Finding.warning(what, words, "install Recollect anew")
        return
    yield _told(what, language, dict(_events(told)))


def _run(command: Sequence[str], *lines: dict[str, object]) -> str:
    """What the process says to these commands; what it leaves when it has to be ended goes as well."""
    with tempfile.TemporaryDirectory(prefix="recollect-check-") as folder:
        done = subprocess.run(  # noqa: S603 - our own program
            command,
            input="".join(f"{json.dumps(line)}\n" for line in lines),
            capture_output=True,
            encoding="utf-8",
            timeout=WITHIN_S,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder),
            check=False,
        )
    return done.stdout


def _events(lines: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """What the process told, by name; what is none of its lines is left out."""
    for line in lines.splitlines():
        try:
            event = json.loads(line)
            yield str(event["event"]), event
        except (ValueError, KeyError, TypeError):
            continue


def _told(what: str, language: str, events: dict[str, dict[str, Any]]) -> Finding:
    if "unavailable" in events:
        why = events["unavailable"].get("why")
        return Finding.warning(what, f"{_SHOWN}: {why}", "install espeak-ng (Debian), then try again")
    if "ready" not in events:
        return Finding.warning(what, f"{_SHOWN}: the voice's process died", "install espeak-ng and Recollect anew")
    speaker = events["ready"].get("voice")
    if speaker is None:
        words = f"{_SHOWN}: no installed voice speaks {language!r}"
        plain, region, _ = language.partition("-")
        wider = f", or write {plain!r}, which takes any region" if region else ""
        remedy = f"install a voice for {language!r}{wider}, or take it out of the languages"
        return Finding.warning(what, words, remedy)
    if "rendered" not in events:
        why = events.get("failed", {}).get("why", "the voice's process died")
        return Finding.warning(what, f"{_SHOWN}: {why}", "install espeak-ng anew")
    took_ms = int(events["rendered"]["took_ms"])
    words = f"{events['ready'].get('spoken') or speaker} has a sentence ready in {took_ms} ms"
    if took_ms > SLOW_MS:
        return Finding.warning(what, words, "end other programs: the kiosk takes a slower voice for one that hangs")
    return Finding.good(what, words)
