"""Takes out of a build what Recollect does not use.

That is most of Qt's modules and plugins, and the libraries only they need.

What is used is asked, not listed: Qt's own scanner tells which QML modules the screens import, and the files tell which
libraries they need. Only the plugins are chosen here, by name.
"""

import json
import shutil
import subprocess
from pathlib import Path

import PySide6
from PyInstaller.depend.bindepend import get_imports

PLUGINS = {
    "platforms": ("qxcb", "qwayland", "qoffscreen", "qminimal", "qwindows", "qcocoa"),
    "imageformats": ("qsvg", "qjpeg", "qwebp"),
    "iconengines": ("qsvgicon",),
    "platforminputcontexts": ("composeplatforminputcontext", "ibusplatforminputcontext"),
    "wayland-shell-integration": ("xdg-shell", "fullscreen-shell-v1"),
    "xcbglintegrations": ("qxcb-egl-integration", "qxcb-glx-integration"),
    "wayland-graphics-integration-client": ("qt-plugin-wayland-egl",),
}
"""Which plugins stay, by folder: screens and none, pictures, keyboards, and a GPU for who opts in to one."""

LIBRARY = "lib*.so*"


def trim(built: Path, checkout: Path) -> None:
    """Trim a folder that PyInstaller has built from this checkout."""
    inside = built / "_internal"
    qt = inside / "PySide6" / "Qt" if (inside / "PySide6" / "Qt").is_dir() else inside / "PySide6"
    _drop_unused_modules(qt / "qml", checkout / "kiosk" / "ui" / "qml")
    _drop_unused_plugins(qt / "plugins")
    _drop_unused_locales(inside / "babel" / "locale-data", checkout / "assets" / "sentences")
    for translation in (qt / "translations").glob("*.qm"):
        translation.unlink()
    _drop_unneeded_libraries(inside, qt / "lib")
    _strip_python(inside)
    _drop_dangling_links_and_empty_folders(inside)


def _drop_unused_modules(there: Path, screens: Path) -> None:
    """Keep the QML modules that the screens import, at first hand or at second."""
    ours = Path(PySide6.__path__[0])
    qt = ours / "Qt" if (ours / "Qt").is_dir() else ours
    scanner = next(file for file in (qt / "libexec").glob("qmlimportscanner*"))
    command = [str(scanner), "-rootPath", str(screens), "-importPath", str(qt / "qml")]
    scanned = subprocess.run(command, capture_output=True, check=True).stdout
    used = {there / module["relativePath"] for module in json.loads(scanned) if module.get("relativePath")}
    for file in [file for file in there.rglob("*") if not file.is_dir() and _module_of(file) not in used]:
        file.unlink()


def _module_of(file: Path) -> Path:
    """Return the folder of the QML module that a file belongs to: the nearest one that declares a module."""
    return next((folder for folder in file.parents if (folder / "qmldir").exists()), file.parent)


def _drop_unused_plugins(there: Path) -> None:
    for plugin in list(there.glob("*/*")):
        if plugin.stem.removeprefix("lib") not in PLUGINS.get(plugin.parent.name, ()):
            plugin.unlink()


def _drop_unused_locales(there: Path, sentences: Path) -> None:
    """Keep how numbers are written in the languages that there are sentences for, and the root of all."""
    languages = {folder.name for folder in sentences.iterdir()} | {"root"}
    for locale in there.glob("*.dat"):
        if locale.stem.split("_")[0] not in languages:
            locale.unlink()


def _drop_unneeded_libraries(inside: Path, qt_libraries: Path) -> None:
    """Keep the shared libraries that something else in the build needs, at first hand or at second."""
    if not qt_libraries.is_dir():
        return
    libraries = {file.name: file for place in (inside, qt_libraries) for file in place.glob(LIBRARY)}
    files = (file for file in inside.rglob("*.so*") if file.is_file() and file.parent not in (inside, qt_libraries))
    waiting = list(files)
    needed = {name for name in libraries if name.startswith("libpython")}
    waiting += [libraries[name] for name in needed]
    while waiting:
        wanted = {Path(name).name for name, _ in get_imports(str(waiting.pop()))} & libraries.keys() - needed
        needed |= wanted
        waiting += [libraries[name] for name in wanted]
    for place in (inside, qt_libraries):
        for file in list(place.glob(LIBRARY)):
            if file.name not in needed:
                file.unlink()


def _strip_python(inside: Path) -> None:
    """Take what only debuggers read out of Python's own libraries; those of others may not survive it."""
    strip = shutil.which("strip")
    if strip is not None:
        own = [*inside.glob("libpython*.so*"), *inside.glob("python3.*/lib-dynload/*.so")]
        subprocess.run([strip, "--strip-unneeded", *map(str, own)], check=True)


def _drop_dangling_links_and_empty_folders(inside: Path) -> None:
    for path in sorted(inside.rglob("*"), reverse=True):
        if (path.is_symlink() and not path.exists()) or (path.is_dir() and not any(path.iterdir())):
            path.rmdir() if path.is_dir() else path.unlink()
