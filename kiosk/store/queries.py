"""Read what is stored: sessions, their events and what they followed, and any decision."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from kiosk import UserInputError
from kiosk.assistance.assistant import Explanation, game_after
from kiosk.assistance.policy import QTable
from kiosk.assistance.wording import Catalogue
from kiosk.config import Settings
from kiosk.experiment.condition import Condition
from kiosk.experiment.event_records import from_fields
from kiosk.experiment.events import Event, LanguageSelected
from kiosk.experiment.information import Information
from kiosk.experiment.questionnaire import QUESTIONNAIRES, Questionnaire
from kiosk.experiment.replay import DecisionContext, agrees_with_record
from kiosk.experiment.session_config import SessionConfig, Translation
from kiosk.experiment.session_state import SessionState, language_before_flip
from kiosk.game import Concentration
from kiosk.store.chain import broken_links
from kiosk.store.listing import SessionList, StoredSession, opened

LARGEST = 2**63 - 1
"""The largest whole number that SQLite knows."""


StoredEvent = tuple[int, int, str, str, str]
"""An event's seq, at_ms, type, origin, and its own fields as JSON."""


def decoded(payloads: Sequence[str]) -> list[dict[str, Any] | None]:
    """Return the fields of events from their JSON; None for each that cannot be read."""
    try:
        # One array is read in a third of the time of as many objects.
        fields: list[Any] = json.loads(f"[{','.join(payloads)}]")
    except ValueError:
        fields = []
    if len(fields) == len(payloads) and set(map(type, fields)) <= {dict}:
        return fields
    return list(map(_fields, payloads))


_KINDS = "SELECT seq, type FROM event WHERE session = ? ORDER BY seq"


def _is_text(content: bytes) -> bool:
    try:
        content.decode()
    except ValueError:
        return False
    return True


def _fields(payload: str) -> dict[str, Any] | None:
    try:
        fields = json.loads(payload)
    except ValueError:
        return None
    return fields if isinstance(fields, dict) else None


@dataclass(frozen=True)
class BrokenEvent:
    """An event that is not what was recorded, and what is wrong with it."""

    session: int
    seq: int
    kind: str
    what: str

    def __str__(self) -> str:
        """Name it in a sentence."""
        return f"event {self.seq} of session {self.session} ({self.kind!r}) {self.what}"


UNREADABLE = "cannot be read"
CHANGED = "is not what was recorded: it does not match its hash"


class SessionRepository(SessionList):
    """The sessions of one data folder, and what happened in them."""

    def session(self, number: int) -> StoredSession:
        """One session; raises UserInputError if there is none of this number."""
        self._row(number)
        return self.listed(number)

    def records(self, number: int) -> list[dict[str, Any]]:
        """Return every event of a session as JSON values: seq, at_ms, type, origin, and the fields that can be read."""
        return [
            {"seq": seq, "at_ms": at_ms, "type": kind, "origin": origin} | (fields or {})
            for seq, at_ms, kind, origin, fields in self.event_fields(number)
        ]

    def event_fields(self, number: int) -> Iterator[tuple[int, int, str, str, dict[str, Any] | None]]:
        """Yield every event of a session: seq, at_ms, type, origin, and its own fields as JSON values.

        The fields are None where they cannot be read.
        """
        rows = self.stored_events(number)
        for (seq, at_ms, kind, origin, _), fields in zip(rows, decoded([row[-1] for row in rows]), strict=True):
            yield seq, at_ms, kind, origin, fields

    def stored_events(self, number: int) -> list[StoredEvent]:
        """Return every event of a session: seq, at_ms, type, origin, and its own fields as JSON."""
        self._row(number)
        query = "SELECT seq, at_ms, type, origin, payload FROM event WHERE session = ? ORDER BY seq"
        try:
            rows: list[StoredEvent] = self._connection.execute(query, (number,)).fetchall()
        except sqlite3.OperationalError:
            # Where damaged bytes are no text, Python gives none of the rows.
            cursor = self._connection.execute(query.replace("payload", "CAST(payload AS BLOB)"), (number,))
            rows = [(*row, payload.decode(errors="replace")) for *row, payload in cursor]
        return rows

    def broken_events(self, number: int) -> list[BrokenEvent]:
        """Return every event of a session that cannot be read, or that does not match its hash."""
        broken = {each.seq: each for each in self.changed_events(number)}
        for seq, at_ms, kind, _, fields in self.event_fields(number):
            try:
                _event(at_ms, kind, fields)
            except ValueError as error:
                broken[seq] = BrokenEvent(number, seq, kind, f"{UNREADABLE}: {error}")
        return [broken[seq] for seq in sorted(broken)]

    def changed_events(self, number: int) -> list[BrokenEvent]:
        """Return every event of a session that does not match its hash."""
        connection = self._connection
        try:
            changed = {seq: CHANGED for _, seq in broken_links(connection, number)}
        except sqlite3.OperationalError:
            # Damaged bytes are no text, and where there are some, Python reads none of the rows.
            payloads = "SELECT seq, CAST(payload AS BLOB) FROM event WHERE session = ?"
            changed = {
                seq: UNREADABLE for seq, payload in connection.execute(payloads, (number,)) if not _is_text(payload)
            }
        return [
            BrokenEvent(number, seq, kind, changed[seq])
            for seq, kind in (connection.execute(_KINDS, (number,)) if changed else ())
            if seq in changed
        ]

    def events(self, number: int) -> list[Event]:
        """Every event of a session; raises UserInputError if one cannot be read."""
        return [event for event, _ in self._events(number)]

    def readable_events(self, number: int) -> list[Event]:
        """Return every event of a session but those that cannot be read."""
        events: list[Event] = []
        for _, at_ms, kind, _, fields in self.event_fields(number):
            with suppress(ValueError):
                events.append(_event(at_ms, kind, fields))
        return events

    def story(self, number: int) -> list[Event]:
        """Return every event of a session, without the ends that were added after a crash.

        Raises UserInputError if an event cannot be read.
        """
        return [event for event, origin in self._events(number) if origin != "recovery"]

    def readable_story(self, number: int) -> list[Event]:
        """Return the same up to the first event that cannot be read."""
        events: list[Event] = []
        with suppress(UserInputError):
            events += (event for event, origin in self._events(number) if origin != "recovery")
        return events

    def _events(self, number: int) -> Iterator[tuple[Event, str]]:
        """Yield every event with its origin; raises UserInputError at the first one that cannot be read."""
        for seq, at_ms, kind, origin, fields in self.event_fields(number):
            try:
                yield _event(at_ms, kind, fields), origin
            except ValueError as error:
                raise UserInputError(str(BrokenEvent(number, seq, kind, f"{UNREADABLE}: {error}"))) from error

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
                visit=self._visit(number),
            )
        except ValueError as error:
            raise UserInputError(f"what session {number} followed cannot be read: {error}") from error

    def _visit(self, number: int) -> int:
        """Return which visit of its participant a session is."""
        row = self._connection.execute("SELECT visit FROM participant WHERE session = ?", (number,)).fetchone()
        return 1 if row is None else int(row[0])

    def _changed_language(self, number: int) -> bool:
        query = "SELECT EXISTS (SELECT 1 FROM event WHERE session = ? AND type = ?)"
        return bool(self._connection.execute(query, (number, LanguageSelected.__name__)).fetchone()[0])

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
        row = self._connection.execute("SELECT content FROM source WHERE sha256 = ?", (sha256,)).fetchone()
        if row is None:
            raise UserInputError(f"nothing is kept under the hash {sha256}")
        return str(row[0])

    def _row(self, number: int) -> dict[str, Any]:
        """Return the columns of a session by their names; raises UserInputError if there is none."""
        if abs(number) <= LARGEST:
            cursor = self._connection.execute("SELECT * FROM session WHERE id = ?", (number,))
            names = [column for column, *_ in cursor.description]
            for row in cursor:
                return dict(zip(names, row, strict=True))
        raise UserInputError(f"there is no session {number}")


@contextmanager
def open_repository(folder: Path) -> Iterator[SessionRepository]:
    """Open the archive of a data folder.

    Raises UserInputError if there is none that can be read completely.
    """
    with opened(folder, SessionRepository) as repository:
        yield repository


def _event(at_ms: int, kind: str, fields: dict[str, Any] | None) -> Event:
    if fields is None:
        raise ValueError("its fields are no JSON object")
    return from_fields(kind, at_ms, fields)


class DecisionExplainer:
    """Lays open the decisions of one stored session, which is read once."""

    def __init__(self, archive: SessionRepository, number: int) -> None:
        """Read the session of this number; raises UserInputError if no game was dealt in it.

        Events that cannot be read are passed over.
        """
        self._number = number
        self._events = archive.readable_events(number)
        self.broken = archive.broken_events(number)
        """What is not as it was recorded, so that decisions may come out otherwise."""
        game = SessionState.from_events(self._events).game
        if game is None:
            raise UserInputError(f"in session {number} no game was dealt, so there is nothing to explain")
        self._game = game
        self._plan = archive.plan(number)

    @property
    def flips(self) -> tuple[int, ...]:
        """The flips (from 1) that have a decision.

        In a condition without help they are all flips, as the table had its values all the same.
        """
        return tuple(sorted(self._game.decisions if self._plan.cell.helps else self._game.flips))

    def game_before(self, flip: int) -> Concentration:
        """Return the game as it stood before a flip, with unmatched cards turned back."""
        flips = (each.event.position for number, each in self._game.flips.items() if number < flip)
        return game_after(self._game.board, flips)

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
