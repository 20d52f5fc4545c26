"""The Debian package of a built folder: what goes where in the system, and what it needs from Debian.

It is put together and handed to dpkg-deb. Data are the user's own and in no package: removing it leaves them.
"""

import gzip
import re
import shutil
import subprocess
from pathlib import Path

import notices
from bootstrap import QT, VOICE, WINDOW

from kiosk import __version__

LINUX = Path(__file__).resolve().parent / "linux"
ROOT = LINUX.parent.parent
PLACES = {
    LINUX / "recollect.service": "usr/lib/systemd/user/recollect.service",
    LINUX / "recollect-cage@.service": "usr/lib/systemd/system/recollect-cage@.service",
    LINUX / "recollect-cage": "usr/bin/recollect-cage",
    LINUX / "recollect.desktop": "usr/share/applications/recollect.desktop",
    LINUX / "recollect-autostart.desktop": "usr/share/doc/recollect/examples/recollect-autostart.desktop",
    ROOT / "assets" / "icon.svg": "usr/share/icons/hicolor/scalable/apps/recollect.svg",
    ROOT / "LICENSE": "usr/share/doc/recollect/copyright",
    ROOT / "assets" / "CREDITS.md": "usr/share/doc/recollect/CREDITS.md",
}
PROGRAM = "usr/lib/recollect"
DOCUMENTS = "usr/share/doc/recollect"

CONTROL = """\
Package: recollect
Version: {version}
Architecture: {architecture}
Maintainer: The Recollect maintainers <maintainers@localhost>
Section: science
Priority: optional
Installed-Size: {kilobytes}
Depends: libc6 (>= {libc}), {depends}
Recommends: cage, xwayland
Description: kiosk for studies in which a robot helps a person play Concentration
 A visitor sits down and plays Concentration, the memory game of 24 cards. A
 social robot, or an avatar on the screen, helps. Recollect runs such studies
 unattended and records everything. It brings its own Python and Qt.
"""


def debian_version(version: str) -> str:
    """Return a version of Python's as Debian sorts it: 0.2.0rc1 is 0.2.0~rc1, which comes before 0.2.0."""
    return re.sub(r"\.?(a|b|rc|dev)(?=\d)", r"~\1", version)


def package(built: Path, work: Path, place: Path, level: int) -> Path:
    """Make the package of a built folder, compressed at a level of zstd, in ``place``; return its file."""
    tree = work / "deb"
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(built, tree / PROGRAM, symlinks=True)
    (tree / DOCUMENTS).mkdir(parents=True)
    (tree / PROGRAM / notices.FOLDER).rename(tree / DOCUMENTS / notices.FOLDER)
    for source, target in PLACES.items():
        _put(source.read_bytes(), tree / target)
    _put(gzip.compress((LINUX / "recollect.1").read_bytes(), mtime=0), tree / "usr/share/man/man1/recollect.1.gz")
    (tree / "usr/bin/recollect").symlink_to("../lib/recollect/recollect")
    architecture = _say("dpkg", "--print-architecture")
    _put(_control(tree, architecture).encode(), tree / "DEBIAN" / "control")
    _set_modes(tree)
    file = place / f"recollect_{debian_version(__version__)}_{architecture}.deb"
    # Level 19 would take a minute or more, for a tenth less than level 9.
    _say("dpkg-deb", "--root-owner-group", "-Zzstd", f"-z{level}", "--build", str(tree), str(file))
    return file


def _control(tree: Path, architecture: str) -> str:
    size = sum(file.stat().st_size for file in tree.rglob("*") if file.is_file() and not file.is_symlink())
    return CONTROL.format(
        version=debian_version(__version__),
        architecture=architecture,
        kilobytes=size // 1024,
        libc=_say("getconf", "GNU_LIBC_VERSION").split()[-1],
        depends=", ".join(f"{QT} {WINDOW} {VOICE}".split()),
    )


def _set_modes(tree: Path) -> None:
    """Set the modes that files of a system have, regardless of the builder's mask."""
    for path in (tree, *tree.rglob("*")):
        if not path.is_symlink():
            runs = path.is_dir() or path in {tree / PROGRAM / "recollect", tree / "usr/bin/recollect-cage"}
            path.chmod(0o755 if runs else 0o644)


def _put(content: bytes, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)


def _say(*command: str) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
