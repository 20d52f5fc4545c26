"""The set-up of Recollect, in one file that needs Python 3.11 and nothing else.

``start`` installs what is missing and opens the kiosk, or rehearses one session where there is no screen. ``check``,
``fast``, ``test`` and ``docs`` are for work on Recollect, and install the development extras as well. ``lock`` resolves
the versions anew, and ``packages`` prints the Debian packages of the tests. This file changes ``.venv``, ``build``,
``docs`` and ``rehearsals`` in the checkout and, as root on Debian, the system's packages: nothing else.
What it starts stores the session in the user's data folder, where the other commands look for it.
"""

import hashlib
import importlib.util
import json
import os
import platform
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

if sys.version_info < (3, 11):  # noqa: UP036 - this file is what an older Python meets first
    sys.exit(f"{sys.executable} is Python {sys.version.split()[0]}, but Recollect needs Python 3.11 or later.")

import tomllib

ROOT = Path(__file__).resolve().parent.parent
PROJECT = ROOT / "pyproject.toml"
CONSTRAINTS = ROOT / "packaging" / "constraints.txt"
VENV = ROOT / ".venv"
VERSION = f"3.{sys.version_info.minor}"
STAMP = VENV / "set-up.json"
BUILD_BACK_END = ("hatchling", "editables")  # installed first: pip 23 and pip 26 lock an isolated build differently
WITH_NUMBA = {"fast", "dev"}  # the extras that bring it
UNLOCKED = {"pip", "setuptools", "wheel", "recollect"}

QT = "libgl1 libegl1 libglib2.0-0 libdbus-1-3 libfontconfig1 libxkbcommon0"
WINDOW = (
    "libxcb-cursor0 libxcb-icccm4 libxcb-image0 libxcb-keysyms1 libxcb-render-util0 libxcb-xkb1 libxkbcommon-x11-0"
    " libxcb-shape0 libxcb-randr0 libxcb-sync1 libxcb-xfixes0 libx11-xcb1"
)
VOICE = "espeak-ng alsa-utils"
VIRTUAL_SCREEN = "xvfb xauth xdotool openbox"
VIRTUAL_SOUND = "pulseaudio pulseaudio-utils"
BUILD = "binutils" + (f" libpython{VERSION}" if sys.base_prefix == "/usr" else "")

PROGRESS_S = 10.0  # how long a program may be silent before a line says that it is still at work

NEXT_STEPS = """
What to do next, in this folder:
  {activate}
  recollect check                  try everything that a booth needs
  recollect study new my-study     make a study of your own
  recollect sessions               see what is stored
docs/reference/what-to-type.md lists more, and `recollect COMMAND --help` shows examples."""

# A file of tests stays together, as its fixtures do; nothing is timed in a process that has company.
# Files keep their order, in which the longest come first; a process that dies ends the run instead of stalling it.
# Some tests wait for a program or for a timer: one process more than there are cores works meanwhile.
PARALLEL = (
    *(
        "-n",
        str((os.cpu_count() or 1) + 1),
        "--dist",
        "loadfile",
        "--no-loadscope-reorder",
        "--max-worker-restart",
        "0",
    ),
    "--benchmark-disable",
)

MEMORY = Path("/dev/shm")  # noqa: S108 - a folder of random name is made in it
"""Where Linux keeps files in memory."""
ENOUGH = 6 * 2**30
"""So much memory must be free for the files of tests."""

TEST_PACKAGES = (QT, WINDOW, VOICE, VIRTUAL_SCREEN, VIRTUAL_SOUND, BUILD)

CHECKS = (
    ("ruff", "check", "."),
    ("ruff", "format", "--check", "."),
    ("mypy",),
    ("python", "packaging/lint_qml.py"),
)


class SetupFailed(Exception):
    """The set-up cannot go on; the message says why and where, in words for the person at the keyboard."""


def main(arguments: Sequence[str]) -> int:
    """Do what the first argument says with the rest of them, and return the exit code."""
    if not arguments or arguments[0] not in JOBS:
        print(f"Use: python3 packaging/bootstrap.py {'|'.join(JOBS)} [further arguments]", file=sys.stderr)
        return 2
    try:
        return JOBS[arguments[0]](arguments[1:])
    except SetupFailed as failure:
        print(failure, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Interrupted; run the same command again.", file=sys.stderr)
        return 130


def start(arguments: Sequence[str]) -> int:
    """Open the kiosk or, where there is no screen, rehearse one session; further arguments go to ``recollect``."""
    install_debian_packages(QT, WINDOW, VOICE)
    install_python_packages(extras={"natural"})
    say("Rendering the voices, once.")
    if run(["recollect", "voice", "render"], os.environ):
        say("The voices could not be rendered; each sentence is rendered when it is said, or only shown.")
    if has_screen(os.environ):
        say("Opening the kiosk; Ctrl+Shift+Q leaves it.")
        code = run(["recollect", *arguments], os.environ)
        if not code:
            say(next_steps())
        return code
    say("There is no screen here: rehearsing one session without it.")
    shots = ROOT / "rehearsals" / "first"
    rehearsal = ["recollect", "rehearse", "--headless", "--seed", "1", "--shots", str(shots)]
    with runtime_folder(os.environ) as environment:
        code = run([*rehearsal, *arguments], environment)
    if code:
        raise SetupFailed(f"The rehearsal ended with exit code {code}.")
    say(next_steps())
    return 0


def next_steps() -> str:
    """Return what a person does after the first start, with this system's way to enter ``.venv``."""
    return NEXT_STEPS.format(activate=r".venv\Scripts\activate" if os.name == "nt" else "source .venv/bin/activate")


def test(arguments: Sequence[str]) -> int:
    """Run all checks and then the tests; further arguments go to pytest, whose summary is the last line."""
    with development() as environment:
        if failed := failed_checks(environment):
            raise SetupFailed(f"The tests were not run, because these failed: {', '.join(failed)}.")
        return run(["python", "-m", "pytest", *PARALLEL, *arguments], environment, ROOT, announced=True)


def fast(arguments: Sequence[str]) -> int:
    """Run the tests that are not slow; further arguments go to pytest."""
    with development() as environment:
        return run(["python", "-m", "pytest", *PARALLEL, "-m", "not slow", *arguments], environment, ROOT)


def check(_arguments: Sequence[str]) -> int:
    """Run the checks without the tests."""
    with development() as environment:
        if failed := failed_checks(environment):
            raise SetupFailed(f"These checks failed: {', '.join(failed)}.")
    say("All checks passed.")
    return 0


def docs(_arguments: Sequence[str]) -> int:
    """Write the generated pages and build all pages as a site; a broken link is a failure."""
    with development() as environment:
        # The theme would end the output with a notice about another program.
        quiet = environment | {"NO_MKDOCS_2_WARNING": "1"}
        failed = run(["python", "packaging/reference.py"], environment, ROOT) or run(
            ["mkdocs", "build", "--strict", "--quiet", "--config-file", "packaging/mkdocs.yml"], quiet, ROOT
        )
    if not failed:
        say("The pages are built. `recollect docs` opens them.")
    return failed


def packages(_arguments: Sequence[str]) -> int:
    """Print the Debian packages that the tests need, for a machine that is prepared by another program."""
    say(" ".join(TEST_PACKAGES))
    return 0


@contextmanager
def development() -> Iterator[dict[str, str]]:
    """Install what the checks and tests need, and yield their environment."""
    install_debian_packages(*TEST_PACKAGES)
    # The natural voice is large, and no test needs it.
    install_python_packages(extras=set(project()["optional-dependencies"]) - {"natural"})
    headless = {"QT_QPA_PLATFORM": "offscreen"} | os.environ | {"QT_QUICK_BACKEND": "software"}
    with runtime_folder(headless) as private, files_in_memory(private) as environment:
        yield environment


def failed_checks(environment: Mapping[str, str]) -> list[str]:
    """Run all checks and return the names of those that failed."""
    return [" ".join(check[:2]) for check in CHECKS if run(check, environment, ROOT, announced=True)]


def lock(_arguments: Sequence[str]) -> int:
    """Resolve all that pyproject.toml names anew, in a fresh environment, and write constraints.txt."""
    with tempfile.TemporaryDirectory() as folder:
        say("Resolving all versions anew; this takes a few minutes.")
        make_environment(Path(folder))
        pip = [str(program("python", Path(folder))), "-m", "pip"]
        everything = f".[{','.join(project()['optional-dependencies'])}]"
        quietly([*pip, "install", *BUILD_BACK_END, "--editable", everything], "pip could not resolve pyproject.toml:")
        frozen = quietly([*pip, "freeze", "--all", "--exclude-editable"], "pip could not list what it installed:")
    locked = [line for line in frozen.splitlines() if line.split("==")[0] not in UNLOCKED]
    strange = [line for line in locked if "==" not in line]
    if strange:
        raise SetupFailed(f"{CONSTRAINTS} stays as it was: {strange[0]!r} is not a name and a version.")
    made = f"# Made on {platform.system()} with Python {VERSION} by: python3 packaging/bootstrap.py lock"
    CONSTRAINTS.write_text("\n".join([made, *locked, ""]), encoding="utf-8")
    say(f"{len(locked)} versions are locked in {CONSTRAINTS}.")
    return 0


def install_debian_packages(*groups: str) -> None:
    """Install what Debian lacks or, without root, name the command that does. Other systems need nothing here."""
    if not shutil.which("dpkg-query"):
        return
    wanted = " ".join(groups).split()
    if importlib.util.find_spec("ensurepip") is None:
        wanted.append(f"python{VERSION}-venv")
    missing = sorted(set(wanted) - debian_packages())
    if not missing:
        return
    commands = [["apt-get", "update"], ["apt-get", "install", "-y", "--no-install-recommends", *missing]]
    if os.geteuid() != 0:
        line = " && ".join(" ".join(["sudo", *command]) for command in commands)
        raise SetupFailed(f"These Debian packages must be installed first:\n{line}")
    say(f"Installing {len(missing)} Debian packages: {' '.join(missing)}.")
    for command in commands:
        quietly(["env", "DEBIAN_FRONTEND=noninteractive", *command], f"{' '.join(command[:2])} failed:")


def debian_packages() -> set[str]:
    """Return the names of the installed packages and of those that they provide."""
    query = ["dpkg-query", "-W", "-f", "${db:Status-Status} ${Package}, ${Provides}\\n"]
    lines = quietly(query, "dpkg-query could not list the Debian packages:").splitlines()
    installed = [line.removeprefix("installed ") for line in lines if line.startswith("installed ")]
    return {name.split()[0] for names in installed for name in names.split(",") if name.strip()}


def install_python_packages(extras: set[str]) -> None:
    """Bring ``.venv`` to the locked versions with at least these extras; do nothing if it is there already."""
    found = read_stamp()
    extras = extras.union(found.get("extras", []))
    files = hashlib.sha256(PROJECT.read_bytes() + CONSTRAINTS.read_bytes()).hexdigest()
    wanted = {"checkout": str(ROOT), "python": VERSION, "files": files, "extras": sorted(extras)}
    usable = is_usable(found)
    if usable and found == wanted:
        return
    if not usable:
        say(f"Making the virtual environment {VENV}.")
        make_environment(VENV)
    STAMP.write_text(json.dumps({"unfinished": True}), encoding="utf-8")
    say("Installing the locked Python packages; the first time this takes a few minutes.")
    pip = [str(program("python")), "-m", "pip", "install", "--constraint", str(CONSTRAINTS)]
    failure = "pip could not install the Python packages (where it speaks of a connection, the network is missing):"
    quietly([*pip, *BUILD_BACK_END], failure)
    quietly([*pip, "--no-build-isolation", "--editable", f".[{','.join(extras)}]" if extras else "."], failure)
    if extras & WITH_NUMBA:
        compile_rules()
    STAMP.write_text(json.dumps(wanted), encoding="utf-8")


def compile_rules() -> None:
    """Compile the rules of ``kiosk.training``, so that the first table or simulation of each user begins at once."""
    say("Compiling the rules of the simulation, once.")
    try:
        quietly([str(program("python")), "-m", "kiosk.training.ahead"], "The rules could not be compiled:")
    except SetupFailed as failure:
        say(f"{failure}\nThey will be compiled when they are first used.")


def read_stamp() -> dict[str, Any]:
    """Return what ``.venv`` was made for: nothing, if this file did not make it, ``unfinished`` if it broke off."""
    try:
        found: dict[str, Any] = json.loads(STAMP.read_text("utf-8"))
    except FileNotFoundError:
        return {}
    except ValueError:
        return {"unfinished": True}
    return found


def is_usable(found: Mapping[str, Any]) -> bool:
    """Tell whether ``.venv`` answers with this Python and pip, in this place, and no set-up broke off in it."""
    if "unfinished" in found or found.get("checkout", str(ROOT)) != str(ROOT):
        return False
    ask = "import importlib.util as u, sys; print('3.%d' % sys.version_info[1] if u.find_spec('pip') else '')"
    try:
        answer = subprocess.run([program("python"), "-c", ask], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return answer.stdout.strip() == VERSION


def make_environment(folder: Path) -> None:
    """Make a virtual environment of the Python that runs this file, in place of whatever is there."""
    python = str(getattr(sys, "_base_executable", sys.executable))  # the latter may lie in the folder to be cleared
    quietly(
        [python, "-m", "venv", "--clear", str(folder)], f"{python} could not make a virtual environment in {folder}:"
    )


def has_screen(environment: Mapping[str, str]) -> bool:
    """Tell whether a window can be opened; of another machine's screen ``recollect`` itself finds out."""
    if sys.platform != "linux" or environment.get("WAYLAND_DISPLAY"):
        return True
    host, _, number = environment.get("DISPLAY", "").partition(":")
    if host or not number:
        return bool(number)
    with socket.socket(socket.AF_UNIX) as screen:
        path = f"/tmp/.X11-unix/X{number.partition('.')[0]}"  # noqa: S108 - every X server's place
        return screen.connect_ex(path) == 0


@contextmanager
def runtime_folder(environment: Mapping[str, str]) -> Iterator[dict[str, str]]:
    """Yield the environment with the private folder that Qt wants, for as long as it is needed."""
    with tempfile.TemporaryDirectory() as folder:  # made with mode 0700, as Qt demands
        yield {"XDG_RUNTIME_DIR": folder} | dict(environment)


@contextmanager
def files_in_memory(environment: Mapping[str, str]) -> Iterator[dict[str, str]]:
    """Yield the environment with a folder in memory for the files of tests, if there is room for one.

    The kiosk waits for the disk after every event, and the tests record many thousands. The folder goes with the run.
    """
    if not has_room(MEMORY):
        yield dict(environment)
        return
    with tempfile.TemporaryDirectory(prefix="recollect-tests-", dir=MEMORY) as folder:
        yield {"PYTEST_DEBUG_TEMPROOT": folder} | dict(environment)


def has_room(folder: Path) -> bool:
    """Whether a folder in memory can take the files of a whole run, one gigabyte, and lets programs run there."""
    if not folder.is_dir():
        return False
    there = os.statvfs(folder)
    memory = re.search(r"^MemAvailable: *(\d+) kB$", Path("/proc/meminfo").read_text("utf-8"), flags=re.M)
    available = int(memory[1]) * 1024 if memory else 0
    return not there.f_flag & os.ST_NOEXEC and min(there.f_bavail * there.f_frsize, available) >= ENOUGH


def project() -> dict[str, Any]:
    """Return the table ``project`` of pyproject.toml."""
    table: dict[str, Any] = tomllib.loads(PROJECT.read_text("utf-8"))["project"]
    return table


def program(name: str, environment: Path = VENV) -> Path:
    """Return where a virtual environment keeps one of its programs."""
    return environment / "Scripts" / f"{name}.exe" if os.name == "nt" else environment / "bin" / name


def run(
    command: Sequence[str], environment: Mapping[str, str], folder: Path | None = None, *, announced: bool = False
) -> int:
    """Run a program of ``.venv`` in the foreground and return its exit code."""
    if announced:
        say(f"{' '.join(command)}:")
    return subprocess.run([program(command[0]), *command[1:]], env=environment, cwd=folder, check=False).returncode


def quietly(command: Sequence[str], failure: str) -> str:
    """Return what a command in the checkout prints.

    If it fails, say so in a sentence and with its last lines.
    """
    with still_at_work():
        done = subprocess.run(command, cwd=ROOT, capture_output=True, encoding="utf-8", errors="replace", check=False)
    if done.returncode:
        raise SetupFailed("\n".join([failure, *(done.stdout + done.stderr).strip().splitlines()[-8:]]))
    return done.stdout


@contextmanager
def still_at_work() -> Iterator[None]:
    """Print how long it has taken, now and then, while a program works in silence."""
    done, begun = threading.Event(), time.monotonic()

    def tell() -> None:
        while not done.wait(PROGRESS_S):
            say(f"  still at work after {time.monotonic() - begun:.0f} s")

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        done.set()
        teller.join()


def say(sentence: str) -> None:
    """Print what is being done, before whatever the programs print."""
    print(sentence, flush=True)


JOBS: dict[str, Callable[[Sequence[str]], int]] = {
    "start": start,
    "check": check,
    "fast": fast,
    "test": test,
    "docs": docs,
    "lock": lock,
    "packages": packages,
}

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
