"""Run benchmarks of tests/bench and write what they measured into the documentation.

``python packaging/benchmarks.py`` takes some minutes on a quiet machine with two processors; ``--sessions
5000,20000`` measures growth with other numbers of stored sessions. A time is the shortest of its rounds.

A day of visitors takes an hour and is measured by itself: ``python -m tests.bench.day --gaps 200 --speed 10 --json
day.json``, and then ``python packaging/benchmarks.py --day day.json``, which leaves the rest of the page as it is.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import psutil

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "reference" / "benchmarks.md"
SESSIONS = "100,1000"
BENCHES = tuple(
    f"tests/bench/test_{what}.py" for what in ("growth", "training", "start", "window", "store", "decision")
)
SHOWN = "not reference and not episodes"

HEAD = """# Benchmarks

This page is written by `python packaging/benchmarks.py`, which runs benchmarks and takes the shortest round of each.
Compare numbers of one run only: other programs on the machine make all of them longer.

"""
GROWTH = """
## With many stored sessions

The sessions are copies of four games that were played by a program; each has about 390 events. The factor is the time
for the larger study by that for the smaller one: 1 does not grow, and {linear:g} grows in step with the sessions.

"""
GAMES = """
## Simulated games

The memory player plays under the default table. The same 20,000 games in plain C, number for number, are the measure.
Times in one process are those of the processor, which other programs lengthen less.

"""
TABLE = """
## From nothing to the default table

`recollect train --name default` in a process of its own, with the start of Python. "First time" is with an empty cache
folder, so that the rules are compiled; a build brings them compiled, and always takes the second row's time.

"""
STARTS = """
## Starts

Each program is started in turns with a reference that does only what nothing could do without: an empty Qt Quick window
for the kiosk, and a click program that prints a word for the commands. Times are the middle ones of the rounds.

"""
TAPS = """
## Taps, records and frames

Of each, the middle time, and the time that 99 of 100 keep below. One reference is a press on a square in a bare window.
The other is a commit of the same bytes to a table without any key: both commits take turns, and the quicker quarter of
each is compared. Windows have 1920 x 1080 pixels and are drawn without a graphics card.

"""


DAY = """
## A day of visitors

Simulated visitors come one after another to one process. Some leave early, and the robot fails at random. Memory is
what the process holds after each visitor who completed the study: its slope by least squares, with the standard error.
The first visitors are left out, who are the first to need a picture or a sentence. A gap is how late a timer of the
event loop comes. Windows are drawn without a graphics card.

"""


def measured(sessions: str) -> dict[str, Any]:
    """Run the benchmarks and return what pytest-benchmark says; raises SystemExit if one fails."""
    environment = os.environ | {"RECOLLECT_BENCH_SESSIONS": sessions, "QT_QPA_PLATFORM": "offscreen"}
    with tempfile.TemporaryDirectory() as folder:
        told = Path(folder) / "told.json"
        options = ("-q", "--benchmark-only", "-k", SHOWN, "-p", "no:cacheprovider", f"--benchmark-json={told}")
        command = [sys.executable, "-m", "pytest", *options, *BENCHES]
        load, *_ = psutil.getloadavg()
        if subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode:
            raise SystemExit("a benchmark failed, so nothing was written")
        return {**json.loads(told.read_text("utf-8")), "load": load}


def page(told: dict[str, Any]) -> str:
    """Return the page."""
    machine = told["machine_info"]
    processor = machine["cpu"].get("brand_raw", machine["machine"])
    run = f"Measured on {told['datetime'][:10]}: {processor}, {os.cpu_count()} processors, "
    run += f"{platform.system()}, Python {machine['python_version']}. Load before the run: {told['load']:.1f}.\n"
    shortest = {bench["name"].removeprefix("test_"): bench["stats"]["min"] for bench in told["benchmarks"]}
    rest = starts(told["benchmarks"]) + taps({bench["name"]: bench["extra_info"] for bench in told["benchmarks"]})
    return HEAD + run + _growth(shortest) + _games(shortest) + _table(shortest) + rest


def _growth(shortest: dict[str, float]) -> str:
    times: dict[str, dict[int, float]] = {}
    for name, seconds in shortest.items():
        what, _, case = name.rstrip("]").partition("[")
        size, counted, how = case.partition(" sessions")
        if counted:
            words = what.replace("_", " ") + (f" ({how.lstrip('-')})" if how else "")
            times.setdefault(words, {})[int(size)] = seconds
    sizes = sorted({size for row in times.values() for size in row})
    head = ["what", *(f"{size:,} sessions" for size in sizes), "factor"]
    rows = [
        [what, *(in_words(row[size]) for size in sizes), f"{row[sizes[-1]] / row[sizes[0]]:.1f}"]
        for what, row in times.items()
    ]
    return GROWTH.format(linear=sizes[-1] / sizes[0]) + table(head, rows)


def _games(shortest: dict[str, float]) -> str:
    games, in_c = 20_000, shortest.get("games_in_c")
    named = {
        "plain C, -O2": (games, in_c),
        "the kernel, compiled as C": (games, shortest.get("games_of_the_kernel_without_their_results")),
        "the kernel, with results as Python has them": (games, shortest.get("games_of_the_kernel")),
        "the same in two processes": (2 * games, shortest.get("games_in_processes[2]")),
    }
    rows = [
        [what, f"{number / seconds:,.0f}", f"{number / games * in_c / seconds:.2f}" if in_c else "no C compiler"]
        for what, (number, seconds) in named.items()
        if seconds
    ]
    return GAMES + table(["what plays", "games a second", "of C"], rows)


def _table(shortest: dict[str, float]) -> str:
    before = "from_nothing_to_the_default_table["
    rows = [
        [name.removeprefix(before).rstrip("]"), in_words(seconds)]
        for name, seconds in shortest.items()
        if name.startswith(before)
    ]
    return TABLE + table(["how", "time"], rows)


def starts(benches: list[dict[str, Any]]) -> str:
    """Return the section about starts."""
    names = {
        "test_start_to_first_picture": "the kiosk, until its first picture",
        "test_start_to_ready_for_a_tap": "the kiosk, until its start screen can be tapped",
    }
    rows, tap = [], ""
    for bench in benches:
        used = bench["extra_info"]
        if bench["name"] == "test_first_tap_to_the_next_page":
            took, whole = (in_words(used[each]["ms"] / 1000) for each in ("wall", "processor"))
            tap = f"\nA tap in the first moment shows the next page after {took}, of which {whole} on the processor.\n"
        elif "processor" in used:
            what = names.get(bench["name"]) or f"`recollect {bench['param']}`"
            times = [f"{used[each]['times the reference']:.1f}" for each in ("processor", "wall")]
            spent = [in_words(used["processor"][each] / 1000) for each in ("ms", "reference ms")]
            rows.append([what, *spent, *times])
    head = ["what", "processor time", "of the reference", "times", "times on the clock"]
    return STARTS + table(head, rows) + tap


def taps(told: dict[str, dict[str, Any]]) -> str:
    """Return the section about taps, records and frames; empty if one of their benchmarks was not run."""
    named = {
        "test_tap_to_first_changed_frame": "from a tap to the first changed frame",
        "test_durable_event": "writing a tap and its flip to the disk",
        "test_decision[tom]": "a decision with its hint and reason",
        "test_decision[notom]": "the same without a reason",
        "test_frame_time_while_cards_turn": "a frame while two cards turn",
        "test_arrival_of_the_board": "from an empty table to the first picture of 24 cards",
    }
    if not named.keys() <= told.keys():
        return ""
    rows = {
        what: [in_words(told[name][f"p{part}_us"] / 1e6) for part in (50, 99)] + ["", ""]
        for name, what in named.items()
    }
    square = told["test_tap_to_first_changed_frame_of_one_square"]["p50_us"]
    frame = told["test_tap_to_first_changed_frame"]["p50_us"]
    bare = told["test_durable_event_beside_a_bare_commit"]
    rows[named["test_tap_to_first_changed_frame"]][2:] = in_words(square / 1e6), f"{frame / square:.2f}"
    rows[named["test_durable_event"]][2:] = in_words(bare["bare_p25_us"] / 1e6), f"{bare['ratio']:.2f}"
    share = told["test_cost_of_the_start_screen"]["share of one core"]
    return (
        TAPS
        + table(
            ["what", "middle", "99 of 100", "of the reference", "times"], [[what, *row] for what, row in rows.items()]
        )
        + f"\nThe start screen, which plays by itself, takes {share:.1%} of one core.\n"
    )


def day(told: dict[str, Any]) -> str:
    """Return the section about a day of visitors, of what was measured of it."""
    rows = []
    if memory := told.get("memory"):
        slope, error = memory["slope_kib"], memory["error_kib"]
        which = f"visitors {memory['first']} to {memory['last']}"
        rows += [
            [f"memory a visitor, {which}", f"{slope:+.1f} ± {error:.1f} KiB"],
            [f"open files and sockets at most, {which}", str(memory["handles"])],
        ]
    if gaps := told.get("gaps"):
        rows += [
            [
                f"99 of 100 gaps are below, {gaps['visitors']} visitors, {gaps['speed']:g} x speed",
                f"{gaps['p99_ms']:.1f} ms",
            ],
            [f"the longest of {gaps['beats']:,} gaps", f"{gaps['longest_ms']:.1f} ms"],
        ]
    if shares := told.get("shares"):
        rows += [
            ["the start screen, of one core", f"{shares['start_screen']:.1%}"],
            ["a game at rest, of one core", f"{shares['game_at_rest']:.1%}"],
        ]
    return DAY + f"Measured on {told['date']}.\n\n" + table(["what", "measured"], rows)


def divided(text: str) -> tuple[str, str]:
    """Return a page without its section about a day, and that section; empty if there is none."""
    before, heading, section = text.partition(DAY[: DAY.index("\n\n")])
    return before, heading + section


def in_words(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    return f"{seconds:.1f} s" if seconds >= 1 else f"{seconds * 1000:.3g} ms"


def table(head: list[str], rows: list[list[str]]) -> str:
    """Return a table in Markdown; all columns but the first are numbers."""
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def main() -> None:
    """Measure, and write the page; or write its section about a day from what was measured of one."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--sessions", default=SESSIONS, help="numbers of stored sessions, with commas between them")
    parser.add_argument("--day", type=Path, nargs="+", help="files that tests.bench.day has written")
    asked = parser.parse_args()
    before, section = divided(PAGE.read_text("utf-8"))
    if asked.day:
        told: dict[str, Any] = {}
        for file in asked.day:
            told |= json.loads(file.read_text("utf-8"))
        section = day(told)
    else:
        before = page(measured(asked.sessions))
    PAGE.write_text(before + section, "utf-8")


if __name__ == "__main__":
    main()
