"""Where cards, sentences, questionnaires and policies lie, shipped or beside a study file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ENDINGS = {"questionnaires": ".toml", "policies": ".json"}
"""What goes by a name is a file with this ending; anything else is a folder."""


@dataclass(frozen=True)
class Located:
    """Where something lies that goes by a name; ``unused`` is what has the same name beside the study file."""

    path: Path
    is_shipped: bool = False
    unused: Path | None = None


PICTURES = (".svg", ".png", ".jpg", ".jpeg", ".webp")
"""The endings of the pictures that a card can have."""


def pictures_in(folder: Path) -> dict[str, Path]:
    """Map the cards of a deck to their pictures, in alphabetical order; a card is called as its file is.

    Of two files with the same name the first is taken; `recollect study check` reports the other.
    """
    found: dict[str, Path] = {}
    for file in files_in(folder):
        if file.suffix.lower() in PICTURES:
            found.setdefault(file.stem, file)
    return found


def files_in(folder: Path) -> list[Path]:
    """List the files of a folder that are not hidden, by name; none if it cannot be read."""
    try:
        files = [file for file in folder.iterdir() if not file.name.startswith(".") and file.is_file()]
    except OSError:
        return []
    return sorted(files, key=lambda file: (file.stem, file.name))


def is_path(name: str) -> bool:
    """Return whether a name is a path: it has a slash, begins with a dot, or has an ending."""
    return "/" in name or "\\" in name or name.startswith(".") or bool(Path(name).suffix)


def code_of(name: str) -> str:
    """Return the language code in the name of a language, which may be a path.

    Without a code it is the name itself.
    """
    from kiosk.language_codes import is_right, standard  # noqa: PLC0415 - Babel is not needed to find a folder

    last = Path(name.replace("\\", "/")).name
    return standard(last) if is_right(last) else last


def shipped_names(kind: str) -> dict[str, Path]:
    """Map the names of everything shipped of this kind to its path."""
    ending = ENDINGS.get(kind, "")
    folder = POLICIES if kind == "policies" else ASSETS / kind
    there = (path for path in sorted(folder.glob(f"*{ending}")) if is_there(path, ending))
    return {path.name.removesuffix(ending): path for path in there}


def shipped_place(kind: str, name: str) -> Path | None:
    """Return where something shipped of this kind lies; None if there is nothing of that name."""
    there = shipped_names(kind)
    if kind == "sentences":
        return next((path for each, path in there.items() if code_of(each) == code_of(name)), None)
    return there.get(name)


def is_there(path: Path, ending: str) -> bool:
    """Return whether there is such a file or, without an ending, such a folder."""
    try:
        return path.is_file() if ending else path.is_dir()
    except (OSError, ValueError):
        # No file can have such a name.
        return False


def beside_or_inside(name: str) -> Path:
    """Return a folder that stands inside the installed package, or beside it in a checkout."""
    package = Path(__file__).parent
    return package / name if (package / name).is_dir() else package.parent / name


ASSETS = beside_or_inside("assets")

POLICIES = beside_or_inside("policies")


def policy_path(name: str) -> Path:
    """Return the file of a shipped policy by its name, or the path itself."""
    shipped = None if is_path(name) else shipped_place("policies", name)
    return Path(name) if shipped is None else shipped
