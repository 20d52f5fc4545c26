"""A kiosk that dies or hangs is replaced soon, unless it was left on purpose; nothing of it stays."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import monotonic

import pytest

from kiosk.sd_notify import NotifySocketListener
from kiosk.supervisor import LEFT, REFUSED, Supervisor, SupervisorEvent, SupervisorEventKind, Timeouts
from tests.patience import PATIENCE_S

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the actors know Unix only")

LONGEST_PAUSE = 0.01
PATIENCE = Timeouts(silence=0.5, start=5, end=0.3, splash=5, young=0, longest_pause=LONGEST_PAUSE, tick=0.02)
HASTE = Timeouts(silence=0.5, start=0.5, end=0.3, splash=5, young=0, longest_pause=LONGEST_PAUSE, tick=0.02)

Listening = Callable[[Supervisor, SupervisorEvent], None]


@dataclass
class Night:
    """A supervisor's work from its beginning to its end."""

    folder: Path
    code: int = -1
    told: list[SupervisorEvent] = field(default_factory=list)

    def what(self) -> list[str]:
        """Return what happened in turn, but for the screens."""
        return [one.what.value for one in self.told if one.what is not SupervisorEventKind.SHOWS]

    def details(self, what: SupervisorEventKind) -> list[str]:
        """How it happened each time."""
        return [one.detail for one in self.told if one.what is what]

    def starts(self, of: str) -> list[int]:
        """Return the processes of the kiosk or of the calm window, in turn."""
        places = sorted((self.folder / of).glob("start-*"))
        return [int(place.read_text()) for place in places]


def runs(process: int) -> bool:
    """Whether there is such a process, and not only its remains."""
    status = Path(f"/proc/{process}/stat")
    return status.exists() and status.read_text().rpartition(")")[2].split()[0] != "Z"


def actor(folder: Path, *acts: str) -> list[str]:
    """Return the command of a program with these acts."""
    folder.mkdir()
    return [sys.executable, "-m", "tests.supervisor.actor", str(folder), *acts]


def keep(
    folder: Path,
    *acts: str,
    patience: Timeouts = PATIENCE,
    calm: tuple[str, ...] = ("stay",),
    listening: Listening = lambda _supervisor, _happening: None,
) -> Night:
    """Keep a kiosk that acts like this until the supervisor ends."""
    night, deadline = Night(folder), monotonic() + PATIENCE_S

    def tell(happening: SupervisorEvent) -> None:
        night.told.append(happening)
        assert monotonic() < deadline, f"the supervisor does not end: {night.what()[-6:]}"
        listening(supervisor, happening)

    supervisor = Supervisor(actor(folder / "kiosk", *acts), actor(folder / "calm", *calm), tell, patience)
    night.code = supervisor.run()
    return night


@pytest.mark.parametrize(
    ("act", "what", "how"),
    [
        ("break", SupervisorEventKind.DIED, "exit code 1"),
        ("break unseen", SupervisorEventKind.DIED, "exit code 1"),
        ("be killed", SupervisorEventKind.DIED, "signal 9"),
        ("hang", SupervisorEventKind.HUNG, "no sign of life"),
        ("stop", SupervisorEventKind.HUNG, "no sign of life"),
    ],
)
def test_a_kiosk_that_dies_or_hangs_is_started_again(
    tmp_path: Path, act: str, what: SupervisorEventKind, how: str
) -> None:
    night = keep(tmp_path, act, "leave")
    assert night.details(what) == [how]
    assert night.what()[-3:] == ["started", "ready", "left"]
    assert night.code == LEFT
    assert len(night.starts("kiosk")) == 2


def test_a_kiosk_that_shows_nothing_in_time_is_started_again(tmp_path: Path) -> None:
    night = keep(tmp_path, "hang unseen", "leave", patience=HASTE)
    assert night.details(SupervisorEventKind.HUNG) == ["no first frame"]
    assert night.code == LEFT


def test_how_long_a_kiosk_was_away_is_told_with_the_next_one(tmp_path: Path) -> None:
    night = keep(tmp_path, "break", "leave")
    first, second = (one for one in night.told if one.what is SupervisorEventKind.READY)
    assert first.away_s is None
    assert second.away_s is not None


def test_the_time_until_a_hang_was_noticed_counts_as_time_away(tmp_path: Path) -> None:
    night = keep(tmp_path, "hang", "leave")
    hung = next(one for one in night.told if one.what is SupervisorEventKind.HUNG)
    _, second = (one for one in night.told if one.what is SupervisorEventKind.READY)
    assert hung.away_s is not None
    assert hung.away_s >= PATIENCE.silence
    assert second.away_s == pytest.approx(hung.away_s + second.at_s - hung.at_s, abs=0.05)


def test_starts_that_do_not_come_up_count_as_time_away(tmp_path: Path) -> None:
    night = keep(tmp_path, "break", "break unseen", "leave", patience=Timeouts(longest_pause=LONGEST_PAUSE, tick=0.02))
    died = next(one for one in night.told if one.what is SupervisorEventKind.DIED)
    _, back = (one for one in night.told if one.what is SupervisorEventKind.READY)
    assert back.away_s == pytest.approx(back.at_s - died.at_s, abs=0.05)


def test_the_screens_that_are_shown_are_told(tmp_path: Path) -> None:
    assert keep(tmp_path, "leave").details(SupervisorEventKind.SHOWS) == ["attract"]


def test_a_kiosk_that_refuses_what_it_was_given_is_not_tried_again(tmp_path: Path) -> None:
    night = keep(tmp_path, "refuse")
    assert night.what() == ["started", "refused"]
    assert night.code == REFUSED


def test_a_refusal_after_the_kiosk_was_up_is_met_with_patience(tmp_path: Path) -> None:
    night = keep(tmp_path, "break", "refuse", "leave")
    assert night.details(SupervisorEventKind.DIED) == ["exit code 1", "exit code 2"]
    assert night.code == LEFT


def test_between_kiosks_that_die_young_there_is_a_pause_from_the_second_on(tmp_path: Path) -> None:
    patience = Timeouts(young=60, longest_pause=LONGEST_PAUSE, tick=0.02)
    night = keep(tmp_path, "break", "break unseen", "break", "leave", patience=patience)
    assert [one.away_s for one in night.told if one.what is SupervisorEventKind.PAUSE] == [LONGEST_PAUSE] * 2


def test_a_kiosk_that_takes_too_much_memory_is_started_again_although_it_beats(tmp_path: Path) -> None:
    # Taking memory may take a busy machine longer than a kiosk may be silent.
    patience = replace(PATIENCE, memory_mib=200, silence=30)
    night = keep(tmp_path, "swell", "leave", patience=patience)
    assert night.what() == ["started", "ready", "swelled", "started", "ready", "left"]
    [detail] = night.details(SupervisorEventKind.SWELLED)
    assert detail.endswith(" MiB of memory")
    assert not any(map(runs, night.starts("kiosk")))


def test_whatever_a_kiosk_started_ends_with_it_and_its_temporary_files_go(tmp_path: Path) -> None:
    night = keep(tmp_path, "hang with company", "leave")
    assert night.code == LEFT
    assert not runs(int((tmp_path / "kiosk" / "company").read_text()))
    assert not Path((tmp_path / "kiosk" / "left").read_text()).exists()
    assert not any(map(runs, night.starts("kiosk")))


@pytest.mark.parametrize("act", ["stay", "stay deaf", "burn"])
def test_a_supervisor_that_is_told_to_end_takes_the_kiosk_with_it_deaf_or_not(tmp_path: Path, act: str) -> None:
    def end_when_ready(supervisor: Supervisor, happening: SupervisorEvent) -> None:
        if happening.what is SupervisorEventKind.READY:
            supervisor.end()

    night = keep(tmp_path, act, listening=end_when_ready)
    assert night.what() == ["started", "ready", "told to end"]
    assert night.code == LEFT
    assert not any(map(runs, night.starts("kiosk") + night.starts("calm")))


def test_the_calm_window_is_there_before_the_kiosk_and_lies_there_until_the_end(tmp_path: Path) -> None:
    there: list[int] = []

    def look(_supervisor: Supervisor, happening: SupervisorEvent) -> None:
        if happening.what in {SupervisorEventKind.STARTED, SupervisorEventKind.DIED}:
            there.extend(Night(tmp_path).starts("calm"))

    night = keep(tmp_path, "break", "break", "leave", listening=look)
    (calm,) = night.starts("calm")
    assert there == [calm] * 5
    assert not runs(calm)


def test_a_calm_window_that_is_gone_is_replaced_before_the_next_kiosk(tmp_path: Path) -> None:
    night = keep(tmp_path, "hang", "leave", calm=("break", "stay"))
    assert len(night.starts("calm")) == 2
    assert night.code == LEFT


def test_without_a_calm_window_the_kiosk_is_kept_all_the_same(tmp_path: Path) -> None:
    night = keep(tmp_path, "leave", calm=("break unseen",))
    assert night.what() == ["no calm window", "started", "ready", "left"]
    assert night.code == LEFT


def test_a_program_that_cannot_be_started_is_tried_again(tmp_path: Path) -> None:
    def give_up(supervisor: Supervisor, happening: SupervisorEvent) -> None:
        if happening.start == 2:
            supervisor.end()

    night = Night(tmp_path)

    def tell(happening: SupervisorEvent) -> None:
        night.told.append(happening)
        give_up(supervisor, happening)

    supervisor = Supervisor([str(tmp_path / "nothing")], [str(tmp_path / "nothing")], tell, PATIENCE)
    assert supervisor.run() == LEFT
    assert night.details(SupervisorEventKind.DIED)[0] == "it could not be started: No such file or directory"


def test_whoever_watches_the_supervisor_is_told_what_the_kiosk_tells(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    above = NotifySocketListener(tmp_path)
    monkeypatch.setenv("NOTIFY_SOCKET", above.environment["NOTIFY_SOCKET"])
    assert os.environ["NOTIFY_SOCKET"]
    keep(tmp_path, "leave")
    heard: dict[str, str] = {}
    while notice := above.hear(0):
        heard |= notice
    above.close()
    assert heard == {"WATCHDOG": "1", "READY": "1", "STATUS": "attract", "STOPPING": "1"}


def test_a_supervisor_whose_watcher_is_gone_takes_the_kiosk_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else what is started in its place would find the data in use."""
    monkeypatch.setattr("kiosk.supervisor.BEAT_S", 0.02)
    above = NotifySocketListener(tmp_path)
    monkeypatch.setenv("NOTIFY_SOCKET", above.environment["NOTIFY_SOCKET"])

    def leave(_: Supervisor, happening: SupervisorEvent) -> None:
        if happening.what is SupervisorEventKind.READY:
            above.close()

    night = keep(tmp_path, "stay", listening=leave)
    assert night.code == LEFT
    assert night.what()[-1] == "told to end"
    assert not any(runs(process) for process in (*night.starts("kiosk"), *night.starts("calm")))
