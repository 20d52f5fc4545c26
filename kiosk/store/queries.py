"""Read what is stored: sessions, their events and what they followed, and any decision."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import sqlite_utils

from kiosk import UserInputError
from kiosk.assistance.assistant import Explanation
from kiosk.assistance.policy import QTable
from kiosk.assistance.wording import Catalogue
from kiosk.config import Settings
from kiosk.experiment.condition import AllocationSource, Condition
from kiosk.experiment.events import Event, LanguageSelected, SessionEnded, Stage, Status, from_record
from kiosk.experiment.information import Information
from kiosk.experiment.projections import Measures, measure_game
from kiosk.experiment.questionnaire import QUESTIONNAIRES, Questionnaire
from kiosk.experiment.replay import DecisionContext, agrees_with_record
from kiosk.experiment.session_config import SessionConfig, SessionKind, Translation
from kiosk.experiment.session_state import SessionState, language_before_flip
from kiosk.store.database import in_use, open_for_reading, unreadable
from kiosk.store.participants import EnrolmentCounts, count_enrolment, participant_of

_SUMMARISED = (
    *("StageEntered", "BoardDealt", "CardFlipped", "HintGiven", "RemarkGiven", "BoardUnlocked"),
    *("PauseRequested", "PauseEnded", "SessionEnded"),
)
"""The overview of a session follows from these."""

LARGEST = 2**63 - 1
"""The largest whole number that SQLite knows."""


@dataclass(frozen=True)
class StoredSession:
    """A stored session at a glance; ``status`` is None while it is under way.

    ``participant`` and ``code`` are None in sessions from before people were numbered, ``allocation_source`` where no
    allocation list was followed. ``stage`` is where it ended, or is; None if it got nowhere.
    """

    id: int
    started_at: str
    condition: str
    embodiment: str
    status: Status | None
    kind: SessionKind
    measures: Measures
    participant: str | None
    code: str | None
    stage: Stage | None
    allocation_source: AllocationSource | None

    def to_json(self) -> dict[str, Any]:
        """Return the session as the command line prints it: without the code, which is the visitor's."""
        return {
            "session": self.id,
            "participant": self.participant,
            "status": self.status.value if self.status else "running",
            "stage": self.stage.value if self.stage else None,
            "allocation_source": self.allocation_source.value if self.allocation_source else None,
            "condition": self.condition,
            "embodiment": self.embodiment,
            "flips": self.measures.flips,
            "moves": self.measures.moves,
            "pairs": self.measures.pairs,
            "hints": self.measures.hints,
            "simulated": self.kind is SessionKind.SIMULATED,
            "trial": self.kind is SessionKind.TRIAL,
        }


class SessionRepository:
    """The sessions of one data folder."""

    def __init__(self, database: sqlite_utils.Database, *, in_use: bool) -> None:
        """``in_use``: a kiosk is writing, so that a session without an end may still get one."""
        self._database = database
        self._unended = None if in_use else Status.INTERRUPTED

    def sessions(self) -> list[StoredSession]:
        """Every session, in the order in which they began."""
        return [self._session(row) for row in self._database["session"].rows_where(order_by="id")]

    def session(self, number: int) -> StoredSession:
        """One session; raises UserInputError if there is none of this number."""
        return self._session(self._row(number))

    def counts(self, *, kind: SessionKind) -> EnrolmentCounts:
        """How many came, by condition and by what became of them: people, rehearsals or trials."""
        return count_enrolment(self._database.conn, kind=kind, in_use=self._unended is None)

    def records(self, number: int) -> list[dict[str, Any]]:
        """Every event of a session as JSON values: seq, at_ms, type, origin, and its own fields."""
        self._row(number)
        rows = self._database["event"].rows_where("session = ?", [number], order_by="seq")
        return [
            {key: row[key] for key in ("seq", "at_ms", "type", "origin")} | json.loads(row["payload"]) for row in rows
        ]

    def events(self, number: int) -> list[Event]:
        """Every event of a session."""
        return [_event(record) for record in self.records(number)]

    def story(self, number: int) -> list[Event]:
        """Return every event of a session, without the ends that were added after a crash."""
        return [_event(record) for record in self.records(number) if record["origin"] != "recovery"]

    def plan(self, number: int) -> SessionConfig:
        """Return what a session followed, from its stored sources; raise UserInputError if they cannot be read."""
        row = self._row(number)
        try:
            return SessionConfig(
                settings=Settings.model_validate_json(self.source(row["settings_sha256"])),
                condition=Condition(row["condition"]),
                policy=QTable.from_json(self.source(row["policy_source"])),
                catalogue=Catalogue(Path(row["language"]), json.loads(self.source(row["sentences_source"]))),
                information=Information.model_validate_json(self.source(row["information_source"])),
                about_you=Questionnaire.model_validate_json(self.source(row["about_you_source"])),
                questionnaires=QUESTIONNAIRES.validate_json(self.source(row["questionnaire_source"])),
                deck=tuple(json.loads(row["deck"])),
                practice_deck=tuple(json.loads(row["practice_deck"])),
                study_sha256=row["study_sha256"],
                translations=self._translations(row) if self._changed_language(number) else (),
            )
        except ValueError as error:
            raise UserInputError(f"what session {number} followed cannot be read: {error}") from error

    def _changed_language(self, number: int) -> bool:
        where = "session = ? AND type = ?"
        return self._database["event"].count_where(where, [number, LanguageSelected.__name__]) > 0

    def _translations(self, row: dict[str, Any]) -> tuple[Translation, ...]:
        """All languages that the visitor could go on in."""
        return tuple(
            Translation(
                Catalogue(Path(language), json.loads(self.source(kept["sentences"]))),
                Information.model_validate_json(self.source(kept["information"])),
            )
            for language, kept in json.loads(row["translations"]).items()
        )

    def seed(self, number: int) -> int:
        """Return the seed of a session, from which all its chance came."""
        return int(self._row(number)["seed"])

    def source(self, sha256: str) -> str:
        """Return what is kept under a hash; raises UserInputError if nothing is."""
        rows = self._database["source"].rows_where("sha256 = ?", [sha256])
        for row in rows:
            return str(row["content"])
        raise UserInputError(f"nothing is kept under the hash {sha256}")

    def _row(self, number: int) -> dict[str, Any]:
        rows = self._database["session"].rows_where("id = ?", [number]) if abs(number) <= LARGEST else ()
        for row in rows:
            return row
        raise UserInputError(f"there is no session {number}")

    def _session(self, row: dict[str, Any]) -> StoredSession:
        wanted = ", ".join("?" * len(_SUMMARISED))
        rows = self._database["event"].rows_where(
            f"session = ? AND type IN ({wanted})", [row["id"], *_SUMMARISED], order_by="seq"
        )
        state = SessionState.from_events(
            _event({"at_ms": row["at_ms"], "type": row["type"]} | json.loads(row["payload"])) for row in rows
        )
        participant = participant_of(self._database.conn, row["id"])
        return StoredSession(
            row["id"],
            row["started_at"],
            row["condition"],
            row["embodiment"],
            self._status(row["id"]),
            SessionKind(row["kind"]),
            measure_game(state),
            participant.name if participant else None,
            participant.code if participant else None,
            state.last_stage,
            AllocationSource(row["allocation_source"]) if row["allocation_source"] else None,
        )

    def _status(self, number: int) -> Status | None:
        """Return how a session ended.

        Only its very last event says so, as one that was cut off may have gone on.
        """
        for row in self._database["event"].rows_where("session = ?", [number], order_by="seq DESC", limit=1):
            if row["type"] == SessionEnded.__name__:
                return Status(json.loads(row["payload"])["status"])
        return self._unended


@contextmanager
def open_repository(folder: Path) -> Iterator[SessionRepository]:
    """Open the archive of a data folder.

    Raises UserInputError if there is none that can be read completely.
    """
    with closing(open_for_reading(folder)) as connection:
        try:
            yield SessionRepository(sqlite_utils.Database(connection), in_use=in_use(folder))
        except sqlite3.DatabaseError as error:
            raise unreadable(error, folder) from error


def _event(record: dict[str, Any]) -> Event:
    return from_record({key: value for key, value in record.items() if key not in ("seq", "origin")})


class DecisionExplainer:
    """Lays open the decisions of one stored session, which is read once."""

    def __init__(self, archive: SessionRepository, number: int) -> None:
        """Read the session of this number; raises UserInputError if no game was dealt in it."""
        self._number = number
        self._events = archive.events(number)
        game = SessionState.from_events(self._events).game
        if game is None:
            raise UserInputError(f"in session {number} no game was dealt, so there is nothing to explain")
        self._game = game
        self._plan = archive.plan(number)

    def explain(self, flip: int) -> Explanation:
        """Return the decision before a flip (from 1), laid open.

        Raises UserInputError if there was none, or if it comes out otherwise today than it was recorded.
        """
        number, game, plan = self._number, self._game, self._plan
        spoken = plan.translation(language_before_flip(self._events, flip) or plan.language)
        plan = plan if spoken is None else replace(plan, catalogue=spoken.catalogue)
        if flip not in game.decisions and (plan.cell.helps or flip > len(game.flips)):
            raise UserInputError(
                f"session {number} has {len(game.flips)} flips; nothing was decided about a flip {flip}"
            )
        explanation = DecisionContext.before(flip, game, plan).explained()
        if not agrees_with_record(explanation, game, flip):
            raise UserInputError(f"flip {flip} of session {number} comes out otherwise today than it was decided then")
        said = game.hints.get(flip) or game.remarks.get(flip)
        return replace(explanation, spoken=said.given.sentence if said else None)


def explain_stored_decision(archive: SessionRepository, number: int, flip: int) -> Explanation:
    """Return the decision before a flip (from 1) of a stored session, laid open.

    Raises UserInputError if there was none, or if it comes out otherwise today than it was recorded.
    """
    return DecisionExplainer(archive, number).explain(flip)
