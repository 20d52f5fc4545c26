"""Export a data folder as a data set that can be published."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from kiosk import UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.export.columns import ExportOption
from kiosk.export.flow import FlowQuantity, ParticipantFlow
from kiosk.export.layouts import DatasetContents, Layout, PsychDs
from kiosk.export.new_files import new_folder
from kiosk.export.parallel import WORTH_IT, ExportTask, written_elsewhere
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import all_tables
from kiosk.garbage import rare_collections
from kiosk.store.plans import frozen_plans
from kiosk.store.session_records import RecordSource, open_records, shuffling_secret

_KINDS = {ExportOption.REHEARSALS: SessionKind.SIMULATED, ExportOption.TRIALS: SessionKind.TRIAL}
"""The kinds of sessions that are exported for those who ask for them."""


@dataclass(frozen=True)
class Exported:
    """What was written: how many sessions, and how many were left out for the one reason or the other.

    ``cautions`` say what was not the same for all of them.
    """

    participants: int
    not_shared: int
    under_way: int
    trials: int = 0
    cautions: tuple[str, ...] = ()

    def to_json(self) -> dict[str, int | list[str]]:
        """Return the same as the command line prints it; cautions only where there are any."""
        told = asdict(self) | {"cautions": list(self.cautions)}
        return told if self.cautions else {key: value for key, value in told.items() if key != "cautions"}


def export_dataset(  # noqa: PLR0913 - each is asked for by itself
    data: Path,
    out: Path,
    layout: Callable[[Path, DatasetContents], Layout],
    extras: frozenset[ExportOption] = frozenset(),
    tell: Callable[[int, int], None] | None = None,
    *,
    shuffled_ids: bool = False,
    processes: int = 1,
) -> Exported:
    """Write the data set of the data folder ``data`` into the new folder ``out``.

    ``tell`` hears how many sessions are done, of how many. Several ``processes`` write the same, and help where there
    are many sessions and the layout is Psych-DS. Names of participants are shuffled if that is asked for
    here or by the settings of any session. Raises UserInputError if there is nothing to export, ``out`` cannot be
    used, or dates are asked for, which tell the order that shuffling hides.
    """
    kinds = frozenset({SessionKind.STUDY, *(kind for extra, kind in _KINDS.items() if extra in extras)})
    with rare_collections(), open_records(data, kinds) as stored, new_folder(out) as folder:
        study = StudyMaterials(stored.plans())
        if shuffled_ids or study.asks_for_shuffled_ids:
            if ExportOption.DATES in extras:
                raise UserInputError("dates tell the order of the sessions, which shuffled_ids hides; export without")
            stored.secret = shuffling_secret(data)
            study = replace(study, shuffled=True)
        contents = DatasetContents(study, all_tables(study, extras), extras, frozen_plans(data))
        flows = {kind: ParticipantFlow(kind, stored.archive.counts(kind=kind)) for kind in sorted(kinds)}
        with closing(layout(folder, contents)) as writing:
            wanted = len(stored)
            if processes > 1 and wanted >= WORTH_IT and isinstance(writing, PsychDs):
                writes = _with_help(stored, writing, flows, data, processes)
            else:
                writes = _alone(stored, writing, flows)
            for done in writes:
                if tell is not None:
                    tell(done, wanted)
            writing.finish(tuple(flows.values()))
        return replace(_exported(flows, data, stored), cautions=(*study.cautions, *stored.cautions()))


def _alone(stored: RecordSource, writing: Layout, flows: Mapping[SessionKind, ParticipantFlow]) -> Iterator[int]:
    """Write all sessions in this process, and yield how many are done."""
    for done, kept in enumerate(stored, 1):
        if flows[kept.kind].counted(kept, unshared=ExportOption.UNSHARED in writing.contents.extras):
            writing.add(kept)
        yield done


def _with_help(
    stored: RecordSource, writing: PsychDs, flows: Mapping[SessionKind, ParticipantFlow], data: Path, processes: int
) -> Iterator[int]:
    """Do the same with other processes, which work out the tables; this one writes them in the same order."""
    contents = writing.contents
    task = ExportTask(data, stored.kinds, stored.plan_numbers(), contents.study.shuffled, contents.extras)
    for done, written in enumerate(written_elsewhere(task, stored, processes), 1):
        if written.unbroken:
            stored.found_unbroken(written.number)
        flows[written.kind].seen.update(written.seen)
        writing.put(written.texts)
        yield done


def _exported(flows: dict[SessionKind, ParticipantFlow], data: Path, stored: RecordSource) -> Exported:
    """Return what was written; raises UserInputError if it is nothing."""

    def total(quantity: FlowQuantity) -> int:
        return sum(count for flow in flows.values() for (what, _), count in flow.seen.items() if what is quantity)

    exported = Exported(total(FlowQuantity.EXPORTED), total(FlowQuantity.NOT_SHARED), total(FlowQuantity.NOT_ENDED))
    exported = replace(exported, trials=stored.left_out(SessionKind.TRIAL))
    if not exported.participants:
        raise UserInputError(f"there is no session in {data} to export ({_why_none(exported, stored)})")
    return exported


def _why_none(exported: Exported, stored: RecordSource) -> str:
    if exported.not_shared:
        return "no participant agreed to publishing"
    if exported.under_way:
        return "the only ones are still under way"
    left_out = [extra.value for extra, kind in _KINDS.items() if stored.left_out(kind)]
    if not left_out:
        return "it is empty"
    return f"it holds no participant; {', '.join(f'{each} are left out without --with-{each}' for each in left_out)}"
