"""Lint the screens: tell qmllint which Python types QML may use, then run it with not one warning allowed.

The types are asked of Qt itself, by importing the modules that declare them, and not read out of the Python text:
what works in the kiosk is what qmllint knows. Nothing is written outside ``build/qml``. Runs in the checkout's .venv.
"""

import importlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QMetaMethod, QMetaObject, QMetaProperty, QObject
from PySide6.QtQml import qmlTypeId

ROOT = Path(__file__).resolve().parent.parent
UI = ROOT / "kiosk" / "ui"
URI = "Recollect"
VERSION = (1, 0)
MODULES = ROOT / "build" / "qml"
FOREIGN = ("core", "gui", "qml", "quick")

type_entry = dict[str, object]


def main() -> int:
    """Describe the Python types, lint every screen and return qmllint's exit code."""
    screens = sorted(map(str, UI.rglob("*.qml")))
    if not screens:
        print("There are no QML files yet.")
        return 0
    QCoreApplication()  # Qt wants one before it tells about a type that is a QQuickItem
    describe_module(list(python_types()))
    code = run("qmllint", "--max-warnings", "0", "-I", str(MODULES), *screens)
    print(f"{len(screens)} QML files were checked.")
    return code


def python_types() -> Iterator[QMetaObject]:
    """Import every module that speaks for QML and yield what Qt knows about its types, bases first."""
    for source in sorted(UI.rglob("*.py")):
        if "QML_IMPORT_NAME" in source.read_text(encoding="utf-8"):
            importlib.import_module(".".join(source.relative_to(ROOT).with_suffix("").parts))
    waiting: list[type[QObject]] = [QObject]
    while waiting:
        below = waiting.pop(0).__subclasses__()
        waiting += below
        yield from (vars(kind)["staticMetaObject"] for kind in below if kind.__module__.startswith("kiosk.ui"))


def describe_module(kinds: list[QMetaObject]) -> None:
    """Write the QML module ``Recollect``: its types for the tools, and the qmldir that names the file."""
    folder = MODULES / URI
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "qmldir").write_text(f"module {URI}\ntypeinfo types.qmltypes\ndepends QtQuick\n", encoding="utf-8")
    metatypes = folder / "metatypes.json"
    described = [{"classes": [describe(kind)], "inputFile": "kiosk/ui", "outputRevision": 68} for kind in kinds]
    metatypes.write_text(json.dumps(described, indent=1), encoding="utf-8")
    qt = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.ArchDataPath)) / "metatypes"
    code = run(
        "qmltyperegistrar",
        *("--import-name", URI, "--major-version", str(VERSION[0]), "--minor-version", str(VERSION[1])),
        *("--generate-qmltypes", str(folder / "types.qmltypes"), "-o", str(folder / "unused.cpp")),
        *("--foreign-types", ",".join(str(qt / f"qt6{name}_metatypes.json") for name in FOREIGN)),
        str(metatypes),
    )
    if code:
        sys.exit(f"{metatypes}: qmltyperegistrar could not describe the Python types for QML.")


def describe(kind: QMetaObject) -> type_entry:
    """Return one type in the notation that Qt's own moc uses."""
    name = kind.className()
    methods = [kind.method(i) for i in range(kind.methodOffset(), kind.methodCount())]
    signals = [method for method in methods if method.methodType() == QMetaMethod.MethodType.Signal]
    enums = [kind.enumerator(i) for i in range(kind.enumeratorOffset(), kind.enumeratorCount())]
    known = qmlTypeId(URI, *VERSION, name) >= 0  # type: ignore[arg-type]  # the stubs say bytes, it takes str alone
    return {
        "className": name,
        "qualifiedClassName": name,
        "object": True,
        "superClasses": [{"access": "public", "name": kind.superClass().className()}],
        "classInfos": [{"name": "QML.Element", "value": "auto"}] if known else [],
        "properties": [describe_property(kind.property(i)) for i in range(kind.propertyOffset(), kind.propertyCount())],
        "signals": [describe_method(method) for method in signals],
        "slots": [describe_method(method) for method in methods if method not in signals],
        "enums": [
            {"name": e.name(), "isClass": True, "isFlag": e.isFlag(), "values": [e.key(k) for k in range(e.keyCount())]}
            for e in enums
        ],
    }


def describe_property(prop: QMetaProperty) -> type_entry:
    """Return one property in moc's notation."""
    entry: type_entry = {"name": prop.name(), "type": prop.typeName(), "index": prop.relativePropertyIndex()}
    entry |= {"read": prop.name(), "constant": prop.isConstant()}
    if prop.isWritable():
        entry["write"] = prop.name()
    if prop.hasNotifySignal():
        entry["notify"] = prop.notifySignal().name().toStdString()
    return entry


def describe_method(method: QMetaMethod) -> type_entry:
    """Return one signal or slot in moc's notation."""
    kinds = [kind.toStdString() for kind in method.parameterTypes()]
    arguments = [{"name": f"argument{number}", "type": kind} for number, kind in enumerate(kinds, 1)]
    return {
        "access": "public",
        "name": method.name().toStdString(),
        "arguments": arguments,
        "returnType": method.typeName(),
    }


def run(tool: str, *arguments: str) -> int:
    """Run one of PySide's tools out of the same virtual environment and return its exit code."""
    found = shutil.which(f"pyside6-{tool}", path=str(Path(sys.executable).parent))
    if not found:
        sys.exit(f"{sys.prefix}: pyside6-{tool} is missing; set up again with packaging/bootstrap.py.")
    return subprocess.run([found, *arguments], cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
