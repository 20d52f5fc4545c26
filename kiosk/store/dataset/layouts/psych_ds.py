"""Psych-DS: data/*_data.csv, each with a sidecar, and dataset_description.json with every column of all of them."""

from __future__ import annotations

from pathlib import Path

from kiosk.store.dataset import codebook, prose
from kiosk.store.dataset.files import CsvFile, write_json, write_text
from kiosk.store.dataset.layouts.layout import TASK, Contents, Layout
from kiosk.store.dataset.layouts.materials import write_materials
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.flow import Flow


class PsychDs(Layout):
    """The tables as they are, one file each."""

    def __init__(self, root: Path, contents: Contents) -> None:
        """Begin every table."""
        super().__init__(root, contents)
        (root / "data").mkdir()
        self._files = {shape.name: CsvFile(root / file_of(shape.name), shape.names) for shape in contents.tables.shapes}

    def add(self, kept: Kept) -> None:
        """Write what one sitting adds to the tables."""
        for table in self.contents.tables.sittings:
            self._files[table.name].write(table.cells(kept))

    def finish(self, flows: tuple[Flow, ...]) -> None:
        """Write the flow, and all that describes the tables."""
        flow = self.contents.tables.flow
        self._files[flow.name].write(flow.cells(flows))
        shapes, root = self.contents.tables.shapes, self.root
        write_json(root / "dataset_description.json", self._described() | codebook.measured(shapes))
        write_json(root / "data" / "file_metadata.json", codebook.CONTEXT | {"encodingFormat": "text/csv"})
        for shape in shapes:
            own = {"name": shape.name, "description": shape.about} | codebook.measured([shape])
            write_json((root / file_of(shape.name)).with_suffix(".json"), codebook.CONTEXT | own)
        files = {shape.name: file_of(shape.name) for shape in shapes}
        write_text(root / "documentation" / "codebook.md", codebook.markdown(shapes, files))
        write_text(root / "README.md", prose.readme(self.contents.study, shapes, files, self.contents.extras))
        write_text(root / "CHANGES.md", prose.CHANGES)
        write_text(root / ".psychdsignore", prose.PSYCHDSIGNORE)
        write_text(root / "analysis" / "example.py", prose.EXAMPLE)
        write_text(root / "results" / "README.md", prose.RESULTS)
        write_text(root / "materials" / "README.md", prose.MATERIALS)
        write_materials(root / "materials", self.contents.study)

    def close(self) -> None:
        """Let go of all files."""
        for file in self._files.values():
            file.close()

    def _described(self) -> dict[str, object]:
        study = self.contents.study
        return codebook.CONTEXT | {
            "name": study.title,
            "description": prose.abstract(study, self.contents.extras),
            "keywords": list(prose.KEYWORDS),
            "inLanguage": list(study.languages),
        }


def file_of(table: str) -> str:
    """Where a table is, seen from the data set's folder."""
    return f"data/task-{TASK}_description-{table}_data.csv"
