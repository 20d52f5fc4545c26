"""Install one of the packages into a folder, as pip does it without a network, and run Recollect with it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

PLUGINS = Path(__file__).parent


def install(name: str, folder: Path) -> None:
    """Put a package with its entry points into a folder."""
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build-isolation"]
    source = folder.parent / f"source-{name}"
    source.mkdir(parents=True)
    for file in (PLUGINS / name).rglob("*"):
        if file.is_file() and "__pycache__" not in file.parts:
            (source / file.relative_to(PLUGINS / name)).parent.mkdir(parents=True, exist_ok=True)
            (source / file.relative_to(PLUGINS / name)).write_bytes(file.read_bytes())
    subprocess.run([*command, "--target", str(folder), str(source)], check=True, timeout=120)


def register(folder: Path, package: str, group: str, entries: dict[str, str], **modules: str) -> None:
    """Write the metadata and the modules of a made-up package, as an installer leaves them."""
    info = folder / f"{package.replace('-', '_')}-0.1.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 0.1\n", "utf-8")
    lines = "".join(f"{name} = {place}\n" for name, place in entries.items())
    (info / "entry_points.txt").write_text(f"[{group}]\n{lines}", "utf-8")
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text, "utf-8")


def recollect(folder: Path, *arguments: object, seconds: float = 120) -> subprocess.CompletedProcess[str]:
    """Run the command in a process that has the packages of the folder."""
    path = os.pathsep.join(filter(None, (str(folder), os.environ.get("PYTHONPATH", ""))))
    environment = os.environ | {"PYTHONPATH": path, "QT_QPA_PLATFORM": "offscreen", "QT_QUICK_BACKEND": "software"}
    return subprocess.run(
        [sys.executable, "-m", "kiosk", *map(str, arguments)],
        env=environment,
        cwd=PLUGINS.parents[1],
        capture_output=True,
        encoding="utf-8",
        timeout=seconds,
        check=False,
    )
