"""Pack a study into one file, with the same bytes for the same content, and read such a file safely.

A package is a ZIP archive without compression. Its first entry, ``study.json``, holds every setting and the hash of
every file; the other entries are the study's own files. What belongs to one kiosk, such as its PIN, is not packed.
"""

from __future__ import annotations

import hashlib
import io
import json
import shutil
import subprocess
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from stat import S_ISLNK
from typing import Any

from platformdirs import user_cache_path
from pydantic import ValidationError

from kiosk import UserInputError, unwritable
from kiosk.config import PackageOrigin, Settings, is_path
from kiosk.errors import validation_messages
from kiosk.experiment.labels import fold_name, is_reserved
from kiosk.experiment.session_config import Source
from kiosk.files import open_to_read, replace_file, write_file
from kiosk.lazy_dataclass import dataclass

ENDING = ".recollect"
MANIFEST = "study.json"
LOCAL_ENDING = ".local.toml"
"""Beside ``study.recollect``, ``study.local.toml`` holds what belongs to one kiosk."""

FORMAT = 1
LOCAL_KEYS: Mapping[str, tuple[str, ...]] = {
    "robot": ("host", "port"),
    "screen": ("display", "operator_display"),
    "voice": ("device",),
}
"""Settings of one kiosk, besides the section ``experimenter``: no part of a study."""

MOST_FILES = 5000
MOST_BYTES = 1024**3
"""A study with more files, or more bytes, than this is a mistake."""

_DATE = (1980, 1, 1, 0, 0, 0)
"""The first date that a ZIP archive can hold, so that no date makes a difference."""
_MODE = 0o100644 << 16
_UNIX = 3

_PACKED = frozenset(
    (
        *(".toml", ".ftl", ".csv", ".json", ".md", ".txt", ".svg", ".png", ".jpg", ".jpeg", ".webp"),
        *(".wav", ".ogg", ".flac", ".mp3", ".ttf", ".otf", ".ttc"),
    )
)
"""Endings of what a study can be made of; anything else in its folders is left out."""

NAMESPACE = "recollect-study"
"""A signature made for another purpose is none of a study."""


@dataclass(frozen=True)
class Package:
    """A packed study: its bytes and what is in them."""

    content: bytes
    settings: Mapping[str, Any]
    shipped: Mapping[str, str]
    """The hash of everything that comes with Recollect, by the key that names it."""
    files: Mapping[str, bytes]

    @property
    def sha256(self) -> str:
        """The hash of the file, as ``sha256sum`` prints it."""
        return hashlib.sha256(self.content).hexdigest()


def pack(settings: Settings, sources: Iterable[Source]) -> Package:
    """Return the package of a study; raises UserInputError if one of its files lies outside of its folder."""
    sources = tuple(sources)
    files = dict(sorted(_own_files(settings, sources)))
    shipped = {source.key: source.sha256 for source in sources if source.is_shipped}
    return _package(_shared(settings), shipped, files)


def study_hash(settings: Settings, sources: Iterable[Source]) -> str:
    """Return the hash of a study: that of its package.

    A study that cannot be packed gets a hash of its settings and sources.
    """
    sources = tuple(sources)
    try:
        return pack(settings, sources).sha256
    except UserInputError:
        # A study with files elsewhere can be run, but not packed.
        told = [_shared(settings), sorted((each.key, each.sha256) for each in sources)]
        return hashlib.sha256(json.dumps(told, ensure_ascii=False, sort_keys=True).encode()).hexdigest()


def _shared(settings: Settings) -> dict[str, Any]:
    """Return all settings but those of one kiosk."""
    told: dict[str, Any] = json.loads(settings.model_dump_json())
    told.pop("experimenter")
    for section, keys in LOCAL_KEYS.items():
        for key in keys:
            told[section].pop(key)
    return told


def _package(settings: Mapping[str, Any], shipped: Mapping[str, str], files: Mapping[str, bytes]) -> Package:
    hashes = {name: hashlib.sha256(content).hexdigest() for name, content in files.items()}
    told = {"format": FORMAT, "settings": settings, "shipped": shipped, "files": hashes}
    manifest = json.dumps(told, ensure_ascii=False, indent=1, sort_keys=True).encode() + b"\n"
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_STORED) as archive:
        for name, content in ((MANIFEST, manifest), *sorted(files.items())):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.create_system, entry.external_attr = _UNIX, _MODE
            archive.writestr(entry, content)
    return Package(written.getvalue(), settings, shipped, files)


def _own_files(settings: Settings, sources: Iterable[Source]) -> Iterator[tuple[str, bytes]]:
    """Yield the names in the package and the contents of all files that do not come with Recollect."""
    base = settings.beside(".").resolve()
    places = {(source.key, place) for source in sources if not source.is_shipped for place in _places(source)}
    voices = ((f"voice.speakers.{key}", name) for key, name in settings.voice.speakers.items() if is_path(name))
    places |= {(key, settings.beside(name)) for key, name in voices}
    for key, place in sorted(places):
        if place.is_dir() and base.is_relative_to(place.resolve()):
            raise UserInputError(
                f"{settings.name}: {key}: {place} is the study's own folder; put these files into a folder of their own"
            )
        for file in _within(place):
            inside = _inside(base, file)
            if inside is None:
                raise UserInputError(
                    f"{settings.name}: {key}: {file} lies outside of the study's folder or is a link; copy it there"
                )
            yield inside, _content(file)


def _places(source: Source) -> tuple[Path, ...]:
    """Return where a source lies, with the page that stands beside a policy."""
    page = source.path.with_suffix(".md")
    return (source.path, page) if source.path.suffix == ".json" and page.is_file() else (source.path,)


def _within(place: Path) -> Iterator[Path]:
    """Yield the file itself, or those of a folder that can be part of a study."""
    if not place.is_dir():
        yield place
        return
    for file in sorted(place.rglob("*")):
        hidden = any(part.startswith(".") for part in file.relative_to(place).parts)
        if not hidden and file.suffix.lower() in _PACKED and file.is_file():
            yield file


def _inside(base: Path, file: Path) -> str | None:
    """Return a file's name from the study's folder; None if it lies elsewhere, or a link leads to it."""
    place = file.parent.resolve() / file.name
    if file.is_symlink() or not place.is_relative_to(base):
        return None
    return place.relative_to(base).as_posix()


def _content(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise UserInputError(f"the file {file} cannot be read: {error.strerror}") from error


def write_package(package: Package, out: Path) -> None:
    """Write a package; raises UserInputError if its name has another ending, or another file has the name."""
    if out.suffix != ENDING:
        raise UserInputError(f"{out}: the name of a packed study ends in {ENDING}")
    if out.exists() and (not out.is_file() or out.read_bytes() != package.content):
        raise UserInputError(f"{out} is there already, and is something else; choose another name")
    write_file(out, package.content)


_DAMAGE = (zipfile.BadZipFile, KeyError, ValueError, TypeError, RuntimeError, EOFError)
"""What reading an archive of any bytes may raise; RuntimeError is that of an encrypted one."""


def is_package(path: Path) -> bool:
    """Whether a file is named like a packed study."""
    return path.suffix.lower() == ENDING


def read_package(path: Path) -> Package:
    """Read a package into memory; raises UserInputError unless ``study pack`` could have written these very bytes."""
    name = f"the packed study {path}"
    try:
        if path.stat().st_size > MOST_BYTES:
            raise UserInputError(f"{name} is too large: it has more than {MOST_BYTES // 1024**2} MiB")
        with open_to_read(path) as file:
            content = file.read()
    except OSError as error:
        raise UserInputError(f"{name} cannot be read: {error.strerror}") from error
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            entries = archive.infolist()
            _check_entries(name, entries, len(content))
            files = {entry.filename: archive.read(entry) for entry in entries}
        manifest = json.loads(files.pop(MANIFEST))
        if manifest["format"] != FORMAT:
            raise UserInputError(f"{name} was written by a newer Recollect; use that one")
        package = _package(manifest["settings"], manifest["shipped"], files)
    except _DAMAGE as error:
        raise UserInputError(f"{name} is none, or is damaged: copy it anew from where it was packed") from error
    if package.content != content:
        raise UserInputError(f"{name} was changed after it was packed; change the study and pack it anew")
    return package


def _check_entries(name: str, entries: list[zipfile.ZipInfo], size: int) -> None:
    """Refuse what could harm before anything is unpacked."""
    if len(entries) > MOST_FILES:
        raise UserInputError(f"{name} has more than {MOST_FILES} files")
    # Nothing is compressed, so the files together are never larger than the archive.
    if any(entry.compress_type != zipfile.ZIP_STORED for entry in entries) or (
        sum(entry.file_size for entry in entries) > size
    ):
        raise UserInputError(f"{name} is compressed, which 'recollect study pack' never does; pack the study anew")
    for entry in entries:
        if not _is_safe(entry.filename) or S_ISLNK(entry.external_attr >> 16):
            raise UserInputError(f"{name} has an entry {entry.filename!r}, which leads out of it; do not use it")
    if len({fold_name(entry.filename) for entry in entries}) < len(entries):
        raise UserInputError(f"{name} has two entries of one name")


def _is_safe(filename: str) -> bool:
    """Whether a name in an archive stays in its folder on every system."""
    parts = PurePosixPath(filename).parts
    plain = filename == "/".join(parts) and not any(sign in filename for sign in '\\:\0*?"<>|')
    return bool(parts) and plain and not any(_is_odd(part) for part in parts)


def _is_odd(part: str) -> bool:
    return part.startswith(("/", ".")) or part.endswith((".", " ")) or is_reserved(part)


def open_study(path: Path, cache: Path | None = None) -> Settings:
    """Read the settings of a study file or a packed study; raises UserInputError.

    The files of a package are put into ``cache``, and are compared with the package whenever it is opened.
    """
    if not is_package(path):
        return Settings.read(path)
    package = read_package(path)
    folder = (cache or user_cache_path("recollect", appauthor=False) / "studies") / package.sha256
    try:
        _unpack(package, folder)
    except OSError as error:
        raise unwritable(f"the packed study {path} cannot be unpacked into {folder}", error) from error
    given = _with_local(package.settings, path.with_suffix(LOCAL_ENDING))
    origin = PackageOrigin(path, package.sha256, package.shipped)
    try:
        return Settings.from_package(given, folder / MANIFEST, origin)
    except ValidationError as error:
        faults = validation_messages(error, given, Settings)
        raise UserInputError(*(f"the packed study {path}: {fault}" for fault in faults)) from error


def _unpack(package: Package, folder: Path) -> None:
    """Make a folder hold the files of a package, and nothing else."""
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    wanted = {folder / name: content for name, content in package.files.items()}
    for file in sorted(folder.rglob("*"), reverse=True):
        if file.is_symlink() or (file.is_file() and file not in wanted):
            file.unlink()
        elif file.is_dir() and file in wanted:
            shutil.rmtree(file)
    for file, content in wanted.items():
        file.parent.mkdir(parents=True, exist_ok=True)
        if not file.is_file() or file.read_bytes() != content:
            replace_file(file, content, durable=False)


def _with_local(settings: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """Return the settings of a package with those of this kiosk."""
    given = {key: dict(value) if isinstance(value, dict) else value for key, value in settings.items()}
    if not file.exists():
        return given
    from kiosk.study.kiosk_settings import LocalConfig  # noqa: PLC0415 - few studies are packed

    local = LocalConfig.read(file)
    # The PIN and the robot's key are left out of every dump, so that they are recorded nowhere.
    given["experimenter"] = {key: getattr(local.experimenter, key) for key in local.experimenter.model_fields_set}
    for section in ("robot", "screen", "voice"):
        own = getattr(local, section)
        given[section] |= {key: getattr(own, key) for key in own.model_fields_set}
    return given


@dataclass(frozen=True)
class Signature:
    """What a signature beside a package says: by which key it was made, and by whom if that is known."""

    key: str
    signer: str = ""

    def __str__(self) -> str:
        """Return it in words."""
        who = f"by {self.signer}, " if self.signer else ""
        return f"{who}with the key {self.key}"


class CannotVerify(Exception):
    """There is no ``ssh-keygen`` here, so that nothing can be said about a signature."""


def signature_file(package: Path) -> Path:
    """Return where the signature of a package lies."""
    return package.with_name(f"{package.name}.sig")


def sign(package: Path, key: Path) -> Path:
    """Sign a package with an SSH key, and return the signature's file; raises UserInputError."""
    file = signature_file(package)
    file.unlink(missing_ok=True)
    try:
        done = _ssh_keygen("sign", "-f", str(key), str(package))
    except CannotVerify as error:
        raise UserInputError(f"{package} was not signed: {error}") from error
    if done.returncode or not file.is_file():
        raise UserInputError(f"{package} was not signed: {_last_line(done.stderr)}")
    return file


def verify_signature(package: Path, allowed_signers: Path | None = None) -> Signature | None:
    """Return what the signature beside a package says; None without one.

    With ``allowed_signers``, a file as ssh-keygen(1) describes it, the signer must be one of them. Raises
    UserInputError for a signature that is not one of these bytes, and CannotVerify without ssh-keygen.
    """
    file = signature_file(package)
    if not file.is_file():
        return None
    content = package.read_bytes()
    signer = ""
    how: tuple[str, ...] = ("check-novalidate",)
    if allowed_signers is not None:
        found = _ssh_keygen("find-principals", "-s", str(file), "-f", str(allowed_signers))
        signer = found.stdout.decode("utf-8", "replace").splitlines()[0] if found.stdout else ""
        if found.returncode or not signer:
            raise UserInputError(f"the signature {file} was made by none of those in {allowed_signers}")
        how = ("verify", "-f", str(allowed_signers), "-I", signer)
    done = _ssh_keygen(*how, "-s", str(file), content=content)
    if done.returncode:
        raise UserInputError(f"the signature {file} is not one of {package}: {_last_line(done.stderr or done.stdout)}")
    said = done.stdout.decode("utf-8", "replace").strip()
    return Signature(said.rpartition(" with ")[2].replace(" key ", " ", 1), signer)


_DEADLINE_S = 60
"""A key with a passphrase asks a person for it."""


def _ssh_keygen(action: str, *arguments: str, content: bytes | None = None) -> subprocess.CompletedProcess[bytes]:
    try:
        return subprocess.run(  # noqa: S603 - with arguments of our own
            ["ssh-keygen", "-Y", action, "-n", NAMESPACE, *arguments],  # noqa: S607 - it is on the path
            input=content,
            capture_output=True,
            timeout=_DEADLINE_S,
            check=False,
        )
    except FileNotFoundError as error:
        raise CannotVerify("there is no ssh-keygen here; install OpenSSH") from error
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CannotVerify(f"ssh-keygen did not answer: {error}") from error


def _last_line(said: bytes) -> str:
    lines = said.decode("utf-8", "replace").strip().splitlines()
    return lines[-1] if lines else "ssh-keygen did not say why"


def shipped_differences(origin: PackageOrigin, sources: Iterable[Source]) -> Iterator[str]:
    """Yield the keys of what comes with Recollect and was different where the study was packed."""
    here = {source.key: source.sha256 for source in sources if source.is_shipped}
    for key in sorted({*here, *origin.shipped}):
        if here.get(key) != origin.shipped.get(key):
            yield key
