"""A study is one file, the same bytes for the same content, and no file can do harm by being read."""

from __future__ import annotations

import io
import json
import os
import shutil
import stat
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import ASSETS, Settings
from kiosk.study.checks import study_warnings
from kiosk.study.loader import read_study
from kiosk.study.package import (
    Package,
    open_study,
    pack,
    read_package,
    sign,
    signature_file,
    verify_signature,
    write_package,
)
from tests.patience import PATIENCE_S
from tests.samples import WITH_PIN

STUDY = """
title = "Two sites"
languages = ["en"]
questionnaires = ["./asked.toml"]
[game]
deck = "./pictures"
[robot]
host = "192.168.1.50"
"""


def written(folder: Path, study: str = STUDY) -> Path:
    """Write a study with a questionnaire and a deck of its own."""
    folder.mkdir()
    shutil.copy(ASSETS / "questionnaires" / "trust.toml", folder / "asked.toml")
    shutil.copytree(ASSETS / "cards" / "animals", folder / "pictures")
    file = folder / "study.toml"
    file.write_text(study, "utf-8")
    return file


def packed(file: Path) -> Package:
    """Pack the study of a file."""
    study = read_study(Settings.read(file))
    return pack(study.settings, study.sources)


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study that no test changes."""
    return written(tmp_path_factory.mktemp("study") / "lab")


@pytest.fixture(scope="module")
def package(study: Path) -> Package:
    """Return the same, packed."""
    return packed(study)


@pytest.fixture
def file(package: Package, tmp_path: Path) -> Path:
    """Return the packed study as a file."""
    file = tmp_path / "study.recollect"
    write_package(package, file)
    return file


def test_the_same_study_gives_the_same_bytes_wherever_and_whenever_it_is_packed(
    package: Package, tmp_path: Path
) -> None:
    other = STUDY.replace("languages", "# A comment.\nlanguages").replace("192.168.1.50", "robot.local") + WITH_PIN
    copy = written(tmp_path / "elsewhere", other)
    os.utime(copy.parent / "asked.toml", (0, 0))
    (copy.parent / "pictures" / ".DS_Store").write_bytes(b"what a system leaves behind")
    assert packed(copy).content == package.content


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("study.toml", "Two sites", "Three sites"),
        ("asked.toml", 'version = "', 'version = "new'),
        ("pictures/cat.svg", "<svg", "<svg "),
    ],
)
def test_any_change_of_content_gives_another_hash(
    name: str, old: str, new: str, package: Package, tmp_path: Path
) -> None:
    file = written(tmp_path / "changed")
    changed = file.parent / name
    text = changed.read_text("utf-8")
    assert old in text
    changed.write_text(text.replace(old, new, 1), "utf-8")
    assert packed(file).sha256 != package.sha256


def test_a_packed_study_is_the_study_that_was_packed(study: Path, package: Package, file: Path) -> None:
    own, theirs = read_study(Settings.read(study)), read_study(open_study(file))
    assert theirs.sha256 == own.sha256 == package.sha256
    assert {plan.study_sha256 for plan in theirs.plans} == {package.sha256}
    assert theirs.plans[0].questionnaires == own.plans[0].questionnaires
    assert theirs.plans[0].deck == own.plans[0].deck
    assert all(picture.is_file() for picture in theirs.own_pictures)
    assert theirs.settings.name == f"the packed study {file}"


def test_what_belongs_to_one_kiosk_stands_beside_the_package(file: Path) -> None:
    assert open_study(file).experimenter.pin_hash == ""
    local = file.with_suffix(".local.toml")
    screens = "[screen]\ndisplay = 1\noperator_display = 0\n"
    local.write_text(f'{WITH_PIN}[robot]\nhost = "10.0.0.7"\nkey = "secret"\n{screens}', "utf-8")
    settings = open_study(file)
    assert settings.experimenter.pin_hash.startswith("scrypt:")
    assert (settings.robot.host, settings.robot.key) == ("10.0.0.7", "secret")
    assert (settings.screen.display, settings.screen.operator_display) == (1, 0)
    assert read_study(settings).sha256 == read_package(file).sha256


def test_no_setting_of_the_study_can_stand_in_the_kiosk_s_own_file(file: Path) -> None:
    local = file.with_suffix(".local.toml")
    local.write_text("[game]\nrows = 2\n", "utf-8")
    with pytest.raises(UserInputError, match=r"study\.local\.toml: there is no key 'game'"):
        open_study(file)


def test_files_that_were_changed_after_unpacking_are_put_right(file: Path, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    asked = open_study(file, cache).beside("asked.toml")
    right = asked.read_bytes()
    asked.write_bytes(b"changed")
    (asked.parent / "pictures" / "added.svg").write_text("<svg/>", "utf-8")
    open_study(file, cache)
    assert asked.read_bytes() == right
    assert not (asked.parent / "pictures" / "added.svg").exists()


def test_a_package_that_came_with_other_materials_is_cautioned(package: Package, tmp_path: Path) -> None:
    manifest = json.loads(zipfile.ZipFile(io.BytesIO(package.content)).read("study.json"))
    manifest["shipped"]["practice.deck"] = "0" * 64
    file = tmp_path / "older.recollect"
    file.write_bytes(archive([("study.json", as_json(manifest)), *sorted(package.files.items())]))
    warnings = study_warnings(read_study(open_study(file)))
    assert any("was packed with another version" in each and "practice.deck" in each for each in warnings)


@pytest.mark.parametrize("place", ["above", "link", "own folder"])
def test_a_study_with_files_elsewhere_is_not_packed(place: str, tmp_path: Path) -> None:
    file = written(tmp_path / "lab")
    asked = file.parent / "asked.toml"
    asked.rename(tmp_path / "asked.toml")
    named = "../asked.toml"
    if place == "link":
        asked.symlink_to(tmp_path / "asked.toml")
        named = "./asked.toml"
    file.write_text(STUDY.replace("./asked.toml", named), "utf-8")
    if place == "own folder":
        shutil.copy(tmp_path / "asked.toml", asked)
        shutil.copy(ASSETS / "consent" / "study" / "en.toml", file.parent / "en.toml")
        file.write_text(f'{STUDY}[consent]\ntext = "./"\n', "utf-8")
    with pytest.raises(UserInputError, match=r"lies outside|is the study's own folder"):
        packed(file)


def test_a_package_does_not_replace_another_file(package: Package, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=r"ends in \.recollect"):
        write_package(package, tmp_path / "study.zip")
    there = tmp_path / "study.recollect"
    there.write_text("something else", "utf-8")
    with pytest.raises(UserInputError, match="is there already"):
        write_package(package, there)
    assert there.read_text("utf-8") == "something else"


def as_json(manifest: object) -> bytes:
    """Return a manifest as it is written."""
    return json.dumps(manifest, ensure_ascii=False, indent=1, sort_keys=True).encode() + b"\n"


def archive(entries: list[tuple[str, bytes]], mode: int = 0o100644, packing: int = zipfile.ZIP_STORED) -> bytes:
    """Return an archive with these entries."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", packing) as opened:
        for name, text in entries:
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.create_system, entry.external_attr, entry.compress_type = 3, mode << 16, packing
            opened.writestr(entry, text)
    return content.getvalue()


def with_entry(name: str) -> Callable[[Package], bytes]:
    """Return what makes a package with an entry of this name."""
    return lambda package: archive([("study.json", b"{}"), *package.files.items(), (name, b"x")])


BAD: dict[str, tuple[Callable[[Package], bytes], str]] = {
    "nothing": (lambda _: b"", "is none, or is damaged"),
    "a text": (lambda _: b"title = 'A study'", "is none, or is damaged"),
    "cut short": (lambda package: package.content[:-100], "is none, or is damaged"),
    "something behind it": (lambda package: package.content + b"more", "was changed|is none, or is damaged"),
    "something before it": (lambda package: b"more" + package.content, "was changed|is none, or is damaged"),
    "a byte changed": (lambda package: package.content.replace(b"<svg", b"<SVG", 1), "is none, or is damaged"),
    "no settings": (lambda package: archive(list(package.files.items())), "is none, or is damaged"),
    "settings that are none": (lambda _: archive([("study.json", b"[1]")]), "is none, or is damaged"),
    "a newer format": (lambda _: archive([("study.json", b'{"format": 2}')]), "written by a newer Recollect"),
    "a path upwards": (with_entry("../../evil.toml"), "leads out of it"),
    "an absolute path": (with_entry("/etc/evil.toml"), "leads out of it"),
    "a path of Windows": (with_entry("..\\evil.toml"), "leads out of it"),
    "a drive": (with_entry("C:evil.toml"), "leads out of it"),
    "a device": (with_entry("aux.toml"), "leads out of it"),
    "names that differ by capitals": (with_entry("Asked.toml"), "two entries of one name"),
    "a link": (lambda _: archive([("study.json", b"{}"), ("a", b"/etc/passwd")], stat.S_IFLNK | 0o777), "leads out"),
    "a bomb": (lambda _: archive([("study.json", bytes(10_000_000))], packing=zipfile.ZIP_DEFLATED), "is compressed"),
    "very many files": (lambda _: archive([(f"{n}.txt", b"") for n in range(5001)]), "more than 5000 files"),
}


@pytest.mark.parametrize("bad", BAD, ids=str)
def test_a_package_that_was_not_packed_like_this_is_refused_and_nothing_is_written(
    bad: str, package: Package, tmp_path: Path
) -> None:
    content, why = BAD[bad]
    file, cache = tmp_path / "study.recollect", tmp_path / "cache"
    file.write_bytes(content(package))
    with pytest.raises(UserInputError, match=why) as refused:
        open_study(file, cache)
    assert all(sentence.startswith(f"the packed study {file} ") for sentence in refused.value.sentences)
    assert not cache.exists()


def test_entries_that_lie_over_one_another_are_refused(tmp_path: Path) -> None:
    """Many entries can name the same bytes, and would be many times as large when unpacked."""
    content = bytearray(archive([("study.json", b"{}"), ("a.txt", bytes(1000))]))
    end = content.rfind(b"PK\x05\x06")
    at = content.rfind(b"PK\x01\x02")
    entry = bytes(content[at:end])
    more = b"".join(entry.replace(b"a.txt", f"{n:05}".encode()) for n in range(50))
    content[end:end] = more
    end += len(more)
    count = (2 + 50).to_bytes(2, "little")
    content[end + 8 : end + 12] = count * 2
    size = int.from_bytes(content[end + 12 : end + 16], "little") + len(more)
    content[end + 12 : end + 16] = size.to_bytes(4, "little")
    file = tmp_path / "study.recollect"
    file.write_bytes(content)
    with pytest.raises(UserInputError):
        read_package(file)


# Signatures

needs_ssh = pytest.mark.skipif(shutil.which("ssh-keygen") is None, reason="there is no ssh-keygen here")


def new_key(folder: Path, name: str) -> Path:
    """Make an SSH key without a passphrase."""
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", folder / name], check=True, timeout=PATIENCE_S)  # noqa: S607
    return folder / name


def allowed(folder: Path, key: Path, who: str) -> Path:
    """Write the file that allows a key to sign."""
    file = folder / "allowed"
    file.write_text(f"{who} {key.with_suffix('.pub').read_text('utf-8')}", "utf-8")
    return file


@needs_ssh
def test_a_signature_is_shown_and_holds_for_these_bytes_alone(file: Path, tmp_path: Path) -> None:
    assert verify_signature(file) is None
    key = new_key(tmp_path, "key")
    assert sign(file, key) == signature_file(file)
    found = verify_signature(file)
    assert found is not None
    assert found.key.startswith("ED25519 SHA256:")
    known = verify_signature(file, allowed(tmp_path, key, "pi@lab.example"))
    assert str(known) == f"by pi@lab.example, with the key {found.key}"
    file.write_bytes(file.read_bytes() + b" ")
    with pytest.raises(UserInputError, match="is not one of"):
        verify_signature(file)


@needs_ssh
def test_a_signature_of_another_person_is_refused(file: Path, tmp_path: Path) -> None:
    sign(file, new_key(tmp_path, "key"))
    other = new_key(tmp_path, "other")
    with pytest.raises(UserInputError, match="was made by none of those in"):
        verify_signature(file, allowed(tmp_path, other, "pi@lab.example"))


@needs_ssh
def test_a_key_that_cannot_sign_is_said(file: Path, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="was not signed"):
        sign(file, tmp_path / "no-key")
    assert not signature_file(file).exists()


def test_the_command_prints_the_hash_of_the_file(study: Path, package: Package, tmp_path: Path) -> None:
    out = tmp_path / "out.recollect"
    command = [sys.executable, "-m", "kiosk", "study", "pack", str(study), "--out", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=PATIENCE_S)
    assert done.stdout == f"{package.sha256}  {out}\n"
    assert out.read_bytes() == package.content
