"""The notices for what a build ships of others.

Each has a line in ``NOTICES.md``, and its licence's texts beside it.

What is shipped is asked, not listed: PyInstaller tells which files went in, and Python and Debian whose they are.
"""

import ast
import os
import platform
import shutil
import subprocess
import sysconfig
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import Distribution, distributions
from pathlib import Path

FOLDER = "third-party"
INDEX = "NOTICES.md"
OURS = "recollect"

COMMON = Path("/usr/share/common-licenses")
"""Where Debian keeps the texts of licences that many have in common."""
ELSEWHERE = {
    # The one is an addition to the other.
    "LGPL-3": ("LGPL-3", "GPL-3"),
    "APL 2": ("Apache-2.0",),
    "Apache": ("Apache-2.0",),
    "MPL-2.0": ("MPL-2.0",),
}
"""By what a licence is called: the names of its texts there, for who ships none of their own."""
COPIED = {"BINARY", "DATA", "EXTENSION"}
"""What lies in the folder as it was, and may have been trimmed away; all else is within the program itself."""
TEXTS = ("LICEN", "COPYING", "NOTICE", "AUTHORS", "THIRDPARTYNOTICES")
_IN_PACKAGE = 2
"""Parts of the path of a file that lies at the top of its package."""

HEAD = """\
# What Recollect ships of others

Recollect itself comes under the MIT licence; its fonts are named in `CREDITS.md` among its assets. This build
also holds what is listed here. The texts of each licence lie in the folder of that name, or are to be found in Debian,
as the last column says. Qt, PySide6 and shiboken6 are used under LGPL-3.0: they are unchanged, and lie in the build as
files of their own, so that they can be exchanged for others of the same interface.

| name | version | licence | texts |
| --- | --- | --- | --- |
"""


class NoLicence(Exception):
    """Something is shipped whose licence cannot be read; the message says what."""


@dataclass(frozen=True)
class Part:
    """Something of others that is in a build."""

    name: str
    version: str
    licence: str
    texts: Mapping[str, Path]
    """By the names that they get beside the index."""
    where: str = ""
    """Where the texts are to be found besides."""

    @property
    def line(self) -> str:
        """Its line in the index."""
        texts = ", ".join(filter(None, (f"{self.name}/" if self.texts else "", self.where)))
        return f"| {self.name} | {self.version} | {self.licence} | {texts} |\n"


def sources(analysis: Path, inside: Path) -> set[Path]:
    """Return the files that PyInstaller's table of contents names, and the trimmed folder still holds."""
    tables = ast.literal_eval(analysis.read_text(encoding="utf-8"))
    found = set()
    for row in (row for part in tables if isinstance(part, list) for row in part if isinstance(row, tuple)):
        match row:
            case (str(name), str(file), str(kind)) if Path(file).is_absolute():
                if kind not in COPIED or (inside / name).exists():
                    found.add(Path(file).resolve())
    return found


def parts(files: set[Path]) -> list[Part]:
    """Whose these files are, by name; raises NoLicence."""
    of_python = [of_distribution(each) for each in owners(files) if each.name != OURS]
    return sorted([python(), *of_python, *debian(files)], key=lambda part: part.name.lower())


def write(shipped: Iterable[Part], place: Path) -> None:
    """Make a folder of the notices anew."""
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    lines = []
    for part in shipped:
        lines.append(part.line)
        for name, text in part.texts.items():
            copy = place / part.name / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(text, copy)
    (place / INDEX).write_text(HEAD + "".join(lines), encoding="utf-8")


def owners(files: set[Path]) -> Iterator[Distribution]:
    """Yield the distributions of this environment that any of these files belongs to."""
    # Most folders have many files: each is followed to its place once.
    place = cache(os.path.realpath)
    wanted = {(str(file.parent), file.name) for file in files}
    for each in distributions():
        of_it = (os.path.split(each.locate_file(file)) for file in each.files or ())
        if any((place(folder), name) in wanted for folder, name in of_it):
            yield each


def of_distribution(distribution: Distribution) -> Part:
    """Return a Python package; raises NoLicence if neither its texts nor where they are can be told."""
    licence, texts = _licence(distribution), _texts(distribution)
    where = "" if texts else _elsewhere(distribution.name, licence)
    return Part(distribution.name, distribution.version, licence, texts or _common(where), where)


def python() -> Part:
    """Python itself."""
    version = platform.python_version()
    candidates = (
        Path(sysconfig.get_path("stdlib")) / "LICENSE.txt",
        Path(f"/usr/share/doc/python{sysconfig.get_python_version()}/copyright"),
    )
    text = next((candidate for candidate in candidates if candidate.exists()), None)
    if text is None:
        raise NoLicence("The licence of Python itself is not on this machine, so it cannot be shipped.")
    return Part("Python", version, "PSF-2.0", {"LICENSE.txt": text})


def debian(files: set[Path]) -> list[Part]:
    """Return the Debian packages that any of these files belongs to; none where there is no dpkg."""
    if shutil.which("dpkg") is None:
        return []
    # Debian may know a file by its name from before /lib became /usr/lib.
    system = [str(file) for file in files if file.is_relative_to("/usr/lib")]
    names = [*system, *(file.removeprefix("/usr") for file in system)]
    found = _say("dpkg", "-S", *names) if names else ""
    packages = {line.split(": ")[0].split(":")[0] for line in found.splitlines() if ": " in line}
    return [_of_package(name) for name in packages]


def _of_package(name: str) -> Part:
    text = Path("/usr/share/doc") / name / "copyright"
    version = _say("dpkg-query", "-W", "-f", "${Version}\n", name).splitlines()[0]
    texts = {"copyright": text} if text.exists() else {}
    return Part(name, version, "as in its copyright file", texts, f"{text} in Debian")


def _licence(distribution: Distribution) -> str:
    """Return what a distribution calls its licence, in one line."""

    def said(field: str) -> list[str]:
        return distribution.metadata.get_all(field) or []

    named = [each.split(" :: ")[-1] for each in said("Classifier") if each.startswith("License ::")]
    candidates = (*said("License-Expression"), *said("License"), ", ".join(named))
    # Some put the whole text where the name belongs.
    one_line = (each for each in candidates if each and "\n" not in each and each != "UNKNOWN")
    return next(one_line, "as in its texts")


def _texts(distribution: Distribution) -> dict[str, Path]:
    """Return the licence files among what a distribution says of itself, by their places within it.

    Where it says nothing, those that lie in its package are taken.
    """
    said, beside = {}, {}
    for file in distribution.files or ():
        is_text = file.name.upper().startswith(TEXTS)
        if file.parts[0].endswith(".dist-info") and ("licenses" in file.parts or is_text):
            said["/".join(part for part in file.parts[1:] if part != "licenses")] = Path(str(file.locate()))
        elif is_text and len(file.parts) == _IN_PACKAGE and file.suffix in {"", ".txt", ".md"}:
            beside[file.name] = Path(str(file.locate()))
    return said or beside


def _elsewhere(name: str, licence: str) -> str:
    texts = next((texts for called, texts in ELSEWHERE.items() if called in licence), None)
    if texts is None:
        raise NoLicence(
            f"{name} comes without the text of its licence ({licence}), and packaging/notices.py knows none."
        )
    return " and ".join(f"{COMMON / text} in Debian" for text in texts)


def _common(where: str) -> dict[str, Path]:
    """Return the texts that are to be found there, where this machine has them."""
    named = (Path(word) for word in where.split() if word.startswith(f"{COMMON}/"))
    return {text.name: text for text in named if text.exists()}


def _say(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout
