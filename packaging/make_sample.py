"""Make the sample data set of the pages: simulated visitors of the template ``fair``, exported, with their report.

Run it without arguments, with Recollect installed, after the columns of an export have changed. It takes a few minutes
and writes ``docs/sample``.
"""

import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

SAMPLE = Path(__file__).resolve().parent.parent / "docs" / "sample"
NAME = "memory-at-the-fair"
VISITORS = 60
SEED = 7
TIME = (2026, 1, 1, 0, 0, 0)  # of every file in the archive


def recollect(*arguments: object) -> None:
    """Run a command of the program; it raises if the command fails."""
    subprocess.run([sys.executable, "-m", "kiosk", *map(str, arguments)], check=True)


def main() -> None:
    """Rehearse a day, export and analyse it, and put both into the pages."""
    os.environ |= {"QT_QPA_PLATFORM": "offscreen", "QT_QUICK_BACKEND": "software"}
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder)
        study, data = here / "study" / "study.toml", here / "data"
        titled = ("--title", "Memory at the fair", "--contact", "lab@university.test")
        recollect("study", "new", study.parent, "--template", "fair", *titled)
        day = ("--sessions", VISITORS, "--seed", SEED)
        recollect("rehearse", "--headless", "--study", study, "--data", data, *day)
        recollect("export", "--data", data, "--out", here / NAME, "--with-rehearsals")
        recollect("report", here / NAME, "--out", here / "report")
        SAMPLE.mkdir(exist_ok=True)
        (SAMPLE / "report.html").write_bytes((here / "report" / "report.html").read_bytes())
        with zipfile.ZipFile(SAMPLE / f"{NAME}.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
            for file in sorted((here / NAME).rglob("*")):
                if file.is_file():
                    archive.writestr(zipfile.ZipInfo(file.relative_to(here).as_posix(), TIME), file.read_bytes())


if __name__ == "__main__":
    main()
