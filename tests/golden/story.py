"""The golden story: one session, rehearsed without a screen from the command line, event by event.

``python -m tests.golden.story`` tells it anew, for a change that is meant to change it; read the difference before you
commit it.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

FILE = Path(__file__).with_name("story.jsonl")
SEED = 2


def recollect(*arguments: str) -> str:
    """Return what the command prints; it must end well and without a word on standard error."""
    command = [sys.executable, "-m", "kiosk", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    if done.returncode != 0 or done.stderr:
        raise RuntimeError(f"{' '.join(arguments)} ended with {done.returncode} and said: {done.stderr}")
    return done.stdout


def told(recollect: Callable[..., str] = recollect) -> str:
    """Return the story as it goes today, one event a line; ``recollect`` runs the command."""
    with TemporaryDirectory() as data:
        recollect("rehearse", "--headless", "--seed", str(SEED), "--data", data, "--json")
        events = json.loads(recollect("events", "1", "--data", data, "--json"))
    return "".join(json.dumps(event, ensure_ascii=False) + "\n" for event in events)


if __name__ == "__main__":
    FILE.write_text(told(), "utf-8")
