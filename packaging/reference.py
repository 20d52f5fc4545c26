"""Write the pages of the documentation that are made from the code.

``python packaging/reference.py`` writes them all; tests/test_docs.py compares them with what the code gives.
"""

import sys
from collections.abc import Callable
from pathlib import Path

from kiosk.cli.composition import DATA
from kiosk.cli.guide import commands_page
from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.study.reference import as_page

DOCS = Path(__file__).resolve().parent.parent / "docs"


GENERATED: dict[str, Callable[[], str]] = {
    "reference/commands.md": lambda: commands_page(recollect, DATA),
    "reference/study-file.md": lambda: as_page(Settings),
}
"""What gives each page that is generated, by its place in the documentation."""


def main() -> int:
    """Write every page that is not as the code gives it, and print which."""
    for name, page in GENERATED.items():
        text, file = page(), DOCS / name
        if not file.exists() or file.read_text("utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"{file} was written.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
