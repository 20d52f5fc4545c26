"""The panel at work: what it shows and when, and what becomes of a wish."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, replace
from datetime import datetime

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.alarms import Alarm
from kiosk.experiment.events import PauseEnded
from kiosk.experiment.experimenter import Action, ActionEffect, AuditEvent, permission, shortcuts
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.store.snapshot import DashboardSnapshot
from kiosk.ui.event_loop import TimerWait
from kiosk.ui.experimenter.actions import AUTOMATIC, LOUDNESS, ActionController, Services
from kiosk.ui.experimenter.alarms import alarm_rows
from kiosk.ui.experimenter.audit_log import AuditLog
from kiosk.ui.experimenter.authorisation import AuthorisationFlow
from kiosk.ui.experimenter.health import (
    HealthInputs,
    HealthLine,
    booth_lines,
    database_fault,
    health_lines,
    is_pack_changed,
)
from kiosk.ui.experimenter.maintenance import MaintenanceScheduler
from kiosk.ui.experimenter.panel_rows import (
    NameCondition,
    condition_name,
    neutral_names,
    session_rows,
    shortcut_rows,
    today_rows,
)
from kiosk.ui.experimenter.view_model import PanelScreen, Row
from kiosk.units import MS_PER_SECOND

LOOK_MS = 1_000
RECORDS_EVERY = 10
"""Among so many looks there is one at the records: while the panel is open, they change by its own actions alone."""

CLOSE_MS = 60_000
"""Without a hand on it for so long, the panel closes."""


class Panel:
    """The panel at work."""

    def __init__(  # noqa: PLR0913, PLR0917 - all that it shows
        self,
        screen: PanelScreen,
        booth: Services,
        actions: ActionController,
        asking: AuthorisationFlow,
        upkeep: MaintenanceScheduler,
        write: AuditLog,
        catalogue: Catalogue,
        state: Callable[[], HealthInputs],
        look: Callable[[Callable[[DashboardSnapshot | str], None]], None],
        stage: Callable[[], tuple[str, int]],
        now_ms: Callable[[], int],
    ) -> None:
        """``state`` tells how everything is now; ``look`` reads the records, and hands over what it found, soon.

        ``stage`` tells the stage, and since when; ``now_ms`` is the wall's clock.
        """
        self.changed: Callable[[], None] = lambda: None
        """Called when the panel comes or goes."""
        self.seen: Callable[[], None] = lambda: None
        """Called when the experimenter looks at it."""
        self._screen = screen
        self._booth = booth
        self._actions = actions
        self._asking = asking
        self._upkeep = upkeep
        self._write = write
        self._catalogue = catalogue
        self._state = state
        self._look = look
        self._stage = stage
        self._now_ms = now_ms
        self._named = False
        self._seen: DashboardSnapshot | None = None
        self._looking = False
        self._looks = 0
        self._unread = ""
        self._packs: frozenset[tuple[str, str]] = frozenset()
        self._stirred_at = 0
        self._tick: TimerWait | None = None
        self._worded = False
        """Whether its texts are set: that waits for the first time, as a start has none to spare."""
        screen.wished.connect(self._wish)
        actions.toggle_panel = self.toggle
        actions.changed = self._refresh
        upkeep.changed = self._refresh

    @property
    def is_open(self) -> bool:
        """Whether it is to be seen."""
        return self._screen.is_open

    def toggle(self) -> None:
        """Close it, or ask for the PIN and open it."""
        if self.is_open:
            self.close()
        else:
            self._asking.ask(permission(Action.PANEL, self._actions.stage).asks, lambda _: self._open())

    def close(self) -> None:
        """Leave it; from now on the PIN is asked for again."""
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None
        self._asking.unlocked = False
        self._named = False
        self._asking.cancel()
        self._screen.open(False)  # noqa: FBT003 - it is what is set
        self._booth.screens.kiosk.step_back(False)  # noqa: FBT003 - it is what is set
        self._actions.panel_closed()
        self.changed()

    def stir(self) -> None:
        """Note that the experimenter is at the panel."""
        self._stirred_at = self._booth.clock.now_ms()

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """Show these alarms."""
        self._screen.show_alarms(alarm_rows(alarms, self._catalogue))

    def write_words(self) -> None:
        """Give the panel and the card's keys their fixed texts, once."""
        if not self._worded:
            self._worded = True
            told, keys = self._catalogue, self._booth.assigner.study.settings.shortcuts
            self._screen.set_language({name: told.text(name) for name in WORDS})
            self._screen.list_shortcuts(shortcut_rows(shortcuts(keys), told))

    def _open(self) -> None:
        self.write_words()
        self._write.record(AuditEvent.PANEL_OPENED, {"stage": self._actions.stage.value})
        self._asking.unlocked = True
        self._actions.panel_opened()
        self.stir()
        self._looks = 0
        self._booth.screens.kiosk.step_back(True)  # noqa: FBT003 - it is what is set
        # All that it shows is there before it comes.
        self._screen.show_choices(self._choices())
        self._show_records()
        self._screen.open(True)  # noqa: FBT003 - it is what is set
        self._see()
        self.seen()
        self.changed()

    def _wish(self, action: str, choice: str) -> None:
        if action == Action.PANEL.value:
            self.close()
        elif action == "names":
            self._named = not self._named
            self._screen.show_choices(self._choices())
            self._show_records()
        else:
            self._actions.request(action, choice)

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
        changed = is_pack_changed(self._booth.voice.pack, self._packs)
        state = replace(self._state(), pack_changed=changed)
        found = health_lines(state, self._catalogue)
        more = booth_lines(state, self._booth.assigner.study, self._catalogue)
        if self._unread:
            found = (*found, database_fault(self._unread, self._catalogue))
        to_do = [line for line in (*found, *more) if not line.is_ok or line.is_due]
        self._screen.show_health(
            {
                "matters": [asdict(line) for line in sorted(to_do, key=_weight)],
                "lines": [asdict(line) for line in found if line not in to_do],
                "more": [asdict(line) for line in more],
            }
        )
        self._show_today()
        self._screen.show_choices(self._choices())

    def _have_looked(self, seen: DashboardSnapshot | str) -> None:
        self._looking = False
        self._unread = seen if isinstance(seen, str) else ""
        if isinstance(seen, DashboardSnapshot):
            self._packs, self._seen = seen.packs, seen
            self._show_records()
            self._show_today()

    def _show_records(self) -> None:
        if self._seen is not None:
            rows = session_rows(self._seen, self._catalogue, self._name, played=self._under_way)
            self._screen.show_records(rows)

    def _show_today(self) -> None:
        now_ms = self._now_ms()
        stage, since_ms = self._stage()
        if self._seen is not None:
            now = datetime.fromtimestamp(now_ms / MS_PER_SECOND).astimezone()
            self._screen.show_today(
                today_rows(self._seen.today, self._seen.counts, (stage, now_ms - since_ms), now, self._catalogue)
            )

    @property
    def _name(self) -> NameCondition:
        """What conditions are called now: by letters, or by their names once that was asked for."""
        told = self._catalogue.text
        if self._named:
            return lambda condition: condition_name(condition, told)
        counted = self._seen.counts.cells if self._seen else ()
        return neutral_names((*self._actions.condition_choices, *counted), told)

    @property
    def _under_way(self) -> bool:
        return self._actions.stage not in (Stage.ATTRACT, Stage.OVER)

    def _choices(self) -> Row:
        """Return what can be chosen, and what is chosen now."""
        booth, actions, told = self._booth, self._actions, self._catalogue.text
        under_way = self._under_way
        stays_paused = booth.runner.accepts(PauseEnded(at_ms=booth.runner.now_ms())) and not actions.paused_by_panel
        lengths, untimed = actions.break_choices(), stays_paused and not booth.screens.kiosk.back_at
        embodiments = booth.embodiments
        robot = next((str(name) for name in embodiments.health if name != EmbodimentName.AVATAR), "")
        return {
            "back": told("console-back", stage=actions.stage.value),
            "underWay": under_way,
            "conditions": [
                {"value": each.name if each else AUTOMATIC, "label": self._name(each)}
                for each in actions.condition_choices
            ],
            "named": self._named,
            "condition": booth.assigner.chosen.name
            if booth.assigner.chosen and not booth.assigner.is_followed
            else AUTOMATIC,
            "embodiments": [
                {"value": robot, "label": told("console-robot")},
                {"value": str(EmbodimentName.AVATAR), "label": told("console-avatar")},
            ]
            if embodiments.has_robot
            else [],
            "embodiment": str(EmbodimentName.AVATAR) if embodiments.prefers_avatar else robot,
            "languages": [
                {"value": plan.language, "label": plan.catalogue.text("language-name")}
                for plan in booth.assigner.study.plans
            ],
            "language": booth.screens.attract.resting.language,
            "volumes": [{"value": str(volume), "label": f"{volume:.0%}"} for volume in LOUDNESS],
            "volume": str(min(LOUDNESS, key=lambda volume: abs(volume - actions.volume))),
            # Before the thanks it would do what ending the session does, which stands apart.
            "canBeNext": actions.stage in (Stage.THANKS, Stage.OVER)
            and permission(Action.NEXT, actions.stage).effect is not ActionEffect.REFUSED,
            "muted": embodiments.is_muted,
            "staysPaused": stays_paused,
            "breaks": [
                {"value": str(minutes), "label": told("console-break-minutes", minutes=minutes)} for minutes in lengths
            ]
            # A session that was paused by a shortcut stays so without a time, and one that allows no break can, too.
            + ([{"value": "0", "label": told("console-break-open")}] if untimed or (under_way and not lengths) else []),
            "break": str(actions.break_minutes) if booth.screens.kiosk.back_at else "0" if untimed else "",
            "onBreak": booth.runner.is_on_break,
            "backup": copy_words(self._upkeep, self._catalogue),
        }


def _weight(line: HealthLine) -> int:
    """Return the place of a matter: first what a button does here, and last what is typed elsewhere."""
    if line.action:
        return 0 if line.action == Action.MUTE.value else 1
    return 3 if line.command else 2


def copy_words(upkeep: MaintenanceScheduler, catalogue: Catalogue) -> str:
    """Return what becomes of a copy that was asked for; an empty text if none was."""
    if upkeep.busy:
        return catalogue.text("console-backup-busy")
    return catalogue.text("console-backup-waits") if upkeep.waits else ""


WORDS = (
    "console-title",
    "console-today",
    "console-sessions-page",
    "console-next-page",
    "console-all-well",
    "console-booth",
    "console-names-show",
    "console-names-hide",
    "console-test-the-voice",
    "console-close",
    "console-paused",
    "console-on-break",
    "console-cancel",
    "console-key-delete",
    "console-key-enter",
    "console-alarms",
    "console-health",
    "console-shortcuts",
    "console-mark-well",
    "console-mark-idle",
    "console-mark-ill",
    "console-counts",
    "console-counts-unlisted",
    "console-counts-done",
    "console-counts-begun",
    "console-counts-dropped",
    "console-counts-overridden",
    "console-counts-beyond",
    "console-counts-withdrawn",
    "console-sessions",
    "console-sessions-none",
    "console-sessions-number",
    "console-sessions-begun",
    "console-sessions-condition",
    "console-sessions-stage",
    "console-sessions-status",
    "console-deviations",
    "console-deviations-none",
    "console-next-session",
    "console-condition",
    "console-embodiment",
    "console-language",
    "console-volume",
    "console-actions",
    "console-to-do",
    "console-sound",
    "console-data",
    "console-repeat",
    "console-mute",
    "console-heard",
    "console-stay-paused",
    "console-break",
    "console-break-row",
    "console-pause-row",
    "console-break-end",
    "console-session",
    "console-abort",
    "console-next",
    "console-resume",
    "console-backup",
    "console-quit",
    "console-keys",
)
"""Every message that the panel shows as it stands."""
