"""The settings of what is connected: voice, robot, broker and recorders of markers."""

from __future__ import annotations

import re
from ipaddress import IPv6Address
from typing import Annotated, Any

from pydantic import (
    Field,
    field_validator,
)

from kiosk.config.models import MOST_CHARACTERS, MOST_QUOTED, ConfigModel, Metres, Milliseconds, PerCharacter, Size
from kiosk.units import Unit

VOICE_ENGINES = ("pico", "hibari", "system")


class VoiceConfig(ConfigModel):
    """The avatar's voice."""

    enabled: Annotated[bool, Field(description="Whether sentences are spoken as well as shown.")] = True
    speakers: Annotated[
        dict[str, Annotated[str, Field(min_length=1, max_length=MOST_CHARACTERS)]],
        Field(
            description="Who speaks each language: an engine ('pico', 'hibari' or 'system', the system's voices), or "
            "the folder of a voice pack; by default the best engine that is installed."
        ),
    ] = {}
    rate: Annotated[
        int, Unit("words per minute"), Field(ge=80, le=300, description="How fast it speaks; 110 is slow.")
    ] = 150
    volume: Annotated[float, Field(ge=0, le=1, description="How loud it speaks, 0 to 1.")] = 0.9
    sounds: Annotated[
        bool,
        Field(
            description="Whether cards and buttons are heard: short sounds as loud as the voice, never during speech."
        ),
    ] = True
    device: Annotated[
        str,
        Field(
            max_length=MOST_CHARACTERS,
            description="The sound device, by its name or a part of it; empty: the system's own. 'null' is heard by "
            "no one.",
        ),
    ] = ""


NO_ROBOT = "none"
"""The kind of robot of a study in which the avatar helps alone."""

_HOST = re.compile(r"[\w-]{1,63}(\.[\w-]{1,63})*\.?")

_URL = re.compile(r"[a-z][a-z0-9+.-]*://(.*)", re.IGNORECASE | re.DOTALL)


def host_fault(host: str) -> str | None:
    """Say why this is no host, and what to write instead; return None if it is one."""
    if not host.strip():
        return "it is empty; write the robot's name or address, such as '192.168.0.20'"
    url = _URL.fullmatch(host)
    rest = (url[1] if url else host).partition("/")[0]
    _, at, rest = rest.rpartition("@")
    name, colon, port = rest.rpartition(":")
    has_port = bool(colon and port.isdecimal() and (_HOST.fullmatch(name) or name.endswith("]")))
    if not has_port:
        name = rest
    name = name.removeprefix("[").removesuffix("]")
    if name == host and (_HOST.fullmatch(host) or _is_ipv6(host)):
        return None
    what = "a web address" if url else "a user and a host" if at else "a host and a port" if has_port else "no host"
    if not (_HOST.fullmatch(name) or _is_ipv6(name)):
        return f"{host[:MOST_QUOTED]!r} is {what}; write the robot's name or address, such as '192.168.0.20'"
    return f"{host[:MOST_QUOTED]!r} is {what}; write {name!r}" + (f", and {port} as the port" if has_port else " alone")


def _is_ipv6(text: str) -> bool:
    address, _, _ = text.partition("%")
    try:
        IPv6Address(address)
    except ValueError:
        return False
    return True


class RobotConfig(ConfigModel):
    """The robot that speaks in the avatar's place, if there is one; all times in milliseconds, all lengths in metres.

    ``board_middle`` and ``board_size`` are told as the robot sees them: sideways, up, and forward.
    """

    kind: Annotated[str, Field(description="Which robot, by the name of its driver, or none: the avatar alone.")] = (
        NO_ROBOT
    )
    host: Annotated[str, Field(min_length=1, description="Its name or address on the network.")] = "localhost"
    port: Annotated[
        int | None, Field(ge=1, le=65535, description="Its port; by default the one that its driver names.")
    ] = None
    key: Annotated[
        str, Field(exclude=True, description="The key or password that it asks for, if any; never recorded.")
    ] = ""
    options: Annotated[
        dict[str, Any], Field(description="What only this driver knows, by its own names; see the driver's page.")
    ] = {}
    voice: Annotated[str, Field(description="Its voice by name; by default the first one of the language.")] = ""
    pack: Annotated[
        bool,
        Field(
            description="Whether it plays the clips of the avatar's voice pack, so that both sound the same; each is "
            "served over HTTP to the robot's address alone, while the robot says it."
        ),
    ] = False
    pack_port: Annotated[
        int | None,
        Field(ge=1, le=65535, description="The port of this machine that it fetches them from; by default a free one."),
    ] = None
    connect_deadline_ms: Annotated[Milliseconds, Field(description="The longest that reaching it may take.")] = 1000
    answer_deadline_ms: Annotated[
        Milliseconds, Field(description="The longest that any answer but speech may take.")
    ] = 1500
    speech_deadline_ms_per_char: Annotated[
        PerCharacter, Field(description="The longest that it may take to say a sentence, per character.")
    ] = 110
    speech_deadline_min_ms: Annotated[Milliseconds, Field(description="The same, whatever its length.")] = 3500
    heartbeat_ms: Annotated[
        Milliseconds, Field(description="While it speaks, how often to see if it still answers.")
    ] = 1000
    health_check_ms: Annotated[Milliseconds, Field(description="Between sessions, how often to see if it is well.")] = (
        10_000
    )
    backoff_initial_ms: Annotated[
        Milliseconds, Field(description="The first pause before a lost robot is tried again.")
    ] = 2000
    backoff_max_ms: Annotated[Milliseconds, Field(description="The longest such pause; each is twice the last.")] = (
        120_000
    )
    gestures: Annotated[bool, Field(description="Whether it shows moods with its face.")] = True
    gaze: Annotated[bool, Field(description="Whether it looks at the player, and at the hinted place.")] = True
    axes: Annotated[
        str,
        Field(
            description="Its axes for sideways (the visitor's right), up and forward, each with a minus if reversed."
        ),
    ] = "x y z"
    board_middle: Annotated[
        tuple[Metres, Metres, Metres],
        Unit("m"),
        Field(strict=False, description="Where the middle of the board is, seen from its eyes."),
    ] = (0.4, -0.2, 0.5)
    board_size: Annotated[
        tuple[Size, Size],
        Unit("m"),
        Field(strict=False, description="How wide and how high the board is on the screen."),
    ] = (0.4, 0.25)

    @field_validator("axes")
    @classmethod
    def _name_every_axis(cls, axes: str) -> str:
        if sorted(axis.removeprefix("-") for axis in axes.split(" ")) != ["x", "y", "z"]:
            raise ValueError(f"{axes!r} does not name x, y and z once each, such as 'x -z y'")
        return axes

    def speech_time(self, sentence: str) -> int:
        """How long it may take to say a sentence, in ms."""
        return max(self.speech_deadline_min_ms, self.speech_deadline_ms_per_char * len(sentence))


_PORTS = {"mqtt": 1883, "mqtts": 8883}


def read_broker(text: str) -> tuple[str, int, bool]:
    """Read an address such as ``mqtts://broker.lab.example:8883``: the host, the port, and whether TLS is used.

    Raises ValueError for anything else.
    """
    found = re.fullmatch(r"(mqtts?)://([\w.-]+|\[[0-9a-fA-F:.]+\])(?::([0-9]{1,5}))?/?", text, re.ASCII)
    port = int(found[3] or _PORTS[found[1]]) if found else 0
    if found is None or not 0 < port <= 65_535:  # noqa: PLR2004 - the highest port
        raise ValueError(f"{text!r} is no broker's address, such as 'mqtts://broker.lab.example:8883'")
    return found[2].strip("[]"), port, found[1] == "mqtts"


class Remote(ConfigModel):
    """Where the booth's status is published, so that you can watch it from afar.

    It is off as long as ``mqtt`` is empty. Of this section nothing is recorded.
    """

    mqtt: Annotated[
        str,
        Field(description="The MQTT broker: mqtts://HOST or, without TLS, mqtt://HOST. Empty: nothing is published."),
    ] = ""
    booth: Annotated[
        str,
        Field(
            pattern=r"^[A-Za-z0-9._-]{0,64}$",
            description="What this booth is called there; by default its site, or the machine's name.",
        ),
    ] = ""
    topic: Annotated[
        str,
        Field(pattern=r"^[A-Za-z0-9._/-]{1,100}$", description="What its topic begins with; the booth's name follows."),
    ] = "recollect"
    user: Annotated[str, Field(max_length=MOST_CHARACTERS, description="The user's name at the broker, if any.")] = ""
    password_file: Annotated[str, Field(description="A file with the password alone; a path.")] = ""
    ca: Annotated[
        str, Field(description="The certificate of the broker's authority; a path. Empty: those of the system.")
    ] = ""
    certificate: Annotated[str, Field(description="A certificate by which the broker knows the booth; a path.")] = ""
    key: Annotated[str, Field(description="The key of that certificate; a path.")] = ""

    @field_validator("mqtt")
    @classmethod
    def _name_a_broker(cls, text: str) -> str:
        if text:
            read_broker(text)
        return text


class MarkersConfig(ConfigModel):
    """Whether the moments of a session go to recorders of gaze or EEG."""

    lsl: Annotated[
        bool,
        Field(description="Sends a marker of every recorded event to the Lab Streaming Layer; needs the extra 'lsl'."),
    ] = False
    stream: Annotated[
        str, Field(min_length=1, max_length=MOST_CHARACTERS, description="What the stream of markers is called.")
    ] = "Recollect"
