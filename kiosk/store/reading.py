"""Looking at what is stored, without any right to change it."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import sqlite_utils

from kiosk import BadInput
from kiosk.assistant.qtable import QTable
from kiosk.assistant.wording import Catalogue
from kiosk.settings import Settings
from kiosk.store.database import in_use, open_for_reading, unreadable
from kiosk.store.people.counting import Counts, counts
from kiosk.store.people.participants import participant_of
from kiosk.study.after.measures import Measures, measure
from kiosk.study.allocation import Allotted
from kiosk.study.condition import Condition
from kiosk.study.declared.information import Information
from kiosk.study.declared.questionnaire import QUESTIONNAIRES, Questionnaire
from kiosk.study.events import Event, SittingEnded, Stage, StageEntered, Status, from_record
from kiosk.study.plan import Plan
from kiosk.study.session_kind import SessionKind

_SUMMARISED = (
    *("StageEntered", "BoardDealt", "CardFlipped", "HintGiven", "BoardOpened"),
    *("PauseAsked", "PauseEnded", "SittingEnded"),
)
"""What is told of a sitting at a glance follows from these."""

LARGEST = 2**63 - 1
"""The largest whole number that SQLite knows."""


@dataclass(frozen=True)
class Sitting:
    """A stored sitting at a glance; ``status`` is None while it is under way.

    ``participant`` and ``code`` are None in sittings from before people were numbered, and ``allotted`` where no list
    of places was followed. ``stage`` is where it ended, or is; None if it got nowhere.
    """

    id: int
    started_at: str
    condition: str
    body: str
    status: Status | None
    kind: SessionKind
    measures: Measures
    participant: str | None
    code: str | None
    stage: Stage | None
    allotted: Allotted | None

    def to_json(self) -> dict[str, Any]:
        """The sitting as the command line prints it: without the code, which is the visitor's."""
        return {
            "sitting": self.id,
            "participant": self.participant,
            "status": self.status.value if self.status else "running",
            "stage": self.stage.value if self.stage else None,
            "allotted": self.allotted.value if self.allotted else None,
            "condition": self.condition,
            "body": self.body,
            "flips": self.measures.flips,
            "moves": self.measures.moves,
            "pairs": self.measures.pairs,
            "hints": self.measures.hints,
            "simulated": self.kind is SessionKind.SIMULATED,
            "trial": self.kind is SessionKind.TRIAL,
        }


class Archive:
    """The sittings of one data folder."""

    def __init__(self, database: sqlite_utils.Database, *, in_use: bool) -> None:
        """``in_use``: somebody is writing, so that a sitting without an end may still get one."""
        self._database = database
        self._unended = None if in_use else Status.INTERRUPTED

    def sittings(self) -> list[Sitting]:
        """Every sitting, in the order in which they began."""
        return [self._sitting(row) for row in self._database["sitting"].rows_where(order_by="id")]

    def sitting(self, number: int) -> Sitting:
        """One sitting; raises BadInput if there is none of this number."""
        return self._sitting(self._row(number))

    def counts(self, *, simulated: bool | SessionKind) -> Counts:
        """How many came, by condition and by what became of them: people, rehearsals or trials."""
        return counts(self._database.conn, simulated=simulated, in_use=self._unended is None)

    def records(self, number: int) -> list[dict[str, Any]]:
        """Every event of a sitting as JSON values: seq, at_ms, type, origin, and its own fields."""
        self._row(number)
        rows = self._database["event"].rows_where("sitting = ?", [number], order_by="seq")
        return [{key: row[key] for key in ("seq", "at_ms", "type", "origin")} | json.loads(row["body"]) for row in rows]

    def events(self, number: int) -> list[Event]:
        """Every event of a sitting."""
        return [_event(record) for record in self.records(number)]

    def story(self, number: int) -> list[Event]:
        """Every event of a sitting that it came to by itself: without the ends that were put to it after a crash."""
        return [_event(record) for record in self.records(number) if record["origin"] != "recovery"]

    def plan(self, number: int) -> Plan:
        """What a sitting followed, from what was kept with it; raises BadInput if this program cannot read that."""
        row = self._row(number)
        if row["information_source"] is None:
            raise BadInput(f"sitting {number} is from before sittings had all their stages, and cannot be played again")
        try:
            return Plan(
                settings=Settings.model_validate_json(self.source(row["settings_sha256"])),
                condition=Condition.named(row["condition"]),
                policy=QTable.from_json(self.source(row["policy_source"])),
                catalogue=Catalogue(Path(row["language"]), json.loads(self.source(row["sentences_source"]))),
                information=Information.model_validate_json(self.source(row["information_source"])),
                about_you=Questionnaire.model_validate_json(self.source(row["about_you_source"])),
                questionnaires=QUESTIONNAIRES.validate_json(self.source(row["questionnaire_source"])),
                deck=tuple(json.loads(row["deck"])),
                practice_deck=tuple(json.loads(row["practice_deck"])),
            )
        except ValueError as error:
            raise BadInput(f"what sitting {number} followed cannot be read: {error}") from error

    def seed(self, number: int) -> int:
        """The seed of a sitting, from which all its chance came."""
        return int(self._row(number)["seed"])

    def source(self, sha256: str) -> str:
        """What is kept under a hash; raises BadInput if nothing is."""
        rows = self._database["source"].rows_where("sha256 = ?", [sha256])
        for row in rows:
            return str(row["content"])
        raise BadInput(f"nothing is kept under the hash {sha256}")

    def _row(self, number: int) -> dict[str, Any]:
        rows = self._database["sitting"].rows_where("id = ?", [number]) if abs(number) <= LARGEST else ()
        for row in rows:
            return row
        raise BadInput(f"there is no sitting {number}")

    def _sitting(self, row: dict[str, Any]) -> Sitting:
        wanted = ", ".join("?" * len(_SUMMARISED))
        rows = self._database["event"].rows_where(
            f"sitting = ? AND type IN ({wanted})", [row["id"], *_SUMMARISED], order_by="seq"
        )
        events = [_event({"at_ms": r["at_ms"], "type": r["type"]} | json.loads(r["body"])) for r in rows]
        participant = participant_of(self._database.conn, row["id"])
        return Sitting(
            row["id"],
            row["started_at"],
            row["condition"],
            row["body"],
            self._status(row["id"]),
            SessionKind(row["simulated"]),
            measure(events),
            participant.name if participant else None,
            participant.code if participant else None,
            _stage(events),
            Allotted(row["allotted"]) if row["allotted"] else None,
        )

    def _status(self, number: int) -> Status | None:
        """How a sitting ended: only its very last event says so, as one that was cut off may have been gone on with."""
        for row in self._database["event"].rows_where("sitting = ?", [number], order_by="seq DESC", limit=1):
            if row["type"] == SittingEnded.__name__:
                return Status(json.loads(row["body"])["status"])
        return self._unended


@contextmanager
def archive(folder: Path) -> Iterator[Archive]:
    """The archive of a data folder; raises BadInput if there is none that can be read, or not all of it."""
    with closing(open_for_reading(folder)) as connection:
        try:
            yield Archive(sqlite_utils.Database(connection), in_use=in_use(folder))
        except sqlite3.DatabaseError as error:
            raise unreadable(error, folder) from error


def _stage(events: list[Event]) -> Stage | None:
    """The last stage that was more than the end."""
    entered = [event.stage for event in events if isinstance(event, StageEntered) and event.stage is not Stage.OVER]
    return entered[-1] if entered else None


def _event(record: dict[str, Any]) -> Event:
    return from_record({key: value for key, value in record.items() if key not in ("seq", "origin")})
