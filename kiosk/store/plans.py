"""Frozen plans and looks: rows of the append-only audit log, which a later report can check."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from kiosk import UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.database import has_database, open_for_reading
from kiosk.store.recorder import Recorder
from kiosk.units import MS_PER_SECOND

PLAN_FROZEN = "PlanFrozen"
LOOK_TAKEN = "LookTaken"


@dataclass(frozen=True, slots=True)
class FrozenPlan:
    """A plan that was frozen in a data folder; ``frozen_at`` is in UTC.

    ``before_first_session`` says whether that was before any session of the study; ``looks`` are the participants an
    arm at each look that was taken under it.
    """

    sha256: str
    frozen_at: str
    text: str
    before_first_session: bool
    looks: tuple[int, ...] = ()


def frozen_plans(folder: Path) -> tuple[FrozenPlan, ...]:
    """Return the plans that were frozen in a data folder, oldest first; none where there is no database."""
    if not has_database(folder):
        return ()
    with closing(open_for_reading(folder)) as connection:
        query = "SELECT wall_ms, payload FROM audit_event WHERE type = ? ORDER BY id"
        frozen = connection.execute(query, (PLAN_FROZEN,)).fetchall()
        looks = [json.loads(payload) for _, payload in connection.execute(query, (LOOK_TAKEN,))]
        first = connection.execute(
            "SELECT min(started_at) FROM session WHERE kind = ?", (int(SessionKind.STUDY),)
        ).fetchone()[0]
    began = datetime.fromisoformat(first) if first is not None else None
    return tuple(
        _frozen(datetime.fromtimestamp(ms / MS_PER_SECOND, UTC), payload, looks, began) for ms, payload in frozen
    )


def _frozen(at: datetime, payload: str, looks: Sequence[dict[str, Any]], began: datetime | None) -> FrozenPlan:
    """One row of the audit log, with the looks that were taken under it."""
    told = json.loads(payload)
    own = tuple(look["per_arm"] for look in looks if look["sha256"] == told["sha256"])
    return FrozenPlan(told["sha256"], at.isoformat(), told["plan"], began is None or at <= began, own)


def freeze_plan(folder: Path, sha256: str, text: str) -> FrozenPlan:
    """Write a plan into the audit log of a data folder, for good.

    Raises UserInputError once the study has a session, as a plan that is frozen then proves nothing, and for a plan
    that is frozen already.
    """
    frozen = frozen_plans(folder)
    if any(plan.sha256 == sha256 for plan in frozen):
        raise UserInputError(f"this plan is frozen in {folder} already")
    sessions = sum(games_per_condition(folder, (), finished=False).values())
    if sessions:
        raise UserInputError(f"{folder} holds {sessions} sessions of the study: a plan is frozen before the first")
    with Recorder(folder) as recorder:
        recorder.add_audit_event(PLAN_FROZEN, {"sha256": sha256, "plan": text})
    return frozen_plans(folder)[-1]


def games_per_condition(folder: Path, conditions: Sequence[str], *, finished: bool = True) -> dict[str, int]:
    """How many sessions of the study there are in each condition, with a finished game or at all; no results."""
    counts = dict.fromkeys(conditions, 0)
    if not has_database(folder):
        return counts
    query = "SELECT condition, count(*) FROM session WHERE kind = ?"
    if finished:
        query += " AND EXISTS (SELECT 1 FROM event WHERE event.session = session.id AND type = 'GameFinished')"
    with closing(open_for_reading(folder)) as connection:
        rows = connection.execute(query + " GROUP BY condition", (int(SessionKind.STUDY),)).fetchall()
    return counts | {str(condition): int(count) for condition, count in rows}


def record_look(folder: Path, sha256: str, per_arm: int) -> None:
    """Write down that the data were looked at, under which plan and with how many participants an arm."""
    with Recorder(folder) as recorder:
        recorder.add_audit_event(LOOK_TAKEN, {"sha256": sha256, "per_arm": per_arm})
