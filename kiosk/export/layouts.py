"""How a data set is laid out on disk: what every layout has, and the one of Psych-DS."""

from __future__ import annotations

import hashlib
import json
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from kiosk.config import Settings
from kiosk.experiment.session_config import SessionConfig
from kiosk.export import codebook, readme_text
from kiosk.export.columns import ExportOption
from kiosk.export.flow import ParticipantFlow
from kiosk.export.new_files import CsvFile, csv_texts, write_json, write_text
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import DatasetTables
from kiosk.store.plans import FrozenPlan
from kiosk.store.session_records import SessionRecord

TASK = "concentration"


@dataclass(frozen=True)
class DatasetContents:
    """What a data set is made of, but for the sessions."""

    study: StudyMaterials
    tables: DatasetTables
    extras: frozenset[ExportOption]
    frozen: tuple[FrozenPlan, ...] = ()


class Layout(ABC):
    """Writes a data set into a folder, session by session."""

    def __init__(self, root: Path, contents: DatasetContents) -> None:
        """Begin the files that sessions are added to."""
        self.root = root
        self.contents = contents

    @abstractmethod
    def add(self, kept: SessionRecord) -> None:
        """Write what one session adds to the tables."""

    @abstractmethod
    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:
        """Write what can only be told at the end, and all that describes the tables."""

    @abstractmethod
    def close(self) -> None:
        """Let go of all files, whether or not everything was written."""


PUBLISHED = frozenset(
    {
        "title",
        "languages",
        "stages",
        "about_you",
        "questionnaires",
        "game",
        "practice",
        "assistance",
        "conditions",
        "timing",
        "idle_ms",
        "voice",
        "screen",
        "privacy",
    }
)
"""The parts of a study file that say nothing of people, devices, keys or seeds; a new part is not among them."""

_PARTLY: dict[str, bool | set[str]] = {"randomisation": {"target_n", "block_size"}, "consent": {"adult"}}
"""What else is said of other parts: who wants to analyse an allocation as it was made has to know its blocks."""

PLANS = Path("materials", "plans", "plans.json")
"""The plans that were frozen in the data folder; only a data set that has one has this file."""

_SHOWN = 12
"""Characters of a hash in a file's name."""


def write_materials(folder: Path, study: StudyMaterials) -> None:
    """Write everything once, however many sessions followed it."""
    for name, content in {material for plan in study.plans for material in _materials(plan)}:
        write_text(folder / name, content)


def plan_file(sha256: str) -> str:
    """Return what the file of a frozen plan is called."""
    return f"plan-{sha256[:_SHOWN]}.toml"


def write_plans(root: Path, plans: Sequence[FrozenPlan]) -> None:
    """Write the plans that were frozen, and what a reader must know of each; no dates."""
    if not plans:
        return
    for plan in plans:
        write_text(root / PLANS.with_name(plan_file(plan.sha256)), plan.text)
    told = [
        {"sha256": plan.sha256, "before_first_session": plan.before_first_session, "looks": list(plan.looks)}
        for plan in plans
    ]
    write_json(root / PLANS, told)


def _materials(plan: SessionConfig) -> Iterator[tuple[str, str]]:
    for questionnaire in (plan.about_you, *plan.questionnaires):
        yield _file(f"questionnaires/{questionnaire.id}", questionnaire.sha256), _pretty(questionnaire)
    yield _file(f"information/{plan.language}", plan.information.sha256), _pretty(plan.information)
    yield _file("policies/policy", plan.policy.sha256), plan.policy.to_json()
    yield _file("settings/settings", plan.settings.sha256), _published(plan.settings)
    decks = json.dumps({"game": plan.deck, "practice": plan.practice_deck}, ensure_ascii=False, indent=2) + "\n"
    yield _file("decks/decks", hashlib.sha256(decks.encode()).hexdigest()), decks


def _file(name: str, sha256: str) -> str:
    return f"{name}-{sha256[:_SHOWN]}.json"


def _pretty(content: BaseModel) -> str:
    return content.model_dump_json(indent=2) + "\n"


def _published(settings: Settings) -> str:
    told: dict[str, Any] = json.loads(settings.model_dump_json(include=_PARTLY | dict.fromkeys(PUBLISHED, True)))
    return json.dumps(told, ensure_ascii=False, indent=2) + "\n"


class PsychDs(Layout):
    """The tables as they are, one file each."""

    def __init__(self, root: Path, contents: DatasetContents) -> None:
        """Begin every table."""
        super().__init__(root, contents)
        (root / "data").mkdir()
        self._files = {shape.name: CsvFile(root / file_of(shape.name), shape.names) for shape in contents.tables.shapes}

    def add(self, kept: SessionRecord) -> None:
        """Write what one session adds to the tables."""
        self.put(csv_texts(self.contents.tables, kept))

    def put(self, texts: Mapping[str, str]) -> None:
        """Write what ``csv_texts`` made of one session."""
        for name, text in texts.items():
            self._files[name].append(text)

    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:
        """Write the flow, and all that describes the tables."""
        flow = self.contents.tables.flow
        self._files[flow.name].write(flow.cells(flows))
        shapes, root = self.contents.tables.shapes, self.root
        write_json(root / "dataset_description.json", self._described() | codebook.variables_measured(shapes))
        write_json(root / "data" / "file_metadata.json", codebook.CONTEXT | {"encodingFormat": "text/csv"})
        for shape in shapes:
            own = {"name": shape.name, "description": shape.about} | codebook.variables_measured([shape])
            write_json((root / file_of(shape.name)).with_suffix(".json"), codebook.CONTEXT | own)
        files = {shape.name: file_of(shape.name) for shape in shapes}
        write_text(root / "documentation" / "codebook.md", codebook.codebook_markdown(shapes, files))
        write_text(
            root / "README.md", readme_text.dataset_readme(self.contents.study, shapes, files, self.contents.extras)
        )
        write_text(root / "CHANGES.md", readme_text.CHANGES)
        write_text(root / ".psychdsignore", readme_text.PSYCHDSIGNORE)
        write_text(root / "analysis" / "example.py", readme_text.EXAMPLE)
        write_text(root / "results" / "README.md", readme_text.RESULTS)
        write_text(root / "materials" / "README.md", readme_text.MATERIALS)
        write_materials(root / "materials", self.contents.study)
        write_plans(root, self.contents.frozen)

    def close(self) -> None:
        """Let go of all files."""
        for file in self._files.values():
            file.close()

    def _described(self) -> dict[str, object]:
        study = self.contents.study
        return codebook.CONTEXT | {
            "name": study.title,
            "description": readme_text.dataset_abstract(study, self.contents.extras),
            "keywords": list(readme_text.KEYWORDS),
            "inLanguage": list(study.languages),
            "schemaVersion": codebook.CODEBOOK_VERSION,
        }


def file_of(table: str) -> str:
    """Where a table is, seen from the data set's folder."""
    return f"data/task-{TASK}_description-{table}_data.csv"
