"""What a terminal cannot print, or a closed pipe, never ends a command with a traceback."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from io import BytesIO, StringIO, TextIOWrapper
from pathlib import Path

import pytest
from rich.table import Table
from rich.text import Text

from kiosk import DISK_FULL, UserInputError, cli, program
from kiosk.cli.main import main, recollect
from kiosk.cli.terminal import console, counted, harmless, one_line, tell_caution
from kiosk.experiment.events import RobotDisconnected, SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.day_report import DayReport
from kiosk.store.recorder import Provenance, Recorder
from tests.patience import PATIENCE_S
from tests.samples import plan

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="pipes and devices as Unix has them")

TITLE = "Ein Gedächtnisspiel — 記憶"
ENCODINGS = ("ascii", "cp1252")
PATHS = (
    r"\{(out|file|folder|place|data|path|shots|sheet|picture|plan|local|DATA|REHEARSALS|\w+\.(file|folder|path))\b[^.]"
)
"""Names in the sources of the commands that stand for paths, inside an f-string."""


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a session."""
    folder = tmp_path_factory.mktemp("data")
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)])
    return folder


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study with a title that few terminals can print."""
    file = tmp_path_factory.mktemp("study") / "gedächtnis.toml"
    file.write_text(f'title = "{TITLE}"\n', encoding="utf-8")
    return file


def command(name: str, data: Path, study: Path) -> tuple[str, ...]:
    """Return a command that prints something."""
    return {
        "sessions": program("sessions", "--data", str(data)),
        "events": program("events", "1", "--data", str(data), "--json"),
        "study check": program("study", "check", str(study)),
        "study check --json": program("study", "check", str(study), "--json"),
        "help": program("--help"),
        "a refusal": program("study", "check", str(study.with_name("fehlt-記憶.toml"))),
    }[name]


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", ["study check", "study check --json", "a refusal"])
def test_what_the_terminal_has_no_character_for_is_printed_all_the_same(
    name: str, encoding: str, data: Path, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, err = (TextIOWrapper(BytesIO(), encoding) for _ in "oe")
    monkeypatch.setattr(sys, "argv", ["recollect", *command(name, data, study)[len(program()) :]])
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    with pytest.raises(SystemExit) as ended:
        main()
    out.flush()
    err.flush()
    assert (ended.value.code or 0) == (2 if name == "a refusal" else 0)
    said = (err if name == "a refusal" else out).buffer
    assert isinstance(said, BytesIO)
    assert said.getvalue()
    if name == "study check --json":
        assert json.loads(said.getvalue())["title"] == TITLE


def test_a_refusal_is_printed_where_the_system_has_no_characters_but_ascii(data: Path, study: Path) -> None:
    environment = os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0", "LC_ALL": "C"}
    done = subprocess.run(
        command("a refusal", data, study), env=environment, capture_output=True, check=False, timeout=PATIENCE_S
    )
    assert (done.returncode, b"Traceback" in done.stderr) == (2, False)


@pytest.mark.parametrize("name", ["sessions", "events", "help"])
def test_a_reader_who_goes_away_leaves_no_traceback(name: str, data: Path, study: Path) -> None:
    reads, writes = os.pipe()
    os.close(reads)
    done = subprocess.run(
        command(name, data, study), stdout=writes, stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE_S
    )
    os.close(writes)
    assert done.stderr == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
@pytest.mark.parametrize("name", ["sessions", "events", "help"])
def test_output_that_finds_no_room_ends_in_a_sentence(name: str, data: Path, study: Path) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            command(name, data, study), stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE_S
        )
    assert done.returncode == 1
    assert done.stderr == f"recollect: {DISK_FULL}\n"


STEERING = "\x1b[2J\x07\x9b31m\u202e\u2066\r\u2028"
AS_NUMBERS = r"\x1b[2J\x07\x9b31m\u202e\u2066\r\u2028"


def test_one_thing_has_no_plural() -> None:
    assert [counted(number, "session") for number in (0, 1, 1200)] == ["0 sessions", "1 session", "1,200 sessions"]


def test_what_would_steer_a_terminal_is_printed_by_its_number_and_all_else_as_it_is() -> None:
    assert harmless(f"a{STEERING}z") == f"a{AS_NUMBERS}z"
    kept = "tabs\tand lines\n, no-break\N{NO-BREAK SPACE}space, \N{ZERO WIDTH JOINER}, \N{SOFT HYPHEN}, مرحبا, 👩‍👧"
    assert harmless(kept) == kept
    assert one_line("a\nb\u2028c\x85d\x1b") == r"a b c d\x1b"


@pytest.mark.parametrize("file", sorted(Path(cli.__file__).parent.glob("*.py")), ids=lambda file: file.stem)
def test_a_path_is_printed_on_one_line_whatever_its_name_holds(file: Path) -> None:
    echoed = re.findall(r"click\.echo\((?:[^()]|\([^()]*\))*\)", file.read_text(encoding="utf-8"))
    assert [line for line in echoed if re.search(PATHS, line)] == []


def test_a_text_in_a_table_is_no_markup_no_emoji_and_does_not_steer_the_terminal() -> None:
    drawn = console(least_width=200)
    table = Table(title=STEERING)
    table.add_row(f"[/x] [bold]a[/bold] :smile: {STEERING}", Text(STEERING, "bold"))
    drawn.file = out = StringIO()
    drawn.print(table)
    assert r"[/x] [bold]a[/bold] :smile: \x1b[2J" in out.getvalue()
    assert not set(out.getvalue()) & {character for character in STEERING if not character.isprintable()}


@pytest.mark.parametrize("beside", ["", "conditions = 1\n"])
def test_nothing_that_a_command_prints_of_a_study_steers_the_terminal(
    beside: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "[bold]\u202e.toml"
    file.write_text(f'title = "[/x] \u202e\u2066"\n{beside}', encoding="utf-8")
    out, err = (TextIOWrapper(BytesIO(), "utf-8") for _ in "oe")
    monkeypatch.setattr(sys, "argv", ["recollect", "study", "check", str(file)])
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    with pytest.raises(SystemExit) as ended:
        main()
    assert (ended.value.code or 0) == (2 if beside else 0)
    said = ""
    for stream in (out, err):
        stream.flush()
        assert isinstance(stream.buffer, BytesIO)
        said += stream.buffer.getvalue().decode()
    assert not set(said) & {"\u202e", "\u2066"}
    assert (r"[bold]\u202e.toml" if beside else r"[/x] \u202e\u2066") in said


FORGED = "one\ncaution: two\x85three\u2028four\x1b[2J"


def test_a_caution_stays_on_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    tell_caution(FORGED)
    tell_caution(UserInputError(FORGED), err=True)
    told = "caution: one caution: two three four\\x1b[2J\n"
    assert capsys.readouterr() == (told, told)


def test_a_line_of_events_sessions_and_the_day_holds_whatever_the_record_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with Recorder(tmp_path) as recorder:
        provenance = Provenance(plan(), 1, f"robot:{FORGED}", "abc123", kind=SessionKind.SIMULATED)
        recorder.begin(provenance, [SessionStarted(at_ms=0), RobotDisconnected(at_ms=1, why=FORGED)])
    monkeypatch.setattr(DayReport, "cautions", lambda _: [FORGED])
    for command in (["sessions"], ["events", "1"], ["day", "--with-rehearsals"]):
        recollect.main([*command, "--data", str(tmp_path)], standalone_mode=False)
        printed = "".join(capsys.readouterr())
        assert "three" in printed
        assert not [line for line in printed.splitlines() if line.startswith(("caution: two", "three"))]


def test_a_path_that_is_no_text_is_told_all_the_same(tmp_path: Path) -> None:
    strange = os.fsencode(tmp_path) + b"/\xe9"
    done = subprocess.run(
        [*map(os.fsencode, program("sessions", "--data")), strange],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert (done.returncode, done.stderr) == (2, f"recollect: there is no database in {tmp_path}/\\udce9\n")
