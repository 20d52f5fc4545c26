"""Film a replay: the screens with captions, the reasons of the help, and what a model says is remembered."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QCoreApplication, QRect
from PySide6.QtGui import QImage, QPainter

from kiosk import UserInputError
from kiosk.assistance.policy import PRAISE, ActionSpec, GateDecision
from kiosk.assistance.wording import Catalogue
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event, HintCue, RemarkTrigger
from kiosk.experiment.memory_replay import BoardMemory, MemoryFollower
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.replay import ReplayStep
from kiosk.files import check_writable, write_file
from kiosk.ui.memory_view import AMBER, FAINT, INK, LINE, MARGIN, PAPER, Style, draw_memory, memory_width, write
from kiosk.ui.replay import Replay, changes_screen
from kiosk.units import MS_PER_SECOND, SECONDS_PER_MINUTE

if TYPE_CHECKING:
    from av import VideoFrame, VideoStream

FRAMES_PER_SECOND = 10
WIDTH, HEIGHT = 1280, 720
"""Of the screens; the captions stand below."""
CAPTIONS, WITH_MEMORY = 96, 176
"""How high the captions are, without and with the memory."""
LEFT_OUT_MS = 2_000
"""How long the film says that something is left out."""
PERSONAL = frozenset({Stage.AGE, Stage.CONSENT, Stage.ABOUT_YOU, Stage.QUESTIONS})
"""Stages whose screens show what a visitor answers and types; a film leaves them out."""

_FORMATS = {
    ".webm": ("webm", "libvpx-vp9", {"deadline": "realtime", "cpu-used": "8", "crf": "32", "b": "0"}),
    ".mp4": ("mp4", "libx264", {"preset": "veryfast", "crf": "23", "movflags": "+faststart"}),
}

_BOLD, _MIDDLE = Style(bold=True), Style(32, middle=True)
_GATES = {
    GateDecision.OPENING: "film-gate-opening",
    GateDecision.DOING_WELL: "film-gate-doing-well",
    GateDecision.STILL_EXPLORING: "film-gate-still-exploring",
}


def check_film(out: Path) -> None:
    """Raise UserInputError if no film can be written there, before anything is done."""
    if out.suffix.lower() not in _FORMATS:
        raise UserInputError(f"a film is a .webm or .mp4 file, but {out} is neither")
    if find_spec("av") is None:
        raise UserInputError("a film needs PyAV: pip install 'recollect[film]'")
    check_writable(out)


def write_film(
    played: Replay,
    catalogue: Catalogue,
    out: Path,
    *,
    memory: bool = False,
    tell: Callable[[int], None] = lambda _: None,
) -> float:
    """Write the film of a replay that stands at its beginning, and return its length in seconds.

    With ``memory`` it shows how likely each card is remembered. ``tell`` is called with the number of steps so far.
    Raises UserInputError or StorageError if it cannot be written; what was there stays then.
    """
    captions = Captions(catalogue, memory=memory)
    film = _Film(out.suffix.lower(), HEIGHT + captions.height, played.beat)
    for picture, ms in _pictures(played, captions, tell):
        film.add(picture, ms)
    write_file(out, film.finish())
    return film.frames / FRAMES_PER_SECOND


def _pictures(played: Replay, captions: Captions, tell: Callable[[int], None]) -> Iterator[tuple[QImage, float]]:
    """Yield every picture with how long it is shown (ms)."""
    played.hide_controls()
    played.window.resize(WIDTH, HEIGHT)
    # The screens are laid out anew once the window has its size.
    QCoreApplication.processEvents()
    player = played.player
    screen, stage, at_ms = played.window.grabWindow(), Stage.ATTRACT, 0
    for step in player.steps:
        if stage not in PERSONAL:
            yield captions.below(screen, at_ms), (step.event.at_ms - at_ms) / player.speed
        player.step()
        tell(player.played)
        captions.follow(step)
        if step.stage in PERSONAL and stage not in PERSONAL:
            yield captions.left_out(), LEFT_OUT_MS
        if step.stage not in PERSONAL and changes_screen(step):
            screen = played.window.grabWindow()
        stage, at_ms = step.stage, step.event.at_ms
    if stage not in PERSONAL:
        yield captions.below(screen, at_ms), MS_PER_SECOND


class Captions:
    """What stands below the screens at a moment of the session."""

    def __init__(self, catalogue: Catalogue, *, memory: bool) -> None:
        self.height = WITH_MEMORY if memory else CAPTIONS
        self._catalogue = catalogue
        self._memory = MemoryFollower() if memory else None
        self.said = ""
        """The sentence that is being said."""
        self.reason = ""
        """Why there was help before the coming flip, or none."""

    def follow(self, step: ReplayStep) -> None:
        """Take note of what a step led to."""
        if isinstance(step.event, happened.SpeechFinished | happened.SpeechFailed):
            self.said = ""
        for effect in step.outcome.effects:
            if isinstance(effect, do.Speak):
                self.said = effect.sentence
        for event in step.outcome.events:
            self._note(event)
        if step.stage not in {Stage.PRACTICE, Stage.GAME}:
            self.reason = ""
        if self._memory is not None:
            self._memory.follow(step)

    def _note(self, event: Event) -> None:
        match event:
            case happened.BoardDealt() | happened.CardFlipped():
                self.reason = ""
            case happened.AssistanceDecided():
                self.reason = self._no_hint(event)
            case happened.HintGiven():
                self.reason = self._hint(event)
            case happened.RemarkGiven():
                self.reason = self._catalogue.text(_comment(event))

    def _no_hint(self, decided: happened.AssistanceDecided) -> str:
        if not decided.gate.is_open:
            return self._catalogue.text(_GATES[decided.gate])
        return self._catalogue.text("film-no-hint") if decided.action is ActionSpec.NO_HELP else ""

    def _hint(self, hint: happened.HintGiven) -> str:
        places = {"row": hint.row, "column": hint.column}
        told = {name: number + 1 for name, number in places.items() if number is not None}
        # A hint that tells both is about one card.
        how = "film-look" if hint.cue is HintCue.GAZE else "film-hint"
        message = "-".join((how, *(("card",) if len(told) == len(places) else told)))
        counts = self._catalogue.text("film-counts", seen=hint.seen, other=hint.mate_seen)
        return f"{self._catalogue.text(message, **told)} {counts}"

    @property
    def remembered(self) -> BoardMemory | None:
        """How likely each card is recalled; None without a board, or where it is not asked for."""
        return None if self._memory is None else self._memory.now

    def below(self, screen: QImage, at_ms: int) -> QImage:
        """Return the screen with the captions of this moment below it."""
        picture = self._empty()
        with QPainter(picture) as painter:
            painter.drawImage(QRect(0, 0, WIDTH, HEIGHT), screen)
            minutes, seconds = divmod(at_ms // MS_PER_SECOND, SECONDS_PER_MINUTE)
            write(painter, f"{minutes}:{seconds:02}", QRect(MARGIN, HEIGHT + 8, 80, LINE), FAINT)
            room = WIDTH - 2 * MARGIN - 80 - self._draw_memory(painter)
            lines = QRect(MARGIN + 80, HEIGHT + 8, room, (self.height - 16) // 2)
            write(painter, self.said, lines, PAPER, _BOLD)
            write(painter, self.reason, lines.translated(0, lines.height()), AMBER)
        return picture

    def left_out(self) -> QImage:
        """Return what stands for a stage that is left out."""
        picture = self._empty()
        with QPainter(picture) as painter:
            whole = QRect(0, 0, WIDTH, HEIGHT)
            write(painter, self._catalogue.text("film-left-out"), whole, PAPER, _MIDDLE)
        return picture

    def _empty(self) -> QImage:
        picture = QImage(WIDTH, HEIGHT + self.height, QImage.Format.Format_RGBA8888)
        picture.fill(INK)
        return picture

    def _draw_memory(self, painter: QPainter) -> int:
        """Draw the memory at the right, and return how much room it takes."""
        memory = self.remembered
        if memory is None:
            return 0
        width = memory_width(memory.board)
        room = QRect(WIDTH - MARGIN - width, HEIGHT + 8, width, self.height - 16)
        draw_memory(painter, memory, self._catalogue.text("film-memory"), room)
        return width + MARGIN


def _comment(remark: happened.RemarkGiven) -> str:
    """Return the message that tells what a remark is about."""
    if remark.trigger is RemarkTrigger.DECISION:
        return "film-remark"
    return "film-praise" if remark.action is PRAISE else "film-encouragement"


class _Film:
    """A film as it is made, in memory."""

    def __init__(self, suffix: str, height: int, beat: Callable[[], None]) -> None:
        import av  # noqa: PLC0415 - an extra, which other commands do without

        kind, codec, options = _FORMATS[suffix]
        self.frames = 0
        """How many there are so far."""
        self._beat = beat
        self._ms = 0.0
        self._file = BytesIO()
        self._container = av.open(self._file, "w", format=kind)
        self._stream = cast("VideoStream", self._container.add_stream(codec, rate=FRAMES_PER_SECOND, options=options))
        self._stream.width, self._stream.height, self._stream.pix_fmt = WIDTH, height, "yuv420p"

    def add(self, picture: QImage, ms: float) -> None:
        """Show a picture for so long; what is shorter than a frame may not be seen."""
        self._ms += ms
        until = round(self._ms * FRAMES_PER_SECOND / MS_PER_SECOND)
        if until > self.frames:
            frame = _frame(picture)
            for number in range(self.frames, until):
                self._beat()
                frame.pts = number
                self._container.mux(self._stream.encode(frame))
            self.frames = until

    def finish(self) -> bytes:
        """Return the whole file."""
        self._container.mux(self._stream.encode(None))
        self._container.close()
        return self._file.getvalue()


def _frame(picture: QImage) -> VideoFrame:
    from av import VideoFrame  # noqa: PLC0415 - as above

    pixels = bytes(picture.constBits())
    return VideoFrame.from_bytes(pixels, picture.width(), picture.height(), "rgba").reformat(format="yuv420p")
