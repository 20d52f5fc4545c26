"""The builds: ``folder``, Recollect with its own Python and Qt in one folder; ``deb``, that folder as a Debian package.

``quick-deb`` is that package with little compression, to try it. ``wheel`` is what pip installs, and its source.

Run in the checkout, with any Python 3.11: it goes on with the one in ``.venv``, which ``bootstrap.py test`` makes.
What is built lies in ``dist``; nothing else is changed but ``build``. How it is trimmed is in ``trim.py``.
"""

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV_PYTHON = ROOT / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
WORK = ROOT / "build" / "pyinstaller"
DIST = ROOT / "dist"
NAME = "recollect"

DATA = {
    "assets": "kiosk/assets",
    "policies": "kiosk/policies",
    "kiosk/ui/qml": "kiosk/ui/qml",
    "kiosk/site": "kiosk/site",
}
"""Folders of the checkout, and where kiosk/places.py looks for them in a build."""
HIDDEN = (
    *("_cffi_backend", "pyttsx3.drivers.espeak", "pyttsx3.drivers.sapi5", "websockets.sync.client"),
    "paho.mqtt.client",
)
"""What is imported by a name that is only known at run time."""
ENGINES = {"py_nanotts": "py-nanotts", "hibari": "hibari-tts"}
"""Speech engines that bring models as data, and their packages; which of them are installed is in the build."""
EXCLUDED = (
    *("numba", "llvmlite", "matplotlib", "scipy", "pandas", "gymnasium", "PIL"),
    # readline is under the GPL, and a kiosk's terminal takes no typing.
    *("readline", "tkinter", "IPython", "pytest", "_pytest", "hypothesis", "setuptools", "pkg_resources", "mypy"),
    # What libraries that are used have for developers: colours of source text, tests, compilers, help pages.
    *("pygments", "markdown_it", "mdurl", "numpy.f2py", "numpy.testing", "yaml"),
    *("unittest", "doctest", "pdb", "pydoc_data"),
    # Extras for a lab's own machine: the wheels of PyAV hold encoders under the GPL, and pylsl has no licence text.
    *("av", "pylsl"),
)


class BuildFailed(Exception):
    """The build cannot go on; the message says why, in words for the person at the keyboard."""


def main(arguments: Sequence[str]) -> int:
    """Build what the first argument says, and return the exit code."""
    kinds = {
        "folder": (folder,),
        "deb": (deb,),
        "quick-deb": (quick_deb,),
        "wheel": (wheel,),
        "all": (folder, deb),
    }
    if len(arguments) != 1 or arguments[0] not in kinds:
        print("Use: python3 packaging/build.py folder|deb|quick-deb|wheel|all", file=sys.stderr)
        return 2
    if importlib.util.find_spec("PyInstaller") is None:
        return _go_on_in_venv(arguments)
    try:
        for build in kinds[arguments[0]]:
            began = time.monotonic()
            print(f"{build()} ({time.monotonic() - began:.0f} s)", flush=True)
    except BuildFailed as failure:
        print(failure, file=sys.stderr)
        return 1
    return 0


def _go_on_in_venv(arguments: Sequence[str]) -> int:
    """Run this file with the Python of the checkout's environment, if that is another one."""
    if not VENV_PYTHON.exists() or Path(sys.prefix) == VENV_PYTHON.parent.parent:
        print("PyInstaller is missing: run python3 packaging/bootstrap.py test first.", file=sys.stderr)
        return 1
    return subprocess.run([VENV_PYTHON, __file__, *arguments], check=False).returncode


def folder() -> str:
    """Build the folder ``dist/recollect``, and say how large it is."""
    import notices  # noqa: PLC0415 - not wanted elsewhere
    import trim  # noqa: PLC0415 - needs PyInstaller

    WORK.mkdir(parents=True, exist_ok=True)
    commit = WORK / "commit.txt"
    commit.write_text(_commit(), encoding="utf-8")
    loops = WORK / "loops.library"
    compiling = [sys.executable, "-m", "kiosk.training.ahead", str(loops)]
    compiled = subprocess.run(compiling, cwd=ROOT, check=False).returncode == 0
    engines = [name for name in ENGINES if importlib.util.find_spec(name) is not None]
    options = [
        *("--name", NAME, "--noconfirm", "--clean", "--log-level", "ERROR", "--noupx", "--console"),
        *("--paths", str(ROOT), "--collect-submodules", "kiosk"),
        *("--distpath", str(DIST), "--workpath", str(WORK), "--specpath", str(WORK)),
        *(
            f"--add-data={ROOT / source}{os.pathsep}{place}"
            for source, place in DATA.items()
            if (ROOT / source).is_dir()
        ),
        f"--add-data={commit}{os.pathsep}kiosk",
        # Games are simulated fast with it; without a C compiler here they are slow there, with the same numbers.
        *([f"--add-data={loops}{os.pathsep}kiosk/training"] if compiled else []),
        *(f"--hidden-import={name}" for name in (*HIDDEN, *engines)),
        *(f"--collect-data={name}" for name in engines),
        # The record tells their versions.
        *(f"--copy-metadata={package}" for package in ("pyttsx3", *(ENGINES[name] for name in engines))),
        *(f"--exclude-module={name}" for name in EXCLUDED),
        # Not --strip: numpy's linear algebra does not survive it.
        *(["--hide-console", "hide-early"] if os.name == "nt" else []),
    ]
    here = ROOT / "packaging"
    command = [sys.executable, str(here / "run_pyinstaller.py"), *options, str(here / "frozen.py")]
    done = subprocess.run(command, cwd=ROOT, check=False)
    if done.returncode:
        raise BuildFailed(f"PyInstaller ended with exit code {done.returncode}.")
    built = DIST / NAME
    before = _megabytes(built)
    trim.trim(built, ROOT)
    try:
        shipped = notices.parts(notices.sources(WORK / NAME / "Analysis-00.toc", built / "_internal"))
    except notices.NoLicence as failure:
        raise BuildFailed(str(failure)) from failure
    notices.write(shipped, built / notices.FOLDER)
    return f"{built.relative_to(ROOT)}: {_megabytes(built)} MB, {before} MB before it was trimmed"


def quick_deb() -> str:
    """Build the same package with little compression, which takes a tenth of the time and a fifth more room."""
    return deb(level=1)


def deb(level: int = 9) -> str:
    """Build the Debian package of the folder, which must be there, and say how large it is."""
    built = DIST / NAME
    if not built.is_dir():
        raise BuildFailed("There is no dist/recollect yet: build the folder first.")
    if shutil.which("dpkg-deb") is None:
        raise BuildFailed("A Debian package is built with dpkg-deb, which is missing here.")
    import debian  # noqa: PLC0415 - not wanted elsewhere

    package = debian.package(built, WORK, DIST, level)
    return f"{package.relative_to(ROOT)}: {_megabytes(package)} MB"


def wheel() -> str:
    """Build the pages, the wheel and the source archive; the same commit gives the same bytes."""
    committed = _of_git("log", "-1", "--format=%ct")
    when = {"SOURCE_DATE_EPOCH": committed} if committed else {}
    site = ("mkdocs", "build", "--strict", "--quiet", "--config-file", "packaging/mkdocs.yml")
    for command in (site, ("hatchling", "build", "-d", str(DIST))):
        environment = os.environ | when | {"NO_MKDOCS_2_WARNING": "1"}
        done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, env=environment, check=False)
        if done.returncode:
            raise BuildFailed(f"{command[0]} ended with exit code {done.returncode}.")
    built = [file for ending in ("whl", "tar.gz") for file in sorted(DIST.glob(f"recollect-*.{ending}"))]
    return "\n".join(f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.relative_to(ROOT)}" for file in built)


def _commit() -> str:
    return _of_git("describe", "--always", "--dirty", "--abbrev=40", "--exclude=*") or "released"


def _of_git(*arguments: str) -> str:
    """Return what git says of the checkout; nothing where it is none."""
    described = subprocess.run(
        ["git", *arguments],  # noqa: S607 - git is on the path
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    return described.stdout.strip()


def _megabytes(path: Path) -> int:
    files = [path] if path.is_file() else [file for file in path.rglob("*") if file.is_file() and not file.is_symlink()]
    return round(sum(file.stat().st_size for file in files) / 1_000_000)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
