"""Whether something restarts the kiosk is seen from its programs, its services and its desktop files."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import preflight as looked
from kiosk.preflight import Severity, autostart_check, enabled, is_supervisor


@pytest.fixture
def bare(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a machine without a supervisor: its user's home and programs."""
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(looked, "supervisor_runs", lambda: False)
    return tmp_path


@pytest.mark.parametrize(
    "command",
    [
        ["/usr/bin/recollect", "run", "--supervise"],
        ["python3", "-m", "kiosk", "run", "--data", "x", "--supervise"],
        ["/opt/venv/bin/python", "/opt/venv/bin/recollect", "run", "--supervise"],
        ["C:/Recollect/recollect.exe", "run", "--supervise"],
    ],
)
def test_a_supervisor_is_known_by_its_command(command: list[str]) -> None:
    assert is_supervisor(command)


@pytest.mark.parametrize(
    "command",
    [
        [],
        ["run", "--supervise"],
        ["docker", "run", "--supervise"],
        ["recollect", "run", "--unattended"],
        ["recollect", "--supervise"],
        ["kiosk", "-m"],
    ],
)
def test_nothing_else_is_taken_for_one(command: list[str]) -> None:
    assert not is_supervisor(command)


@pytest.mark.usefixtures("bare")
def test_a_kiosk_that_nobody_keeps_up_is_told_of() -> None:
    (found,) = autostart_check()
    assert (found.severity, "recollect run --supervise" in found.remedy) == (Severity.WARNING, True)


@pytest.mark.usefixtures("bare")
def test_a_supervisor_that_runs_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(looked, "supervisor_runs", lambda: True)
    (found,) = autostart_check()
    assert (found.severity, found.message) == (Severity.OK, "a supervisor runs")


def test_a_service_that_is_enabled_is_enough(bare: Path) -> None:
    systemctl = bare / "systemctl"
    systemctl.write_text('#!/bin/sh\ntest "$1" = --user\n')
    systemctl.chmod(0o700)
    assert list(enabled()) == ["recollect.service"]


def test_a_service_manager_that_hangs_is_not_waited_for(bare: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(looked, "_ANSWER_S", 0.2)
    systemctl = bare / "systemctl"
    systemctl.write_text("#!/bin/sh\nexec /bin/sleep 60\n")
    systemctl.chmod(0o700)
    assert list(enabled()) == []


def test_a_desktop_that_opens_it_is_enough(bare: Path) -> None:
    autostart = bare / ".config" / "autostart"
    autostart.mkdir(parents=True)
    (autostart / "recollect-autostart.desktop").touch()
    (autostart / "other.desktop").touch()
    assert list(enabled()) == ["recollect-autostart.desktop"]
