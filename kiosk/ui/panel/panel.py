"""The panel: opens for whoever has the PIN, looks at everything once a second, and closes when nobody is at it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict

from kiosk.assistant.wording import Catalogue
from kiosk.store.glance import Glance
from kiosk.study.booth.deeds import Deed, Effect, rule
from kiosk.study.booth.notes import Note
from kiosk.study.events import BodyName, PauseEnded, Stage
from kiosk.ui.clock import Wait
from kiosk.ui.panel.asking import Asking
from kiosk.ui.panel.deeds import AUTOMATIC, Booth, Deeds, Writing
from kiosk.ui.panel.health import Line, State, lines, summary
from kiosk.ui.panel.rows import condition_name, rows
from kiosk.ui.panel.screen import PanelScreen, Row
from kiosk.ui.panel.upkeep import Upkeep

LOOK_MS = 1_000
RECORDS_EVERY = 10
"""Among so many looks there is one at the records: while the panel is open, they change by its own deeds alone."""

CLOSE_MS = 60_000
"""Without a hand on it for so long, the panel closes."""

LOUDNESS = (0.2, 0.4, 0.6, 0.8, 1.0)
"""The volumes to choose from."""


class Panel:
    """The panel at work."""

    def __init__(  # noqa: PLR0913, PLR0917 - all that it shows
        self,
        screen: PanelScreen,
        booth: Booth,
        deeds: Deeds,
        asking: Asking,
        upkeep: Upkeep,
        write: Writing,
        catalogue: Catalogue,
        state: Callable[[], State],
        look: Callable[[Callable[[Glance | str], None]], None],
    ) -> None:
        """``state`` tells how everything is now; ``look`` reads the records, and hands over what it found, soon."""
        self.changed: Callable[[], None] = lambda: None
        """Is told when the panel comes or goes."""
        self._screen = screen
        self._booth = booth
        self._deeds = deeds
        self._asking = asking
        self._upkeep = upkeep
        self._write = write
        self._catalogue = catalogue
        self._state = state
        self._look = look
        self._looking = False
        self._looks = 0
        self._unread = ""
        self._stirred_at = 0
        self._tick: Wait | None = None
        screen.speak({name: catalogue.text(name) for name in WORDS})
        screen.wished.connect(self._wish)
        deeds.toggle_panel = self.toggle
        deeds.changed = self._refresh
        upkeep.changed = self._refresh

    @property
    def is_open(self) -> bool:
        """Whether it is to be seen."""
        return self._screen.is_open

    def toggle(self) -> None:
        """Close it, or open it for whoever has the PIN."""
        if self.is_open:
            self.close()
        else:
            self._asking.ask(rule(Deed.PANEL, self._deeds.stage).asks, lambda _: self._open())

    def close(self) -> None:
        """Leave it; from now on the PIN is asked for again."""
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None
        self._asking.unlocked = False
        self._asking.cancel()
        self._screen.open(False)  # noqa: FBT003 - it is what is set
        self._booth.screens.kiosk.step_back(False)  # noqa: FBT003 - it is what is set
        self._deeds.panel_closed()
        self.changed()

    def stir(self) -> None:
        """Somebody is at it."""
        self._stirred_at = self._booth.clock.now_ms()

    def _open(self) -> None:
        self._write.keep(Note.PANEL_OPENED, {"stage": self._deeds.stage.value})
        self._asking.unlocked = True
        self._deeds.panel_opened()
        self.stir()
        self._looks = 0
        self._booth.screens.kiosk.step_back(True)  # noqa: FBT003 - it is what is set
        # All that it shows is there before it comes.
        self._screen.show_choices(self._choices())
        self._screen.open(True)  # noqa: FBT003 - it is what is set
        self._see()
        self.changed()

    def _wish(self, deed: str, choice: str) -> None:
        if deed == Deed.PANEL.value:
            self.close()
        else:
            self._deeds.wish(deed, choice)

    def _see(self) -> None:
        """Look at everything, and once more in a second."""
        if self._booth.clock.now_ms() - self._stirred_at >= CLOSE_MS:
            self.close()
            return
        if self._looks % RECORDS_EVERY == 0:
            self._refresh()
        else:
            self._show_health()
        self._looks += 1
        self._tick = self._booth.clock.after(LOOK_MS, self._see)

    def _refresh(self) -> None:
        """Look at everything, the records too."""
        if not self.is_open:
            return
        self._show_health()
        if not self._looking:
            self._looking = True
            self._look(self._have_looked)

    def _show_health(self) -> None:
        found = lines(self._state(), self._booth.desk.study, self._catalogue)
        if self._unread:
            found = (*found, Line(self._catalogue.text("desk-database"), self._unread, well=False))
        whole = summary(found, self._catalogue)
        self._screen.show_health(
            {"well": whole.well, "summary": whole.words, "lines": [asdict(line) for line in found]}
        )
        self._screen.show_choices(self._choices())

    def _have_looked(self, seen: Glance | str) -> None:
        self._looking = False
        self._unread = seen if isinstance(seen, str) else ""
        if isinstance(seen, Glance):
            self._screen.show_records(rows(seen, self._catalogue, played=self._under_way))

    @property
    def _under_way(self) -> bool:
        return self._deeds.stage not in (Stage.ATTRACT, Stage.OVER)

    def _choices(self) -> Row:
        """What can be chosen, and what is chosen now."""
        booth, deeds, told = self._booth, self._deeds, self._catalogue.text
        under_way = self._under_way
        bodies = booth.bodies
        robot = next((name.value for name in bodies.health if name is not BodyName.AVATAR), "")
        return {
            "sitting": told("desk-sitting-paused") if under_way else told("desk-sitting-none"),
            "underWay": under_way,
            "conditions": [
                {"value": each.value if each else AUTOMATIC, "label": condition_name(each, told)} for each in deeds.turn
            ],
            "condition": booth.desk.chosen.value if booth.desk.chosen and not booth.desk.is_followed else AUTOMATIC,
            "bodies": [
                {"value": robot, "label": told("desk-robot")},
                {"value": BodyName.AVATAR.value, "label": told("desk-avatar")},
            ]
            if bodies.has_robot
            else [],
            "body": BodyName.AVATAR.value if bodies.prefers_avatar else robot,
            "languages": [
                {"value": plan.language, "label": plan.catalogue.text("language-name")}
                for plan in booth.desk.study.plans
            ],
            "language": booth.screens.attract.resting.language,
            "volumes": [{"value": str(volume), "label": f"{volume:.0%}"} for volume in LOUDNESS],
            "volume": str(min(LOUDNESS, key=lambda volume: abs(volume - deeds.volume))),
            "canBeNext": rule(Deed.NEXT, deeds.stage).effect is not Effect.REFUSED,
            "quiet": bodies.is_quiet,
            "staysPaused": booth.conductor.accepts(PauseEnded) and not deeds.paused_by_panel,
            "backup": told("desk-backup-busy")
            if self._upkeep.busy
            else told("desk-backup-waits")
            if self._upkeep.waits
            else "",
        }


WORDS = (
    "desk-title",
    "desk-close",
    "desk-health",
    "desk-counts",
    "desk-counts-done",
    "desk-counts-dropped",
    "desk-counts-overridden",
    "desk-counts-beyond",
    "desk-counts-withdrawn",
    "desk-sittings",
    "desk-sittings-none",
    "desk-deviations",
    "desk-deviations-none",
    "desk-next-sitting",
    "desk-condition",
    "desk-body",
    "desk-language",
    "desk-volume",
    "desk-now",
    "desk-again",
    "desk-quiet",
    "desk-heard",
    "desk-stay-paused",
    "desk-not-stay-paused",
    "desk-end",
    "desk-next",
    "desk-resume",
    "desk-resume-none",
    "desk-backup",
    "desk-leave",
    "desk-keys",
)
"""Every message that the panel shows as it stands."""
