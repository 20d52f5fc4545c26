"""Tables that several processes work out, session by session, in the order in which they are to be written."""

from __future__ import annotations

import signal
from collections import Counter, deque
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from dataclasses import dataclass, replace
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

from kiosk import StorageError
from kiosk.experiment.outcomes import SessionKind
from kiosk.export.columns import ExportOption
from kiosk.export.flow import FlowQuantity, ParticipantFlow
from kiosk.export.new_files import csv_texts
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import DatasetTables, all_tables
from kiosk.garbage import rare_collections
from kiosk.store.participants import EnrolmentCounts
from kiosk.store.session_records import RecordSource, StoredRecord, open_records, shuffling_secret

WORTH_IT = 300
"""With fewer sessions the processes take longer to start than they save."""

_AT_ONCE = 10
"""Sessions that are given to a process together."""
_AHEAD = 3
"""How many of those wait for each process."""


@dataclass(frozen=True)
class ExportTask:
    """What a process has to know before it is given sessions; ``plans`` are sessions that followed each plan."""

    data: Path
    kinds: frozenset[SessionKind]
    plans: tuple[int, ...]
    shuffled: bool
    extras: frozenset[ExportOption]


class WrittenSession(NamedTuple):
    """What a session adds to its flow, and to each table as CSV; nothing if it is left out."""

    number: int
    unbroken: bool
    kind: SessionKind
    seen: Counter[tuple[FlowQuantity, str]]
    texts: dict[str, str]


def written_elsewhere(task: ExportTask, stored: RecordSource, processes: int) -> Iterator[WrittenSession]:
    """Yield all sessions in their order.

    They are as they were at the moment that ``stored`` stands for, though each process reads by itself. Raises
    StorageError if a process dies.
    """
    sessions = stored.stored()
    waiting: deque[Future[list[WrittenSession]]] = deque()
    with ProcessPoolExecutor(processes, get_context("spawn"), _begin, (task,)) as pool:
        try:
            while True:
                while len(waiting) < processes * _AHEAD and (batch := list(islice(sessions, _AT_ONCE))):
                    waiting.append(pool.submit(_written, batch))
                if not waiting:
                    return
                yield from waiting.popleft().result()
        except BrokenProcessPool as error:
            raise StorageError(
                "a process that worked out the tables was ended; is the memory full? Nothing was written"
            ) from error
        finally:
            pool.shutdown(cancel_futures=True)


class _Worker:
    """What one of the processes keeps from one task to the next."""

    def __init__(self, task: ExportTask) -> None:
        self._open = ExitStack()
        self._open.enter_context(rare_collections())
        self.source = self._open.enter_context(open_records(task.data, task.kinds))
        if task.shuffled:
            self.source.secret = shuffling_secret(task.data)
        study = replace(StudyMaterials(self.source.plans_of(task.plans)), shuffled=task.shuffled)
        self.tables: DatasetTables = all_tables(study, task.extras)
        self.unshared = ExportOption.UNSHARED in task.extras

    def written(self, stored: StoredRecord) -> WrittenSession:
        kept = self.source.read(stored)
        flow = ParticipantFlow(kept.kind, EnrolmentCounts({}, {}))
        texts = csv_texts(self.tables, kept) if flow.counted(kept, unshared=self.unshared) else {}
        return WrittenSession(kept.id, kept.unbroken, kept.kind, flow.seen, texts)


_worker: list[_Worker] = []


def _begin(task: ExportTask) -> None:
    # Ctrl+C reaches all of them; the process that gives them work ends them.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _worker.append(_Worker(task))


def _written(sessions: list[StoredRecord]) -> list[WrittenSession]:
    return [_worker[0].written(session) for session in sessions]
