"""Writes the data set of a data folder: sitting by sitting, and as a whole or not at all."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from kiosk import BadInput
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.files import new_folder
from kiosk.store.dataset.layouts.layout import Contents, Layout
from kiosk.store.dataset.stored.followed import Followed
from kiosk.store.dataset.stored.kept import Kept, Source, source
from kiosk.store.dataset.tables.every import every
from kiosk.store.dataset.tables.flow import Flow, Quantity
from kiosk.study.session_kind import SessionKind

_KINDS = {Extra.REHEARSALS: SessionKind.SIMULATED, Extra.TRIALS: SessionKind.TRIAL}
"""The kinds of sittings that are exported for those who ask for them."""


@dataclass(frozen=True)
class Exported:
    """What was written: how many sittings, and how many were left out for the one reason or the other.

    ``cautions`` say what was not the same for all of them.
    """

    participants: int
    not_shared: int
    under_way: int
    trials: int = 0
    cautions: tuple[str, ...] = ()

    def to_json(self) -> dict[str, int | list[str]]:
        """The same as the command line prints it; cautions only where there are any."""
        told = asdict(self) | {"cautions": list(self.cautions)}
        return told if self.cautions else {key: value for key, value in told.items() if key != "cautions"}


def export(
    data: Path,
    out: Path,
    layout: Callable[[Path, Contents], Layout],
    extras: frozenset[Extra] = frozenset(),
    tell: Callable[[int, int], None] | None = None,
) -> Exported:
    """Write the data set of the data folder ``data`` into the new folder ``out``.

    ``tell`` hears how many sittings are done, of how many. Raises BadInput, and writes nothing, if there is nothing to
    export or ``out`` cannot be used.
    """
    kinds = frozenset({SessionKind.STUDY, *(kind for extra, kind in _KINDS.items() if extra in extras)})
    with source(data, kinds) as stored, new_folder(out) as folder:
        study = Followed(stored.plans())
        contents = Contents(study, every(study, extras), extras)
        flows = {kind: Flow(kind, stored.archive.counts(simulated=kind)) for kind in sorted(kinds)}
        with closing(layout(folder, contents)) as writing:
            wanted = len(stored)
            for done, kept in enumerate(stored, 1):
                _add(kept, writing, flows[kept.kind], extras)
                if tell is not None:
                    tell(done, wanted)
            writing.finish(tuple(flows.values()))
        return replace(_exported(flows, data, stored), cautions=study.cautions)


def _add(kept: Kept, writing: Layout, flow: Flow, extras: frozenset[Extra]) -> None:
    if kept.status is None:
        flow.left_out(kept, Quantity.NOT_ENDED)
    elif not kept.publishable and Extra.UNSHARED not in extras:
        flow.left_out(kept, Quantity.NOT_SHARED)
    else:
        writing.add(kept)
        flow.exported(kept)


def _exported(flows: dict[SessionKind, Flow], data: Path, stored: Source) -> Exported:
    """What was written; raises BadInput if it is nothing."""

    def total(quantity: Quantity) -> int:
        return sum(count for flow in flows.values() for (what, _), count in flow.seen.items() if what is quantity)

    exported = Exported(total(Quantity.EXPORTED), total(Quantity.NOT_SHARED), total(Quantity.NOT_ENDED))
    exported = replace(exported, trials=stored.left_out(SessionKind.TRIAL))
    if not exported.participants:
        raise BadInput(f"there is no sitting in {data} to export ({_why_none(exported, stored)})")
    return exported


def _why_none(exported: Exported, stored: Source) -> str:
    if exported.not_shared:
        return "nobody agreed to publishing"
    if exported.under_way:
        return "the only ones are still under way"
    left_out = [extra.value for extra, kind in _KINDS.items() if stored.left_out(kind)]
    if not left_out:
        return "it is empty"
    return f"it holds no participant; {', '.join(f'{each} are left out without --with-{each}' for each in left_out)}"
