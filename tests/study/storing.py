"""Store and export a session of any study, as the kiosk would."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path

from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.session_config import SessionConfig
from kiosk.export.bids import Bids
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import verify
from tests.experiment.driver import Driver
from tests.export.psych_ds import issues

EXTRAS = frozenset({ExportOption.TEXTS, ExportOption.DATES, ExportOption.AGES, ExportOption.UNSHARED})


def store_and_export(plan: SessionConfig, driver: Driver, folder: Path) -> None:
    """Write a session into this folder, read it back, and export all its tables in both layouts."""
    shutil.rmtree(folder, ignore_errors=True)
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(plan, 1, "avatar", "abc123", kind=SessionKind.STUDY), driver.events)
    assert verify(folder) == []
    with open_repository(folder) as stored:
        assert stored.readable_story(1) == driver.events
        assert stored.plan(1).questionnaires == plan.questionnaires
    hidden = plan.settings.privacy.shuffled_ids
    extras = EXTRAS - ({ExportOption.DATES} if hidden else set())
    for layout in (PsychDs, Bids):
        out = folder / layout.__name__
        export_dataset(folder, out, layout, extras)
        for table in out.rglob("*.[ct]sv"):
            with table.open(encoding="utf-8", newline="") as opened:
                rows = list(csv.reader(opened, delimiter="\t" if table.suffix == ".tsv" else ","))
            names = [name.casefold() for name in rows[0]]
            assert len(names) == len(set(names)), f"{table.name} has two columns of one name"
            assert {len(row) for row in rows} == {len(names)}, table.name
    assert issues(folder / PsychDs.__name__) == []
