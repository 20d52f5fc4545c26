"""Furhat's Remote API: what is asked is what the robot takes, and whatever goes wrong is a failure in time."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from time import monotonic

import pytest
import requests

from kiosk import UserInputError
from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.robots.clip_server import ClipServer
from kiosk.robots.driver import FailureKind, RobotError, RobotVoice, SpokenClip, Utterance, chosen_voice, speakable
from kiosk.robots.embodiment import BoardPoint
from kiosk.robots.furhat import Furhat
from kiosk.robots.registry import create_robot
from tests.patience import PATIENCE_S
from tests.robots.furhat_fake import FAULTS, FurhatFake, Mode

DEADLINE_MS = 250
SPARE_S = 1.0
"""How much later than its deadline a call may end on a machine that does other things as well."""


@pytest.fixture
def fake() -> Iterator[FurhatFake]:
    """Provide a robot."""
    with FurhatFake() as robot:
        yield robot


def furhat(fake: FurhatFake, language: str = "en", **settings: object) -> Furhat:
    """Return a client with short deadlines."""
    deadlines = {
        **dict.fromkeys(("connect_deadline_ms", "answer_deadline_ms", "speech_deadline_min_ms"), DEADLINE_MS),
        "speech_deadline_ms_per_char": 1,
    }
    given = {"host": "127.0.0.1", "port": fake.port, **deadlines, **settings}
    return Furhat(RobotSettings.model_validate(given), language)


def saying(text: str, started: Callable[[], None] = lambda: None) -> Utterance:
    """Return a sentence."""
    return Utterance(text, started)


CALLS: dict[str, Callable[[Furhat], object]] = {
    "probe": Furhat.health_check,
    "voices": Furhat.voices,
    "gestures": Furhat.gestures,
    "users": Furhat.users,
    "voice": lambda robot: robot.speak_with(RobotVoice("Amy", "en-GB")),
    "say": lambda robot: robot.say(saying("Hello")),
    "stop_speech": Furhat.stop_speech,
    "confused": lambda robot: robot.express(Mood.CONFUSED),
}


def test_at_connect_it_is_given_the_first_voice_of_the_language(fake: FurhatFake) -> None:
    assert furhat(fake, "it").connect().voice == RobotVoice("Bianca", "it-IT")
    assert fake.voice == "Bianca"


def test_a_voice_can_be_wished_for_by_name(fake: FurhatFake) -> None:
    furhat(fake, "en", voice="Amy").connect()
    assert fake.voice == "Amy"


def test_a_robot_without_a_voice_of_the_language_is_not_used() -> None:
    with FurhatFake(voices={"Astrid": "sv-SE"}) as fake, pytest.raises(RobotError, match="it has sv-SE") as failed:
        furhat(fake, "es").connect()
    assert failed.value.kind is FailureKind.NO_VOICE


def test_it_is_given_a_voice_of_each_visitors_language(fake: FurhatFake) -> None:
    robot = furhat(fake, "en")
    robot.connect()
    robot.set_language("it")
    assert fake.voice == "Bianca"
    robot.connect()
    assert fake.voice == "Bianca"


def test_a_language_that_it_lacks_is_lost_to_one_visitor_only(fake: FurhatFake) -> None:
    robot = furhat(fake, "it")
    robot.connect()
    with pytest.raises(RobotError) as failed:
        robot.set_language("fi")
    assert failed.value.kind is FailureKind.NO_VOICE
    assert robot.connect().voice == RobotVoice("Bianca", "it-IT")


@pytest.mark.parametrize("language", ["en", "en-US", "en_GB", "EN-au"])
def test_a_language_is_known_however_it_is_written(language: str) -> None:
    assert chosen_voice((RobotVoice("X", "enm"), RobotVoice("Y", language)), "en").name == "Y"


@pytest.mark.parametrize(
    ("language", "name"), [("no", "Liv"), ("zh", "Zhiyu"), ("pt-BR", "Camila"), ("pt", "Ines"), ("en-GB", "Amy")]
)
def test_the_nearest_voice_is_chosen(language: str, name: str) -> None:
    told = {"Nog": "nog", "Liv": "nb-NO", "Zhiyu": "cmn-CN", "Ines": "pt", "Camila": "pt_BR", "Joey": "en-US"}
    voices = tuple(RobotVoice(each, code) for each, code in (told | {"Amy": "en-GB"}).items())
    assert chosen_voice(voices, language).name == name


def test_after_every_reconnection_the_voice_is_set_again(fake: FurhatFake) -> None:
    robot = furhat(fake)
    robot.connect()
    fake.restart()
    assert fake.voice is None
    robot.connect()
    assert fake.voice == "Matthew"


def test_it_asks_only_for_what_the_robot_takes(fake: FurhatFake) -> None:
    robot = furhat(fake)
    robot.connect()
    for mood in Mood:
        robot.express(mood)
    robot.look_at(None)
    robot.look_at(BoardPoint(0.25, 1))
    robot.say(saying("Try row 2 & <the owl>\u2069"))
    robot.stop_speech()
    assert robot.users() == 1
    assert fake.refusals == []
    assert fake.sentences == ["Try row 2 the owl"]


def test_a_mood_becomes_a_gesture_that_the_robot_offers_or_none(fake: FurhatFake) -> None:
    fake.gestures = {"Smile": 1.04}
    robot = furhat(fake)
    robot.connect()
    for mood in (Mood.HAPPY, Mood.SAD, Mood.IDLE):
        robot.express(mood)
    assert [asked.parameters["name"] for asked in fake.asked("/furhat/gesture")] == ["Smile"]


def test_a_sentence_is_said_when_it_has_been_heard_to_its_end() -> None:
    with FurhatFake(character_ms=5) as fake:
        begun = monotonic()
        furhat(fake).say(saying("x" * 20))
        assert monotonic() - begun >= 0.1


def test_speech_starts_when_the_request_is_out(fake: FurhatFake) -> None:
    fake.mode = Mode.HANG
    started = threading.Event()
    with pytest.raises(RobotError):
        furhat(fake).say(saying("Hello", started.set))
    assert started.is_set()


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize("mode", FAULTS, ids=lambda mode: mode.name.lower())
def test_whatever_goes_wrong_is_a_failure_before_the_deadline(
    fake: FurhatFake, mode: Mode, call: Callable[[Furhat], object]
) -> None:
    fake.mode = mode
    begun = monotonic()
    with pytest.raises(RobotError):
        call(furhat(fake))
    assert monotonic() - begun < DEADLINE_MS / 1000 + SPARE_S


@pytest.mark.parametrize(
    ("mode", "fault"),
    [
        (Mode.REFUSE, FailureKind.UNREACHABLE),
        (Mode.HANG, FailureKind.SLOW),
        (Mode.SLOW, FailureKind.SLOW),
        (Mode.TRICKLE, FailureKind.SLOW),
        (Mode.CLIENT_ERROR, FailureKind.DECLINED),
        (Mode.BARE_CLIENT_ERROR, FailureKind.ERROR),
        (Mode.SERVER_ERROR, FailureKind.ERROR),
        (Mode.UNSUCCESSFUL, FailureKind.DECLINED),
        (Mode.GARBAGE, FailureKind.GARBAGE),
        (Mode.PAGE, FailureKind.GARBAGE),
        (Mode.DROP, FailureKind.DROPPED),
        (Mode.RESET, FailureKind.DROPPED),
    ],
    ids=lambda value: value.name.lower(),
)
def test_a_failure_says_what_went_wrong(fake: FurhatFake, mode: Mode, fault: FailureKind) -> None:
    fake.mode = mode
    with pytest.raises(RobotError) as failed:
        furhat(fake).say(saying("Hello"))
    assert failed.value.kind is fault
    assert str(failed.value).startswith(f"the robot {fault.value} (POST /furhat/say")


@pytest.mark.parametrize("mode", FAULTS, ids=lambda mode: mode.name.lower())
def test_a_sentence_is_sent_once_whatever_becomes_of_it(fake: FurhatFake, mode: Mode) -> None:
    fake.arm(mode, path="/furhat/say")
    with pytest.raises(RobotError):
        furhat(fake).say(saying("Hello"))
    assert len(fake.sentences) == 1


def test_nobody_to_look_at_is_no_failure(fake: FurhatFake) -> None:
    fake.mode = Mode.UNSUCCESSFUL
    furhat(fake).look_at(None)
    fake.mode = Mode.SERVER_ERROR
    with pytest.raises(RobotError):
        furhat(fake).look_at(None)


@pytest.mark.parametrize("success", ['"true"', "1", "null"])
def test_only_true_counts_as_true(fake: FurhatFake, success: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kiosk.robots.furhat_pretended.json.dumps", lambda _: f'{{"success": {success}}}')
    with pytest.raises(RobotError) as failed:
        furhat(fake).stop_speech()
    assert failed.value.kind is FailureKind.GARBAGE


def test_a_sentence_that_is_cut_is_waited_for_no_longer(fake: FurhatFake) -> None:
    fake.mode = Mode.HANG
    under_way = saying("Hello")
    robot = furhat(fake, speech_deadline_min_ms=60_000)
    failures: list[RobotError] = []

    def say() -> None:
        with pytest.raises(RobotError) as failed:
            robot.say(under_way)
        failures.append(failed.value)

    thread = threading.Thread(target=say, daemon=True)
    thread.start()
    fake.wait_until(lambda: fake.sentences)
    under_way.cancel()
    thread.join(SPARE_S)
    assert [failure.kind for failure in failures] == [FailureKind.CUT]


def test_a_sentence_that_was_cut_before_it_was_sent_is_not_waited_for(fake: FurhatFake) -> None:
    fake.mode = Mode.HANG
    cut = saying("Hello")
    cut.cancel()
    with pytest.raises(RobotError) as failed:
        furhat(fake, speech_deadline_min_ms=60_000).say(cut)
    assert failed.value.kind is FailureKind.CUT


def test_an_answer_without_an_end_is_garbage() -> None:
    listening = socket.create_server(("127.0.0.1", 0))
    listening.settimeout(PATIENCE_S)

    def pour() -> None:
        connection, _ = listening.accept()
        with connection, suppress(OSError):
            connection.recv(10_000)
            connection.sendall(b"HTTP/1.1 200 OK\r\n\r\n")
            while True:
                connection.sendall(b"[" * 100_000)

    thread = threading.Thread(target=pour, daemon=True)
    thread.start()
    settings = RobotSettings(host="127.0.0.1", port=listening.getsockname()[1])
    with listening, pytest.raises(RobotError) as failed:
        Furhat(settings, "en").voices()
    thread.join(SPARE_S)
    assert failed.value.kind is FailureKind.GARBAGE


def test_a_name_that_nobody_knows_cannot_be_reached() -> None:
    with pytest.raises(RobotError) as failed:
        Furhat(RobotSettings(host="no such robot"), "en").connect()
    assert failed.value.kind is FailureKind.UNREACHABLE


@pytest.mark.parametrize(
    ("axes", "there"),
    [("x y z", "0.20,-0.08,0.50"), ("-x y z", "-0.20,-0.08,0.50"), ("y z -x", "-0.50,0.20,-0.08")],
)
def test_the_hinted_place_is_told_along_the_robots_own_axes(fake: FurhatFake, axes: str, there: str) -> None:
    furhat(fake, axes=axes, board_middle=(0.4, -0.2, 0.5), board_size=(0.4, 0.24)).look_at(BoardPoint(0, 0))
    assert fake.requests[-1].parameters == {"location": there}


def test_gestures_and_gaze_can_be_switched_off(fake: FurhatFake) -> None:
    robot = furhat(fake, gestures=False, gaze=False)
    robot.express(Mood.HAPPY)
    robot.look_at(None)
    assert fake.requests == []


@pytest.mark.parametrize(
    ("sentence", "said"),
    [
        ("12\N{NO-BREAK SPACE}pairs", "12 pairs"),
        ("می\N{ZERO WIDTH NON-JOINER}خواهم", "می\N{ZERO WIDTH NON-JOINER}خواهم"),
        ("one\ntwo\x07<b>", "one two b"),
    ],
)
def test_a_sentence_loses_markup_and_control_characters_and_no_others(sentence: str, said: str) -> None:
    assert speakable(sentence) == said


def test_a_very_long_text_is_cut_at_a_word() -> None:
    text = speakable("word " * 400)
    assert len(text) < 1000
    assert text.endswith("word")


CLIP = SpokenClip(
    b"RIFF and so on", 40, {"engine": "pico", "engine_version": "0.1", "voice": "en-US", "pack": "a hash"}
)


PATIENT = dict.fromkeys(("connect_deadline_ms", "answer_deadline_ms", "speech_deadline_min_ms"), 60_000)
"""Deadlines that a busy machine keeps, for robots that do answer."""


def with_clips(fake: FurhatFake, **settings: int) -> tuple[Furhat, list[str]]:
    """Return a robot that plays a clip for every sentence but one, and the reasons why it did not."""
    robot, reasons = furhat(fake, "en", pack=True, **settings), list[str]()
    robot.clips = lambda language, text: CLIP if (language, text) != ("en", "No clip") else None
    robot.on_own_voice = reasons.append
    robot.connect()
    return robot, reasons


def test_a_clip_is_fetched_and_played_in_place_of_the_robots_voice_and_the_record_says_whose_it_is(
    fake: FurhatFake,
) -> None:
    robot, reasons = with_clips(fake, **PATIENT)
    started: list[object] = []
    robot.say(saying("Try row 2", lambda: started.append(dict(robot.spoken_by))))
    assert fake.played == [CLIP.wav]
    assert fake.sentences == []
    assert started == [{**CLIP.spoken_by, "device": "furhat"}]
    robot.say(saying("No clip"))
    assert fake.sentences == ["No clip"]
    assert robot.spoken_by == {}
    assert (fake.refusals, reasons) == ([], [])


@pytest.mark.parametrize("mode", [Mode.WELL, Mode.UNSUCCESSFUL, Mode.HANG])
def test_a_robot_that_cannot_fetch_a_clip_says_so_once_and_goes_on_with_its_own_voice(
    fake: FurhatFake, mode: Mode
) -> None:
    robot, reasons = with_clips(fake)
    fake.fetches = False
    fake.mode = mode
    started: list[str] = []

    def mend(why: str) -> None:
        reasons.append(why)
        fake.mode = Mode.WELL

    robot.on_own_voice = mend
    robot.say(saying("One", lambda: started.append("One")))
    robot.say(saying("Two", lambda: started.append("Two")))
    assert fake.sentences == ["One", "Two"]
    assert started == ["One", "Two"]
    assert [why.startswith("it did not fetch the clip") for why in reasons] == [True]
    assert robot.spoken_by == {}
    fake.fetches = True
    robot.connect()
    robot.say(saying("Three"))
    assert fake.played == [CLIP.wav]


def test_a_sentence_that_is_cut_while_its_clip_is_waited_for_is_not_said_with_another_voice(fake: FurhatFake) -> None:
    robot, reasons = with_clips(fake, **PATIENT)
    fake.mode = Mode.HANG
    sentence = saying("Try row 2")

    def cut() -> None:
        fake.wait_until(lambda: fake.asked("/furhat/say"))
        sentence.cancel()

    threading.Thread(target=cut, daemon=True).start()
    with pytest.raises(RobotError) as failed:
        robot.say(sentence)
    assert failed.value.kind is FailureKind.CUT
    assert (fake.sentences, reasons) == ([], [])


def test_a_port_that_is_taken_leaves_the_robot_its_own_voice(fake: FurhatFake) -> None:
    robot, reasons = with_clips(fake, pack_port=fake.port)
    robot.say(saying("Try row 2"))
    assert fake.sentences == ["Try row 2"]
    assert "the clip cannot be served" in reasons[0]


def answer_of(url: str, verb: str = "GET") -> int:
    """Return the code that is answered to a request."""
    with requests.request(verb, url, timeout=5) as answer:
        return answer.status_code


def test_a_clip_is_served_at_one_path_only_and_no_longer_than_it_is_said() -> None:
    fetched: list[str] = []
    with ClipServer(CLIP.wav, "127.0.0.1", 0, lambda: fetched.append("")) as served:
        base = served.url.rsplit("/", 1)[0]
        for path in ("/", "/clip.wav", "/../pack.json", f"{served.path}/..", f"{served.path}?a=b"):
            assert answer_of(base + path) == 404
        assert answer_of(served.url, "POST") == 501
        assert answer_of(served.url, "HEAD") == 200
        assert (fetched, served.is_fetched) == ([], False)
        with requests.get(served.url, timeout=5) as answer:
            assert (answer.headers["Content-Type"], answer.content) == ("audio/wav", CLIP.wav)
        assert answer_of(served.url) == 200
        assert fetched == [""]
    with pytest.raises(requests.ConnectionError):
        answer_of(served.url)


def test_a_clip_is_refused_to_every_address_but_the_robots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kiosk.robots.clip_server.own_address", lambda _: "127.0.0.1")
    with ClipServer(CLIP.wav, "192.0.2.7", 0, lambda: None) as served:
        with pytest.raises(requests.ConnectionError):
            answer_of(served.url)
        assert not served.is_fetched


def test_a_study_that_asks_a_robot_for_clips_that_cannot_play_them_is_refused() -> None:
    settings = RobotSettings.model_validate({"kind": "furhat-realtime", "pack": True})
    with pytest.raises(UserInputError, match=r"robot\.pack: the driver furhat-realtime cannot have"):
        create_robot(settings, "en")
