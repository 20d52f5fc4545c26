"""Booths publish their status to a broker, and are watched from afar: a real Mosquitto, and a real browser."""

from __future__ import annotations

import getpass
import json
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
import requests
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli import watch as cli
from kiosk.cli.main import recollect
from kiosk.config import Remote
from kiosk.experiment.alarms import AlarmKind
from kiosk.experiment.booth_status import CLOSED, AlarmStatus, PartStatus, utc
from kiosk.remote import HUNG_S, LONGEST, LOST, QUEUED, BoothWatch, SeenBooth, StatusPublisher, booth_name, served
from tests.analysis.chromium import opened_browser
from tests.patience import serving
from tests.samples import PLAYING as STATUS

PATIENCE_S = 30.0
KIOSK = """
import sys, time
from pathlib import Path
from kiosk.config import Remote
from kiosk.remote import StatusPublisher
from tests.test_remote import STATUS
publisher = StatusPublisher(Remote(mqtt=sys.argv[1]), sys.argv[2], Path)
while True:
    publisher.publish(STATUS)
    time.sleep(0.1)
"""


def until(condition: Callable[[], object], patience_s: float = PATIENCE_S) -> float:
    """Wait until something is so; returns how many seconds that took."""
    began = time.monotonic()
    while not condition():
        assert time.monotonic() - began < patience_s, "it never came"
        time.sleep(0.02)
    return time.monotonic() - began


def free_port() -> int:
    """Return a port at which nothing listens."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
        return port


class Broker:
    """A Mosquitto of this machine, which can be stopped and started again at the same port."""

    def __init__(self, folder: Path, settings: str = "allow_anonymous true") -> None:
        program = shutil.which("mosquitto") or shutil.which("mosquitto", path="/usr/sbin")
        if program is None:
            pytest.skip("Mosquitto is not installed: apt install mosquitto")
        self.port = free_port()
        file = folder / "mosquitto.conf"
        # As a service, Mosquitto becomes another user, who cannot read a test's files.
        file.write_text(f"user {getpass.getuser()}\nlistener {self.port} 127.0.0.1\n{settings}\n", "utf-8")
        self._command = [program, "-c", str(file)]
        self._process: subprocess.Popen[bytes] | None = None
        self.start()

    @property
    def address(self) -> str:
        """What a booth calls it."""
        return f"mqtt://127.0.0.1:{self.port}"

    def start(self) -> None:
        """Begin, or begin again."""
        self._process = subprocess.Popen(self._command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until(self._answers)

    def stop(self) -> None:
        """End, as a network that is gone."""
        if self._process is not None:
            self._process.terminate()
            self._process.wait(PATIENCE_S)

    def _answers(self) -> bool:
        with socket.socket() as asked:
            return asked.connect_ex(("127.0.0.1", self.port)) == 0


@pytest.fixture(scope="module")
def broker(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Broker]:
    """Return a broker that lets everybody in."""
    made = Broker(tmp_path_factory.mktemp("broker"))
    yield made
    made.stop()


@pytest.fixture
def remote(broker: Broker, request: pytest.FixtureRequest) -> Remote:
    """Return settings with a topic of the test's own."""
    return Remote(mqtt=broker.address, topic=request.node.name[:60].split("[")[0])


@pytest.fixture
def watch(remote: Remote) -> Iterator[BoothWatch]:
    """Return a watcher that is connected."""
    made = BoothWatch(remote)
    until(lambda: not made.trouble)
    yield made
    made.close()


@pytest.fixture
def publisher(remote: Remote) -> Iterator[StatusPublisher]:
    """Return a booth's publisher that is connected."""
    made = StatusPublisher(remote, "hall-2", Path)
    until(lambda: not made.trouble)
    yield made
    made.close()


def states(watch: BoothWatch) -> dict[str, str]:
    """Return how every booth is."""
    return {row["booth"]: row["state"] for row in watch.rows}


def test_a_status_is_seen_from_afar(watch: BoothWatch, publisher: StatusPublisher) -> None:
    publisher.publish(STATUS)
    until(lambda: watch.rows)
    (row,) = watch.rows
    assert (row["booth"], row["state"], row["stage"], row["minutes"]) == ("hall-2", "well", "game", 3)
    assert (row["today"]["begun"], row["trouble"]) == (3, [])


def test_who_comes_later_sees_the_last_status(remote: Remote, publisher: StatusPublisher, watch: BoothWatch) -> None:
    publisher.publish(STATUS)
    until(lambda: watch.rows)
    later = BoothWatch(remote)
    until(lambda: later.rows)
    later.close()


def test_a_kiosk_that_is_killed_is_lost_within_two_seconds(broker: Broker) -> None:
    watch = BoothWatch(Remote(mqtt=broker.address))
    with serving([sys.executable, "-c", KIOSK, broker.address, "killed"]):
        until(lambda: states(watch).get("killed") == "well")
    assert until(lambda: states(watch)["killed"] == "lost") < 2
    watch.close()


def test_a_kiosk_that_hangs_is_seen_within_fifteen_seconds(remote: Remote, publisher: StatusPublisher) -> None:
    now_s = [0.0]
    watch = BoothWatch(remote, now_s=lambda: now_s[0])
    publisher.publish(STATUS)
    until(lambda: watch.rows)
    now_s[0] = HUNG_S
    assert states(watch) == {"hall-2": "well"}
    now_s[0] = 15
    assert states(watch) == {"hall-2": "hung"}
    publisher.publish(STATUS)
    until(lambda: states(watch) == {"hall-2": "well"})
    watch.close()


def test_a_kiosk_that_is_left_is_closed_and_not_lost(remote: Remote, watch: BoothWatch) -> None:
    publisher = StatusPublisher(remote, "left", Path)
    until(lambda: not publisher.trouble)
    publisher.publish(replace(STATUS, stage=CLOSED))
    publisher.close()
    until(lambda: states(watch) == {"left": "closed"})


def test_booth_and_watcher_come_back_after_the_network_was_lost(tmp_path: Path) -> None:
    broker = Broker(tmp_path)
    settings = Remote(mqtt=broker.address)
    publisher, watch = StatusPublisher(settings, "hall-2", Path), BoothWatch(settings)
    until(lambda: not publisher.trouble and not watch.trouble)
    publisher.publish(STATUS)
    until(lambda: states(watch) == {"hall-2": "well"})
    broker.stop()
    until(lambda: publisher.trouble and watch.trouble)
    assert "the connection was lost" in {publisher.trouble, watch.trouble}
    assert states(watch) == {"hall-2": "unknown"}
    publisher.publish(replace(STATUS, stage="result"))
    broker.start()
    until(lambda: [row["stage"] for row in watch.rows if row["state"] == "well"] == ["result"])
    publisher.close()
    watch.close()
    broker.stop()


def test_without_a_broker_nothing_waits_and_nothing_piles_up() -> None:
    publisher = StatusPublisher(Remote(mqtt=f"mqtt://127.0.0.1:{free_port()}"), "hall-2", Path)
    for _ in range(1_000):
        publisher.publish(STATUS)
    assert publisher.trouble
    assert len(publisher._waiting) <= QUEUED
    publisher.close()


def made_certificates(folder: Path) -> None:
    """Make an authority, and certificates of a broker and of a booth."""
    openssl = shutil.which("openssl")
    if openssl is None:
        pytest.skip("OpenSSL is not installed")
    new = "req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2"
    for line in (
        f"{new} -x509 -keyout ca.key -out ca.crt -subj /CN=authority",
        f"{new} -keyout broker.key -out broker.csr -subj /CN=localhost",
        f"{new} -keyout booth.key -out booth.csr -subj /CN=booths",
        "x509 -req -in broker.csr -CA ca.crt -CAkey ca.key -days 2 -out broker.crt -extfile san",
        "x509 -req -in booth.csr -CA ca.crt -CAkey ca.key -days 2 -out booth.crt",
    ):
        (folder / "san").write_text("subjectAltName=DNS:localhost,IP:127.0.0.1", "utf-8")
        subprocess.run([openssl, *line.split()], cwd=folder, check=True, capture_output=True, timeout=PATIENCE_S)


@pytest.fixture(scope="module")
def secured(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Broker, Path]]:
    """Return a broker with TLS that lets booths write and nothing else, and the folder of the certificates."""
    folder = tmp_path_factory.mktemp("secured")
    made_certificates(folder)
    (folder / "acl").write_text("user booths\ntopic write recollect/#\nuser lab\ntopic read recollect/#\n", "utf-8")
    (folder / "password.txt").write_text("of the lab\n", "utf-8")
    passwords = folder / "passwords"
    program = shutil.which("mosquitto_passwd")
    if program is None:
        pytest.skip("mosquitto_passwd is not installed")
    subprocess.run(
        [program, "-b", "-c", str(passwords), "lab", "of the lab"], check=True, capture_output=True, timeout=PATIENCE_S
    )
    passwords.chmod(0o644)
    other = free_port()
    tls = f"cafile {folder}/ca.crt\ncertfile {folder}/broker.crt\nkeyfile {folder}/broker.key"
    made = Broker(
        folder,
        f"per_listener_settings true\n{tls}\nrequire_certificate true\nuse_identity_as_username true\n"
        f"acl_file {folder}/acl\nlistener {other} 127.0.0.1\n{tls}\n"
        f"password_file {passwords}\nacl_file {folder}/acl\nallow_anonymous false",
    )
    (folder / "port").write_text(str(other), "utf-8")
    yield made, folder
    made.stop()


def test_certificates_and_passwords_are_taken_and_booths_need_to_read_nothing(secured: tuple[Broker, Path]) -> None:
    broker, folder = secured
    by_certificate = Remote(
        mqtt=f"mqtts://localhost:{broker.port}", ca="ca.crt", certificate="booth.crt", key="booth.key"
    )
    publisher = StatusPublisher(by_certificate, "hall-2", folder.joinpath)
    address = f"mqtts://localhost:{(folder / 'port').read_text('utf-8')}"
    watch = BoothWatch(Remote(mqtt=address, ca="ca.crt", user="lab", password_file="password.txt"), folder.joinpath)  # noqa: S106 - a file
    until(lambda: not publisher.trouble and not watch.trouble)
    publisher.publish(STATUS)
    until(lambda: states(watch) == {"hall-2": "well"})
    publisher.close()
    watch.close()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"mqtt": "mqtt://broker.example", "user": "a", "password_file": "b"}, "over TLS alone"),
        ({"mqtt": "mqtts://broker.example", "user": "a", "password_file": "missing.txt"}, "missing.txt cannot be read"),
        ({"mqtt": "mqtts://broker.example", "ca": "missing.crt"}, "remote.ca: there is no file missing.crt"),
    ],
)
def test_settings_that_cannot_be_used_are_told_in_one_sentence(settings: dict[str, str], words: str) -> None:
    with pytest.raises(UserInputError, match=words):
        StatusPublisher(Remote(**settings), "hall-2", Path)


@pytest.mark.parametrize("text", ["broker.example", "http://broker", "mqtt://", "mqtt://a:99999", "mqtt://u:p@broker"])
def test_what_is_no_address_of_a_broker_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="no broker's address"):
        Remote(mqtt=text)


def test_a_booth_is_called_as_the_study_file_or_the_site_says() -> None:
    assert booth_name(Remote(booth="hall-2"), "ROME") == "hall-2"
    assert booth_name(Remote(), "ROME") == "ROME"
    assert booth_name(Remote(), "")


@pytest.mark.parametrize(
    "payload",
    [
        b"",
        b"{",
        b"\xff",
        b"x" * (LONGEST + 1),
        replace(STATUS, stage_since="yesterday").to_json().encode(),
        STATUS.to_json().replace('"begun": 3', '"none": 3').encode(),
        json.dumps(json.loads(STATUS.to_json()) | {"parts": 3}).encode(),
    ],
)
def test_what_is_no_status_is_left_alone(payload: bytes, watch: BoothWatch) -> None:
    watch.take("hall-2", STATUS.to_json().encode())
    watch.take("hall-2", payload)
    watch.take("a/b", STATUS.to_json().encode())
    assert states(watch) == {"hall-2": "well"}


def test_alarms_that_hold_and_parts_that_fail_are_told() -> None:
    alarms = (
        AlarmStatus("robot_lost", utc(0), seen=False, passed=None),
        AlarmStatus("disk_low", utc(0), seen=False, passed=None),
        AlarmStatus("flooded_hall", utc(0), seen=False, passed=None),
        AlarmStatus("no_visitor", utc(0), seen=True, passed=utc(1)),
    )
    ill = replace(STATUS, alarms=alarms, parts=(PartStatus("disk", ok=False, message="only 20 MiB free"),))
    booth = SeenBooth("hall-2", ill)
    assert booth.state(0) == "trouble"
    assert booth.troubles == ["the robot is lost", "flooded hall", "disk: only 20 MiB free"]


def test_every_alarm_has_words_for_those_who_watch_from_afar() -> None:
    for kind in AlarmKind:
        alarm = AlarmStatus(kind.value, utc(0), seen=False, passed=None)
        assert " " in SeenBooth("hall-2", replace(STATUS, alarms=(alarm,))).troubles[0]


def test_the_command_prints_a_table_and_tells_by_its_exit_code(
    broker: Broker, watch: BoothWatch, remote: Remote, publisher: StatusPublisher, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cli, "ONCE_S", 1)
    words = ["watch", "--broker", broker.address, "--topic", remote.topic]
    publisher.publish(STATUS)
    until(lambda: watch.rows)
    done = CliRunner().invoke(recollect, [*words, "--once"])
    assert done.exit_code == 0
    assert "hall-2" in done.output
    publisher.publish(replace(STATUS, parts=(PartStatus("robot", ok=False, message="gone\x1b[2J"),)))
    until(lambda: states(watch) == {"hall-2": "trouble"})
    done = CliRunner().invoke(recollect, [*words, "--once"])
    assert done.exit_code == 1
    assert "robot: gone" in done.output
    assert "\x1b[2J" not in done.output
    told = json.loads(CliRunner().invoke(recollect, [*words, "--json"]).output)
    assert told[0]["trouble"] == ["robot: gone\x1b[2J"]


def test_the_command_says_that_there_is_no_broker(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "ONCE_S", 0)
    done = CliRunner().invoke(recollect, ["watch", "--broker", f"127.0.0.1:{free_port()}", "--once"])
    assert isinstance(done.exception, UserInputError)
    assert "cannot be reached" in str(done.exception)


def test_the_page_is_given_to_those_who_know_the_token_and_can_only_be_read(watch: BoothWatch) -> None:
    with served(watch, "127.0.0.1", 0, "secret") as address:
        assert address.endswith("/secret/")
        assert requests.get(f"{address}booths.json", timeout=10).json() == {"trouble": "", "booths": []}
        for wrong in (address.replace("secret", "guess"), address.replace("secret/", ""), f"{address}../config.py"):
            assert requests.get(wrong, timeout=10).status_code == 404
        assert requests.post(address, data=b"{}", timeout=10).status_code == 501


def test_twenty_booths_on_one_page_and_what_happens_to_them(watch: BoothWatch, tmp_path: Path) -> None:
    names = [f"booth-{number:02}" for number in range(20)]
    for name in names:
        watch.take(name, STATUS.to_json().encode())
    with served(watch, "127.0.0.1", 0, "secret") as address, opened_browser(tmp_path) as browser:
        browser.ask("Page.navigate", url=address)
        headings = "[...document.querySelectorAll('li')].map(each => each.innerText)"
        until(lambda: len(browser.value(headings) or []) == 20)
        assert browser.value("document.getElementById('line').textContent") == "All 20 booths are well"
        assert browser.value("document.documentElement.scrollWidth <= innerWidth")
        watch.take("booth-03", LOST)
        watch.take(
            "booth-04",
            replace(STATUS, parts=(PartStatus("robot", ok=False, message="<b>gone</b>"),)).to_json().encode(),
        )
        until(lambda: browser.value("document.getElementById('line').textContent") == "2 of 20 booths need you")
        shown = browser.value(headings)
        assert [text.split()[0] for text in shown[:3]] == ["booth-03", "booth-04", "booth-00"]
        assert "lost" in shown[0]
        assert "robot: <b>gone</b>" in shown[1]
        assert browser.named("Runtime.exceptionThrown") == []
