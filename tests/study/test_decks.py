"""A study's own cards: which files are pictures, what they are called, and which ones are refused unseen."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue, card_message
from kiosk.config import ASSETS, Settings, pictures_in
from kiosk.study.checks import study_warnings
from kiosk.study.decks import (
    MOST_DECK_BYTES,
    MOST_PICTURE_BYTES,
    MOST_PICTURES,
    deck_faults,
    names_table,
    picture_faults,
    read_names,
)
from kiosk.study.loader import read_study

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 240">{}<circle cx="120" cy="120" r="80"/></svg>'
PNG = b"\x89PNG\r\n\x1a\n"


def deck(folder: Path, *names: str) -> Path:
    """Write a deck of pictures."""
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(SVG.format(""), "utf-8")
    return folder


def test_cards_are_called_as_their_files_are(tmp_path: Path) -> None:
    deck(tmp_path, "b.PNG", "a.svg", "c d.jpeg", "e.webp", "names.csv", "en.ftl", ".hidden.png", "notes.txt")
    assert list(pictures_in(tmp_path)) == ["a", "b", "c d", "e"]


def test_pictures_that_cannot_be_cards_are_told(tmp_path: Path) -> None:
    for name, content in {
        "photo.heic": b"x",
        "cat.jpg": PNG,
        "dog.png": b"\xff\xd8\xff",
        "owl.webp": b"no picture",
        "fish.svg": SVG.format("").encode(),
        "fish.png": PNG,
        "empty.png": b"",
    }.items():
        (tmp_path / name).write_bytes(content)
    said = list(deck_faults(tmp_path))
    assert said == [
        f"the picture {tmp_path / 'cat.jpg'} is a PNG file; call it cat.png",
        f"the picture {tmp_path / 'dog.png'} is a JPEG file; call it dog.jpg",
        f"the picture {tmp_path / 'empty.png'} is empty",
        f"the pictures fish.png and fish.svg in {tmp_path} are one card; rename one of them",
        f"the picture {tmp_path / 'owl.webp'} is no WebP file",
        f"the picture {tmp_path / 'photo.heic'} is no PNG, JPEG, WebP or SVG file; save it as one of these",
    ]


def test_a_deck_of_too_many_pictures_is_refused_without_reading_them(tmp_path: Path) -> None:
    for number in range(MOST_PICTURES + 1):
        (tmp_path / f"{number}.png").touch()
    assert list(deck_faults(tmp_path)) == [
        f"the deck {tmp_path} has 501 pictures; keep the ones that you need, at most 500"
    ]


def test_a_deck_of_too_many_bytes_is_refused(tmp_path: Path) -> None:
    for number in range(MOST_DECK_BYTES // MOST_PICTURE_BYTES + 1):
        with (tmp_path / f"{number}.png").open("wb") as picture:
            picture.write(PNG)
            picture.truncate(MOST_PICTURE_BYTES)
    assert list(deck_faults(tmp_path)) == [
        f"the pictures in {tmp_path} have 260 MB together; save them smaller, at most 250 MB"
    ]


@pytest.mark.parametrize(
    ("inside", "why"),
    [
        ("<script>alert(1)</script>", "has <script> in it"),
        ('<g onload="alert(1)"/>', "has a script in onload of <g>"),
        ('<image href="http://far.test/a.png"/>', "takes 'http://far.test/a.png' from elsewhere"),
        ('<image xmlns:x="http://www.w3.org/1999/xlink" x:href="/etc/passwd"/>', "takes '/etc/passwd' from elsewhere"),
        ('<g style="fill: url(http://far.test/a)"/>', "takes something from elsewhere in style of <g>"),
        ("<style>@import 'a.css';</style>", "takes its style from another file"),
        ("<g>" * 300 + "</g>" * 300, "has more than 200 groups in one another"),
        ("<g>", "is no SVG: mismatched tag"),
        ("<foreignObject/>", "has <foreignObject> in it"),
    ],
)
def test_an_svg_that_does_more_than_show_a_picture_is_refused(inside: str, why: str, tmp_path: Path) -> None:
    file = tmp_path / "card.svg"
    file.write_text(SVG.format(inside), "utf-8")
    (said,) = picture_faults(file)
    assert said.startswith(f"the picture {file} {why}")
    assert "(line 1)" in said


def test_an_svg_with_entities_is_refused_before_they_grow(tmp_path: Path) -> None:
    file = tmp_path / "card.svg"
    many = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))
    file.write_text(f'<!DOCTYPE svg [<!ENTITY a0 "x">{many}]>{SVG.format("&a11;")}', "utf-8")
    (said,) = picture_faults(file)
    assert "declares the entity 'a0'" in said
    file.write_text(f'<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>{SVG.format("&x;")}', "utf-8")
    assert "declares the entity 'x'" in next(picture_faults(file))


def test_an_svg_as_drawing_programs_write_it_is_taken(tmp_path: Path) -> None:
    file = tmp_path / "card.svg"
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    used = '<g fill="url(#paint)"/><image href="data:image/png;base64,AAAA"/><use href="#a"/>'
    file.write_text(f'<?xml version="1.0"?>{doctype}{SVG.format(used)}', "utf-8")
    assert list(picture_faults(file)) == []
    shipped = [fault for each in (ASSETS / "cards").rglob("*.svg") for fault in picture_faults(each)]
    assert shipped == []


# Names

TABLE = "card;en;it;it.il\ncar.svg;car;auto;l'auto\nbus 7;bus;autobus;l'autobus\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_a_table_names_the_cards_in_every_language(encoding: str, tmp_path: Path) -> None:
    deck(tmp_path, "car.svg", "bus 7.svg", "tram.svg")
    (tmp_path / "names.csv").write_text(TABLE, encoding)
    names = read_names(tmp_path)
    assert set(names) == {"en", "it"}
    assert names["it"].forms == {
        "car": {"": "auto", "il": "l'auto"},
        "bus 7": {"": "autobus", "il": "l'autobus"},
    }
    assert names["en"].forms["bus 7"] == {"": "bus"}


@pytest.mark.parametrize(
    ("table", "why"),
    [
        ("name,en\ncar,car\n", "row 1: the first column must be 'card', but it is 'name'"),
        ("card,english\ncar,car\n", "row 1: 'english' is no language, such as 'en', and no form of one"),
        ("card,en,en\ncar,car,car\n", "row 1: the column 'en' stands twice"),
        ("card,en\nbus,bus\ncra,car\n", "row 3: there is no picture 'cra' in the folder; did you mean 'car'?"),
        ("card,en\ncar,car\ncar.svg,auto\n", "row 3: the card 'car' stands in row 2, too"),
        ("card,en\n,car\n", "row 2: the name of the card is missing"),
        (f"card,en\ncar,{'x' * 61}\n", "row 2: a name has at most 60 characters, but this has 61"),
        ('card,en\ncar,"car\n', "is no table: "),
        ("", "row 1: the first column must be 'card', but it is ''"),
    ],
)
def test_a_table_with_a_mistake_is_refused_with_its_row(table: str, why: str, tmp_path: Path) -> None:
    deck(tmp_path, "car.svg", "bus.svg")
    (tmp_path / "names.csv").write_text(table, "utf-8")
    with pytest.raises(UserInputError) as refused:
        read_names(tmp_path)
    assert str(refused.value).startswith(f"the names {tmp_path / 'names.csv'}")
    assert why in str(refused.value)


NAMES = ["car", 'the "best" car', "{ car }", "-car", "a\\b", ".car", "[car]", "voiture à 2"]


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_said_as_it_stands_whatever_is_in_it(name: str, tmp_path: Path) -> None:
    folder = deck(tmp_path / "toys", *(f"toy {number} (ö).svg" for number in range(12)))
    rows = "".join(f'toy {number} (ö),"{name.replace(chr(34), chr(34) * 2)} {number}"\n' for number in range(12))
    (folder / "names.csv").write_text(f"card,en\n{rows}", "utf-8")
    (tmp_path / "study.toml").write_text('languages = ["en"]\n[game]\ndeck = "toys"\n', "utf-8")
    study = read_study(Settings.read(tmp_path / "study.toml"))
    assert study.plans[0].catalogue.card("toy 3 (ö)")["card"] == f"{name} 3"
    assert [each for each in study_warnings(study) if "without a name" in each] == []
    replayed = Catalogue(ASSETS / "sentences" / "en", study.plans[0].catalogue.sources)
    assert replayed.card("toy 3 (ö)")["card"] == f"{name} 3"


def test_every_card_has_a_message_of_its_own() -> None:
    assert card_message("owl") == "card-owl"
    assert len({card_message(name) for name in ("a b", "a-b", "a_b", "ab", "ä", "a_20_b")}) >= 5


def test_forms_that_a_language_needs_and_a_table_lacks_are_cautioned(tmp_path: Path) -> None:
    folder = deck(tmp_path / "toys", *(f"toy{number}.svg" for number in range(12)))
    rows = "".join(f"toy{number},giocattolo,il giocattolo\n" for number in range(12))
    (folder / "names.csv").write_text(f"card,it,it.il\n{rows}", "utf-8")
    (tmp_path / "study.toml").write_text('languages = ["it"]\n[game]\ndeck = "toys"\n', "utf-8")
    (said,) = [each for each in study_warnings(read_study(Settings.read(tmp_path / "study.toml"))) if "lack" in each]
    assert "it.del, it.genere, it.plurale, it.questo" in said
    assert str(folder / "names.csv") in said


def test_a_table_to_fill_in_can_be_read_again(tmp_path: Path) -> None:
    deck(tmp_path, "a.svg", "b.svg")
    table = names_table(["a", "b"], {"en": (), "it": ("il",)}, {"it": {"a": {"": "una", "il": "l'una"}}})
    assert table.splitlines() == ["card,en,it,it.il", "a,,una,l'una", "b,,,"]
    (tmp_path / "names.csv").write_text(table, "utf-8")
    assert read_names(tmp_path)["it"].forms == {"a": {"": "una", "il": "l'una"}}
