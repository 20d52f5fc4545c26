"""What a replay shows below the screens: where it is, and the keys that drive it."""

from __future__ import annotations

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.study.after.replay import Step
from kiosk.ui.replaying.player import Player
from kiosk.units import MS_PER_SECOND, SECONDS_PER_MINUTE

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

FASTER = 2.0


@QmlElement
class ReplayBar(QObject):
    """The player, as QML sees it."""

    changed = Signal()
    left = Signal()
    """Whoever watches has seen enough."""

    def __init__(self, title: str, player: Player, parent: QObject | None = None) -> None:
        """``title`` says which sitting it is."""
        super().__init__(parent)
        self._title = title
        self._player = player
        player.changed = self.changed.emit

    @Property(str, constant=True)
    def title(self) -> str:
        """Which sitting it is."""
        return self._title

    @Property(str, notify=changed)
    def place(self) -> str:
        """The time since the sitting began, the stage, and what happened last."""
        return _place(self._player.last)

    @Property(str, notify=changed)
    def speed(self) -> str:
        """How many times as fast as then."""
        return f"{self._player.speed:g} x"

    @Property(bool, notify=changed)
    def runs(self) -> bool:
        """Whether it goes on by itself."""
        return self._player.runs

    @Property(bool, notify=changed)
    def differs(self) -> bool:
        """Whether the step at hand comes out otherwise today than it was recorded."""
        return self._player.last is not None and not self._player.last.agrees

    @Property(int, notify=changed)
    def played(self) -> int:
        """How many steps have been played."""
        return self._player.played

    @Property(int, constant=True)
    def steps(self) -> int:
        """How many steps there are."""
        return len(self._player.steps)

    @Slot()
    def toggle(self) -> None:
        """Go on, or stay."""
        if self._player.runs:
            self._player.pause()
        else:
            self._player.run()

    @Slot()
    def step(self) -> None:
        """One step on."""
        self._player.step()

    @Slot()
    def back(self) -> None:
        """One step back."""
        self._player.pause()
        self._player.go_to(self._player.played - 1)

    @Slot(int)
    def seek(self, played: int) -> None:
        """To this step."""
        self._player.go_to(played)

    @Slot()
    def faster(self) -> None:
        """Twice as fast."""
        self._player.change_speed(FASTER)

    @Slot()
    def slower(self) -> None:
        """Half as fast."""
        self._player.change_speed(1 / FASTER)

    @Slot()
    def leave(self) -> None:
        """Enough."""
        self.left.emit()


def _place(step: Step | None) -> str:
    if step is None:
        return "0:00.0"
    minutes, seconds = divmod(step.event.at_ms / MS_PER_SECOND, SECONDS_PER_MINUTE)
    return f"{minutes:.0f}:{seconds:04.1f}   {step.stage.value}   {step.seq} {type(step.event).__name__}"
