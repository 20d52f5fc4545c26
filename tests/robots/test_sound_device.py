"""Playing: starts and ends by the samples that were played, and a device that is missing, goes away and comes back."""

from __future__ import annotations

import queue
import sys
import time
from collections.abc import Callable, Generator, Iterator
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from kiosk.robots import sound_device
from kiosk.robots.clips import Clip, joined
from kiosk.robots.sound_device import NOWHERE, CommandPlayer, Player, StreamPlayer
from tests.robots import pulse
from tests.robots.pulse import PulseServer

miniaudio: Any = vars(sound_device)["miniaudio"]

RATE = 16_000
PATIENCE_S = 10.0
TONE = Clip.of(0.5 * np.sin(2 * np.pi * 440 * np.arange(RATE // 5) / RATE), RATE)
LONG = Clip.of(np.tile(TONE.values, 300), RATE)

streams = pytest.mark.skipif(not sound_device.HAS_STREAM, reason="miniaudio has no build for this machine")
virtual = pytest.mark.skipif(not pulse.is_installed(), reason="there is no PulseAudio")


class Ears:
    """What a player posts."""

    def __init__(self) -> None:
        self.posts: queue.Queue[dict[str, Any]] = queue.Queue()

    def next(self, player: Player) -> dict[str, Any]:
        """Return the next thing that is posted, while the player is looked after as its process does."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                return self.posts.get(timeout=0.02)
            except queue.Empty:
                player.tend()
                assert time.monotonic() < deadline, "nothing was posted"


class FakeDevice:
    """A sound device that takes samples when a test says so."""

    opened: list[FakeDevice]
    """Every one that was opened, the last one last."""
    rates: set[int]
    """Samples a second that it takes."""
    results: list[int]
    """What opening it returns, one after another; then it works."""
    backend = "Fake"

    def __init__(self, _format: object, _channels: int, rate: int, _period_ms: int, **_: object) -> None:
        if self.results:
            raise miniaudio.MiniaudioError("failed to init device", self.results.pop(0))
        if rate not in self.rates:
            raise miniaudio.MiniaudioError("failed to init device", miniaudio.lib.MA_FORMAT_NOT_SUPPORTED)
        self.rate = rate
        self.asking: Generator[bytes, int, None] | None = None
        self.opened.append(self)

    def start(self, asking: Generator[bytes, int, None]) -> None:
        """Ask for what the buffer holds, as devices do."""
        self.asking = asking
        self.take(self.rate // 100)

    def take(self, count: int) -> NDArray[np.int16]:
        """Play so many samples."""
        assert self.asking is not None
        return np.frombuffer(self.asking.send(count), np.int16)

    def close(self) -> None:
        """Nothing is held."""


@pytest.fixture
def devices(monkeypatch: pytest.MonkeyPatch) -> type[FakeDevice]:
    """Put a device of the test's own in the place of the machine's, and try it again without a pause."""
    fake = type("Fake", (FakeDevice,), {"opened": [], "rates": {RATE, 44_100, 48_000}, "results": []})
    monkeypatch.setattr(miniaudio, "PlaybackDevice", fake)
    monkeypatch.setattr(sound_device, "_chosen", lambda wanted: sound_device._Chosen(wanted or "loudspeaker", {}))
    monkeypatch.setattr(sound_device, "REOPEN_S", 0.0)
    monkeypatch.setattr(sound_device, "STALLED_S", 0.3)
    monkeypatch.setattr(sound_device, "PROVEN_S", 0.02)
    return fake


def tended(player: StreamPlayer, holds: Callable[[], object]) -> None:
    """Look after a player until something holds."""
    deadline = time.monotonic() + PATIENCE_S
    while not holds():
        player.tend()
        assert time.monotonic() < deadline, "what was waited for never came"


@pytest.fixture
def ears() -> Ears:
    """Ears."""
    return Ears()


@pytest.fixture
def player(ears: Ears) -> Iterator[StreamPlayer]:
    """Provide a player whose device keeps the time and is heard by no one."""
    player = StreamPlayer(ears.posts.put, RATE, NOWHERE)
    assert player.device == NOWHERE
    yield player
    player.close()


@streams
def test_a_sound_starts_and_finishes_when_its_samples_were_played(ears: Ears, player: StreamPlayer) -> None:
    begun = time.monotonic()
    player.play(3, TONE)
    assert ears.next(player) == {"event": "started", "id": 3}
    started = time.monotonic()
    assert ears.next(player) == {"event": "finished", "id": 3}
    assert time.monotonic() - begun >= TONE.duration_ms / 1000 - 0.05
    assert started < time.monotonic()
    assert not player.busy


@streams
def test_nothing_is_posted_of_a_sound_that_was_stopped_or_has_no_number(ears: Ears, player: StreamPlayer) -> None:
    player.play(1, LONG)
    assert ears.next(player)["event"] == "started"
    player.stop()
    player.play(None, TONE)
    tended(player, lambda: not player.busy)
    player.play(2, TONE)
    assert [ears.next(player)["id"], ears.next(player)["event"]] == [2, "finished"]


@streams
def test_a_device_that_asks_for_nothing_any_more_breaks_the_sound_off_and_is_tried_again(
    ears: Ears, player: StreamPlayer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sound_device, "REOPEN_S", 0.1)
    monkeypatch.setattr(sound_device, "STALLED_S", 0.2)
    player.play(1, LONG)
    assert ears.next(player)["event"] == "started"
    player._stream.stop()
    assert ears.next(player) == {"event": "broken", "id": 1, "why": "the sound device is gone"}
    assert ears.next(player)["device"] == ""
    assert ears.next(player) == {"event": "device", "device": NOWHERE}
    player.play(2, TONE)
    assert ears.next(player) == {"event": "started", "id": 2}


@streams
def test_a_device_that_is_not_there_is_named_and_every_sentence_is_given_up(ears: Ears) -> None:
    player = StreamPlayer(ears.posts.put, RATE, "a loudspeaker from another booth")
    player.play(4, TONE)
    post = ears.next(player)
    assert (post["event"], post["id"]) == ("broken", 4)
    assert player.device == ""
    assert player.why in {post["why"], sound_device.NO_DEVICE}
    player.close()


@streams
@pytest.mark.parametrize("only", [44_100, 48_000])
def test_a_device_of_another_rate_plays_a_clip_at_its_own_height_and_length(
    ears: Ears, devices: type[FakeDevice], only: int
) -> None:
    devices.rates = {only}
    player = StreamPlayer(ears.posts.put, RATE)
    player.play(1, TONE)
    played = devices.opened[-1].take(only)
    heard = np.flatnonzero(np.abs(played) > 1000)
    assert (heard[-1] - heard[0]) / only == pytest.approx(TONE.duration_ms / 1000, abs=0.005)
    spectrum = np.abs(np.fft.rfft(played[heard[0] : heard[-1]]))
    assert spectrum.argmax() * only / (heard[-1] - heard[0]) == pytest.approx(440, abs=5)
    devices.opened[-1].take(only // 50)
    assert [ears.next(player)["event"], ears.next(player)["event"]] == ["started", "finished"]


@streams
def test_a_device_that_another_program_holds_is_called_busy_and_taken_when_it_is_free(
    ears: Ears, devices: type[FakeDevice]
) -> None:
    devices.results = [miniaudio.lib.MA_BUSY] * 3
    player = StreamPlayer(ears.posts.put, RATE)
    assert (player.device, player.why) == ("", sound_device.BUSY)
    player.play(1, TONE)
    assert ears.next(player) == {"event": "broken", "id": 1, "why": sound_device.BUSY}
    tended(player, lambda: devices.opened)
    tended(player, lambda: devices.opened[-1].take(80).size and player.device)
    assert ears.next(player) == {"event": "device", "device": "loudspeaker"}
    player.play(2, TONE)
    devices.opened[-1].take(RATE)
    assert ears.next(player) == {"event": "started", "id": 2}


@streams
def test_a_machine_that_was_suspended_breaks_the_sentence_off_once_and_sounds_again_when_its_device_does(
    ears: Ears, devices: type[FakeDevice]
) -> None:
    """The device opens, asks once for what its buffer holds, and then for nothing, as long as the machine likes."""
    player = StreamPlayer(ears.posts.put, RATE)
    player.play(1, LONG)
    devices.opened[-1].take(RATE)
    assert ears.next(player) == {"event": "started", "id": 1}
    tended(player, lambda: len(devices.opened) == 4)
    assert ears.next(player) == {"event": "broken", "id": 1, "why": sound_device.GONE}
    assert ears.next(player) == {"event": "device", "device": "", "why": sound_device.GONE}
    assert ears.posts.empty()
    player.play(2, TONE)
    assert ears.next(player) == {"event": "broken", "id": 2, "why": sound_device.GONE}
    tended(player, lambda: devices.opened[-1].take(80).size and player.device)
    assert ears.next(player) == {"event": "device", "device": "loudspeaker"}
    player.play(3, TONE)
    devices.opened[-1].take(RATE)
    assert ears.next(player) == {"event": "started", "id": 3}


@streams
def test_a_sound_that_is_stopped_fades_and_its_volume_is_kept(ears: Ears, player: StreamPlayer) -> None:
    player.close()
    player.set_volume(0.5)
    player._sound = sound_device._Sound(None, np.full(RATE, 10_000, np.int16), player._given)
    before = np.frombuffer(player._next(100), np.int16)
    player.stop()
    after = np.frombuffer(player._next(200), np.int16).astype(int)
    assert set(before.tolist()) == {5_000}
    assert np.abs(np.diff(after)).max() < 100
    assert after[0] == 5_000
    assert after[-1] == 0
    assert ears.posts.empty()


def test_parts_are_joined_with_a_pause() -> None:
    whole = joined([TONE, TONE], pause_ms=100)
    assert whole.duration_ms == 2 * TONE.duration_ms + 100


def test_a_player_without_a_program_gives_every_sentence_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ears: Ears
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    player = CommandPlayer(ears.posts.put)
    player.play(1, TONE)
    assert player.device == ""
    assert ears.next(player) == {"event": "broken", "id": 1, "why": "there is no program that plays sound"}
    player.close()


@pytest.mark.skipif(sys.platform == "win32", reason="a program that fails is a shell script here")
def test_a_player_whose_program_fails_tells_that_there_is_no_device_until_it_plays_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ears: Ears
) -> None:
    program = tmp_path / "aplay"
    program.write_text("#!/bin/sh\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    player = CommandPlayer(ears.posts.put)
    # Nothing was to be played yet.
    assert ears.next(player) == {"event": "device", "device": "", "why": sound_device.NO_DEVICE}
    player.play(1, TONE)
    assert ears.next(player) == {"event": "started", "id": 1}
    assert ears.next(player) == {"event": "broken", "id": 1, "why": sound_device.NO_DEVICE}
    program.write_text("#!/bin/sh\nexit 0\n")
    player.play(2, TONE)
    posts = [ears.next(player) for _ in range(3)]
    assert [post["event"] for post in posts] == ["started", "finished", "device"]
    assert posts[2]["device"] == "aplay"
    player.close()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[PulseServer]:
    """Provide a virtual loudspeaker."""
    # The path of a socket has at most 107 bytes, and a test's own folder may be longer.
    with TemporaryDirectory() as folder:
        server = PulseServer(Path(folder))
        server.start()
        for name in ("PULSE_SERVER", "PULSE_RUNTIME_PATH", "XDG_RUNTIME_DIR"):
            monkeypatch.setenv(name, server.environment[name])
        yield server
        server.stop()


@streams
@virtual
def test_a_virtual_loudspeaker_is_given_the_sound_and_its_loss_and_return_are_told(
    server: PulseServer, ears: Ears, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sound_device, "REOPEN_S", 0.2)
    player = StreamPlayer(ears.posts.put, RATE)
    assert player.device.startswith("system default")
    with server.microphone() as recorder:
        pulse.heard(recorder, 4_800)
        player.play(1, TONE)
        recording = pulse.heard(recorder, 24_000)
    assert np.abs(recording).max() > 0.4 * 2**15
    assert [ears.next(player)["event"], ears.next(player)["event"]] == ["started", "finished"]

    player.play(2, LONG)
    assert ears.next(player)["event"] == "started"
    server.stop()
    assert ears.next(player) == {"event": "broken", "id": 2, "why": "the sound device is gone"}
    assert ears.next(player)["device"] == ""
    player.play(3, TONE)
    post = ears.next(player)
    assert post["event"] == "broken"
    server.start()
    # A sound server that has just begun may stall once more on a busy machine.
    numbers = count(4)
    deadline = time.monotonic() + PATIENCE_S
    while not player.device or post["event"] != "started":
        assert time.monotonic() < deadline, "the loudspeaker did not come back"
        if player.device and not player.busy:
            player.play(next(numbers), TONE)
        post = ears.next(player)
    player.close()


@streams
@virtual
def test_a_loudspeaker_is_silent_while_it_is_suspended_and_is_not_the_placeholder_of_none(
    server: PulseServer, ears: Ears, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sound_device, "REOPEN_S", 0.2)
    monkeypatch.setattr(sound_device, "LOOK_S", 0.2)
    server.control("load-module", "module-always-sink")
    player = StreamPlayer(ears.posts.put, RATE)
    player.play(1, LONG)
    assert ears.next(player)["event"] == "started"
    server.control("suspend-sink", "booth", "1")
    assert ears.next(player) == {"event": "broken", "id": 1, "why": sound_device.GONE}
    assert ears.next(player)["device"] == ""
    server.control("suspend-sink", "booth", "0")
    assert ears.next(player)["device"].startswith("system default")

    player.play(2, LONG)
    assert ears.next(player)["event"] == "started"
    server.control("unload-module", "module-null-sink")
    why = "there is no sound device, only Dummy Output, which is no sound card"
    assert ears.next(player) == {"event": "broken", "id": 2, "why": why}
    assert ears.next(player) == {"event": "device", "device": "", "why": why}
    server.control("load-module", "module-null-sink", "sink_name=booth", "rate=44100", "norewinds=1")
    assert ears.next(player)["device"].startswith("system default")
    with server.microphone() as recorder:
        pulse.heard(recorder, 4_800)
        player.play(3, TONE)
        recording = pulse.heard(recorder, 24_000)
    spectrum = np.abs(np.fft.rfft(recording))
    # A busy machine leaves gaps in a recording, which blur the peak.
    assert spectrum.argmax() * 2 == pytest.approx(440, abs=25)
    player.close()
