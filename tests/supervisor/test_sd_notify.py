"""Notices arrive through a socket with or without a name, or through a pipe, and sending never fails."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from kiosk.sd_notify import (
    Notifier,
    NotifyListener,
    NotifyPipeListener,
    NotifySocketListener,
    Presence,
    parse_notification,
    relay,
)
from tests.patience import started

LONG = 10.0
"""Seconds; nothing here takes as long unless it fails."""

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")


@pytest.fixture(params=["socket", "pipe"])
def listener(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[NotifyListener]:
    """Each hearing end."""
    made = NotifySocketListener(tmp_path) if request.param == "socket" else NotifyPipeListener()
    yield made
    made.close()


def test_what_another_process_tells_is_heard_in_order(listener: NotifyListener) -> None:
    program = (
        "import os; from kiosk.sd_notify import Notifier; n = Notifier(os.environ)\n"
        "n.tell(READY=1, STATUS='two\\nlines'); n.tell(WATCHDOG=1)"
    )
    subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | listener.environment,
        pass_fds=listener.inherited,
        check=True,
        timeout=LONG,
    )
    told: list[tuple[str, str]] = []
    while len(told) < 3 and (notice := listener.hear(LONG)):
        told += notice.items()
    assert told == [("READY", "1"), ("STATUS", "two lines"), ("WATCHDOG", "1")]


def test_silence_is_an_empty_notice(listener: NotifyListener) -> None:
    assert listener.hear(0) == {}
    assert listener.hear(0.01) == {}


def test_a_socket_without_a_file_is_told_as_well() -> None:
    """An abstract socket, as systemd gives to services: its name begins with a 0, which the environment shows as @."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
        systemd.bind(f"\0recollect-test-{os.getpid()}")
        systemd.settimeout(LONG)
        notifier = Notifier({"NOTIFY_SOCKET": f"@recollect-test-{os.getpid()}"})
        assert notifier.tell(READY=1)
        assert systemd.recv(100) == b"READY=1"
        notifier.close()


def test_where_nobody_listens_nothing_is_told() -> None:
    assert not Notifier({}).tell(READY=1)


def test_telling_somebody_who_is_gone_does_not_hurt(tmp_path: Path) -> None:
    listener = NotifySocketListener(tmp_path)
    notifier = Notifier(listener.environment)
    assert notifier.tell(WATCHDOG=1)
    listener.close()
    assert not notifier.tell(WATCHDOG=1)
    notifier.close()
    assert not notifier.tell(WATCHDOG=1)


def test_telling_somebody_who_does_not_listen_never_waits(tmp_path: Path) -> None:
    listener = NotifySocketListener(tmp_path)
    notifier = Notifier(listener.environment)
    assert all(notifier.tell(WATCHDOG=1) for _ in range(1_000))
    notifier.close()
    listener.close()


def test_what_is_no_notice_is_left_out() -> None:
    assert parse_notification(b"READY=1\nnonsense\n\xff=\xff=1\n") == {"READY": "1", "\ufffd": "\ufffd=1"}


TELLS = """
import os, sys
from kiosk.sd_notify import Notifier
Notifier(os.environ).tell(READY=1, MAINPID=os.getppid())
sys.exit(7)
"""


def test_the_notices_of_a_command_are_sent_on_by_the_process_that_systemd_listens_to(tmp_path: Path) -> None:
    """As a service with a login session needs it: there systemd hears its main process alone."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
        systemd.bind(str(tmp_path / "systemd"))
        systemd.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
        systemd.settimeout(LONG)
        environment = {**os.environ, "NOTIFY_SOCKET": str(tmp_path / "systemd")}
        assert relay([sys.executable, "-c", TELLS], environment) == 7
        words, passed, _, _ = systemd.recvmsg(1000, socket.CMSG_SPACE(12))
    assert parse_notification(words) == {"READY": "1", "MAINPID": str(os.getpid())}
    assert int.from_bytes(passed[0][2][:4], sys.byteorder) == os.getpid()


HANGS = """
import os, signal, subprocess, sys
from kiosk.sd_notify import Notifier
with subprocess.Popen([sys.executable, "-c", "import signal; signal.pause()"], start_new_session=True) as company:
    open(sys.argv[1], "w").write(str(company.pid))
    Notifier(os.environ).tell(READY=1)
    os.kill(os.getpid(), signal.SIGSTOP)
"""


def test_a_command_that_falls_silent_is_ended_by_the_relay_with_all_that_it_started(tmp_path: Path) -> None:
    """As with a supervisor under cage: a login session has it, so systemd would leave it there."""
    environment = {**os.environ, "WATCHDOG_USEC": "300000"}
    assert relay([sys.executable, "-c", HANGS, str(tmp_path / "company")], environment) == -signal.SIGKILL
    company = int((tmp_path / "company").read_text())
    end = time.monotonic() + LONG
    while psutil.pid_exists(company) and psutil.Process(company).status() != psutil.STATUS_ZOMBIE:
        assert time.monotonic() < end


@pytest.mark.parametrize(
    ("signs", "lost"),
    [
        ((False, False, False), False),
        ((True, False), False),
        ((True, False, False), True),
        ((True, False, True), False),
    ],
)
def test_those_who_heard_and_hear_no_more_are_gone(signs: tuple[bool, ...], lost: bool) -> None:  # noqa: FBT001
    presence = Presence(2)
    assert [presence.lost(heard=heard) for heard in signs][-1] is lost


WAITS = """
import signal, sys
# Held back: a signal just before a wait would be missed.
signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
print("up", flush=True)
signal.sigwait([signal.SIGTERM])
sys.exit(5)
"""


def test_a_command_that_is_asked_to_end_by_way_of_the_relay_ends_in_order() -> None:
    program = f"from kiosk.sd_notify import relay; import sys; sys.exit(relay([sys.executable, '-c', {WAITS!r}]))"
    with started([sys.executable, "-c", program], stdout=subprocess.PIPE, process_group=0) as process:
        assert process.stdout.readline() == b"up\n"
        process.terminate()
        assert process.wait(LONG) == 5
