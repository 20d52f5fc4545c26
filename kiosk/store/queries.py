"""Read what is stored: sessions, their events and what they followed, and any decision."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import sqlite_utils

from kiosk import UserInputError
from kiosk.assistance.assistant import Decision, Explanation, table_before_flip
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import Action, QTable
from kiosk.assistance.wording import Catalogue
from kiosk.config import Settings
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import (
    AssistanceDecided,
    BoardDealt,
    CardFlipped,
    Event,
    HintGiven,
    SessionEnded,
    Stage,
    StageEntered,
    Status,
    from_record,
)
from kiosk.experiment.information import Information
from kiosk.experiment.projections import Measures, measure, of_the_game
from kiosk.experiment.questionnaire import QUESTIONNAIRES, Questionnaire
from kiosk.experiment.randomisation import AllocationSource
from kiosk.experiment.replay import DecisionContext
from kiosk.experiment.session_config import SessionConfig, SessionKind
from kiosk.game import Board, Concentration, Position
from kiosk.store.database import in_use, open_for_reading, unreadable
from kiosk.store.participants import EnrolmentCounts, count_enrolment, participant_of

_SUMMARISED = (
    *("StageEntered", "BoardDealt", "CardFlipped", "HintGiven", "BoardUnlocked"),
    *("PauseRequested", "PauseEnded", "SessionEnded"),
)
"""What is told of a session at a glance follows from these."""

LARGEST = 2**63 - 1
"""The largest whole number that SQLite knows."""


@dataclass(frozen=True)
class StoredSession:
    """A stored session at a glance; ``status`` is None while it is under way.

    ``participant`` and ``code`` are None in sessions from before people were numbered, and ``allotted`` where no list
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
    allocation_source: AllocationSource | None

    def to_json(self) -> dict[str, Any]:
        """The session as the command line prints it: without the code, which is the visitor's."""
        return {
            "session": self.id,
            "participant": self.participant,
            "status": self.status.value if self.status else "running",
            "stage": self.stage.value if self.stage else None,
            "allotted": self.allocation_source.value if self.allocation_source else None,
            "condition": self.condition,
            "body": self.body,
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
        """``in_use``: somebody is writing, so that a session without an end may still get one."""
        self._database = database
        self._unended = None if in_use else Status.INTERRUPTED

    def sessions(self) -> list[StoredSession]:
        """Every session, in the order in which they began."""
        return [self._session(row) for row in self._database["session"].rows_where(order_by="id")]

    def session(self, number: int) -> StoredSession:
        """One session; raises BadInput if there is none of this number."""
        return self._session(self._row(number))

    def counts(self, *, simulated: bool | SessionKind) -> EnrolmentCounts:
        """How many came, by condition and by what became of them: people, rehearsals or trials."""
        return count_enrolment(self._database.conn, simulated=simulated, in_use=self._unended is None)

    def records(self, number: int) -> list[dict[str, Any]]:
        """Every event of a session as JSON values: seq, at_ms, type, origin, and its own fields."""
        self._row(number)
        rows = self._database["event"].rows_where("session = ?", [number], order_by="seq")
        return [{key: row[key] for key in ("seq", "at_ms", "type", "origin")} | json.loads(row["body"]) for row in rows]

    def events(self, number: int) -> list[Event]:
        """Every event of a session."""
        return [_event(record) for record in self.records(number)]

    def story(self, number: int) -> list[Event]:
        """Every event of a session that it came to by itself: without the ends that were put to it after a crash."""
        return [_event(record) for record in self.records(number) if record["origin"] != "recovery"]

    def plan(self, number: int) -> SessionConfig:
        """What a session followed, from what was kept with it; raises BadInput if this program cannot read that."""
        row = self._row(number)
        if row["information_source"] is None:
            raise UserInputError(
                f"session {number} is from before sessions had all their stages, and cannot be played again"
            )
        try:
            return SessionConfig(
                settings=Settings.model_validate_json(self.source(row["settings_sha256"])),
                condition=Condition.from_name(row["condition"]),
                policy=QTable.from_json(self.source(row["policy_source"])),
                catalogue=Catalogue(Path(row["language"]), json.loads(self.source(row["sentences_source"]))),
                information=Information.model_validate_json(self.source(row["information_source"])),
                about_you=Questionnaire.model_validate_json(self.source(row["about_you_source"])),
                questionnaires=QUESTIONNAIRES.validate_json(self.source(row["questionnaire_source"])),
                deck=tuple(json.loads(row["deck"])),
                practice_deck=tuple(json.loads(row["practice_deck"])),
            )
        except ValueError as error:
            raise UserInputError(f"what session {number} followed cannot be read: {error}") from error

    def seed(self, number: int) -> int:
        """The seed of a session, from which all its chance came."""
        return int(self._row(number)["seed"])

    def source(self, sha256: str) -> str:
        """What is kept under a hash; raises BadInput if nothing is."""
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
        events = [_event({"at_ms": r["at_ms"], "type": r["type"]} | json.loads(r["body"])) for r in rows]
        participant = participant_of(self._database.conn, row["id"])
        return StoredSession(
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
            AllocationSource(row["allotted"]) if row["allotted"] else None,
        )

    def _status(self, number: int) -> Status | None:
        """How a session ended: only its very last event says so, as one that was cut off may have been gone on with."""
        for row in self._database["event"].rows_where("session = ?", [number], order_by="seq DESC", limit=1):
            if row["type"] == SessionEnded.__name__:
                return Status(json.loads(row["body"])["status"])
        return self._unended


@contextmanager
def open_repository(folder: Path) -> Iterator[SessionRepository]:
    """The archive of a data folder; raises BadInput if there is none that can be read, or not all of it."""
    with closing(open_for_reading(folder)) as connection:
        try:
            yield SessionRepository(sqlite_utils.Database(connection), in_use=in_use(folder))
        except sqlite3.DatabaseError as error:
            raise unreadable(error, folder) from error


def _stage(events: list[Event]) -> Stage | None:
    """The last stage that was more than the end."""
    entered = [event.stage for event in events if isinstance(event, StageEntered) and event.stage is not Stage.OVER]
    return entered[-1] if entered else None


def _event(record: dict[str, Any]) -> Event:
    return from_record({key: value for key, value in record.items() if key not in ("seq", "origin")})


def explain_stored_decision(archive: SessionRepository, number: int, flip: int) -> Explanation:
    """The decision before a flip (from 1) of a stored session, laid open.

    Raises BadInput if there was none, or if it comes out otherwise today than it was recorded.
    """
    game = _Recorded.of(of_the_game(archive.events(number)), f"session {number}")
    explanation = _moment(archive, number, game, flip).explained()
    if not game.agrees(flip, explanation):
        raise UserInputError(f"flip {flip} of {game.where} comes out otherwise today than it was decided then")
    hint = game.hints.get(flip)
    return replace(explanation, spoken=hint.sentence if hint else None)


def _moment(archive: SessionRepository, number: int, game: _Recorded, flip: int) -> DecisionContext:
    plan = archive.plan(number)
    game.check_reached(flip, helped=plan.condition is not Condition.NO_ASSISTANCE)
    before, hint = game.decisions.get(flip - 1), game.hints.get(flip)
    flips = tuple(game.flips[: flip - 1])
    return DecisionContext(
        board=game.board,
        flips=flips,
        last=before.action if before else Action.NO_HELP,
        condition=plan.condition,
        rule=TargetRule(plan.settings.assistance.target_rule),
        policy=table_before_flip(plan.policy, plan.settings.assistance.step, Concentration(game.board), flips),
        catalogue=plan.catalogue,
        target=hint.target if hint else None,
    )


@dataclass
class _Recorded:
    """What was recorded of the session's game: a board, its flips, and by flip number the decisions and hints."""

    where: str
    board: Board
    flips: list[Position] = field(default_factory=list)
    decisions: dict[int, AssistanceDecided] = field(default_factory=dict)
    hints: dict[int, HintGiven] = field(default_factory=dict)

    @classmethod
    def of(cls, events: Iterable[Event], where: str) -> _Recorded:
        """The game among the events of its stage; raises BadInput if none was dealt."""
        game = None
        for event in events:
            if isinstance(event, BoardDealt):
                game = cls(where, Board(event.rows, event.columns, event.cards))
            elif game is not None:
                game.take(event)
        if game is None:
            raise UserInputError(f"in {where} no game was dealt, so there is nothing to explain")
        return game

    def take(self, event: Event) -> None:
        """Add what one event tells of the game."""
        match event:
            case CardFlipped(position=position):
                self.flips.append(position)
            case AssistanceDecided(flip=flip):
                self.decisions[flip] = event
            case HintGiven(flip=flip):
                self.hints[flip] = event

    def check_reached(self, flip: int, *, helped: bool) -> None:
        """Raise BadInput if nothing was decided before this flip, or, where nobody helps, it never came."""
        if flip in self.decisions or (not helped and flip <= len(self.flips)):
            return
        raise UserInputError(f"{self.where} has {len(self.flips)} flips; nothing was decided about a flip {flip}")

    def agrees(self, flip: int, explanation: Explanation) -> bool:
        """Whether the explanation is what was recorded, in all that was recorded of it."""
        return self._same_decision(flip, explanation.decision) and self._same_hint(flip, explanation)

    def _same_decision(self, flip: int, today: Decision) -> bool:
        stored, state = self.decisions.get(flip), today.state
        return stored is None or (stored.game, stored.last, stored.outcome, stored.gate, stored.action) == (
            *(state.game, state.last, state.outcome),
            *(today.gate_decision, today.action),
        )

    def _same_hint(self, flip: int, explanation: Explanation) -> bool:
        stored, today = self.hints.get(flip), explanation.decision.hint
        if stored is None or today is None:
            return stored is None and today is None
        return (stored.seen, stored.mate_seen, stored.reason, stored.row, stored.column) == (
            *(today.target.seen, today.target.mate_seen, today.target.reason),
            *(today.row, today.column),
        ) and (stored.target in explanation.candidates and stored.sentence in explanation.sentences)
