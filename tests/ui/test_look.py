"""A lab's own look: its name, its logo and its colours, which are refused where texts could not be read."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import Look, Settings, contrast
from kiosk.study.loader import read_study
from tests.ui.headless import headless
from tests.ui.looking import items

LOGO = '<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100"><rect width="200" height="100"/></svg>'


def study(folder: Path, look: str) -> Path:
    """Return a study file with these lines about its look."""
    file = folder / "study.toml"
    file.write_text(f'languages = ["en"]\n[look]\n{look}\n', "utf-8")
    return file


@pytest.mark.parametrize(
    ("look", "says"),
    [
        ('accent = "#88AACC"', "look: accent: the contrast of '#88AACC' to what it is written on is 2.2:1"),
        ('background = "#204060"', "look: background: the contrast of '#204060' to the texts on it is 1.2:1"),
        ('accent = "teal"', "look.accent: 'teal' is no colour such as '#1F5F6B'"),
    ],
)
def test_a_colour_that_cannot_be_read_is_refused(tmp_path: Path, look: str, says: str) -> None:
    with pytest.raises(UserInputError) as refused:
        Settings.read(study(tmp_path, look))
    assert says in str(refused.value)


@pytest.mark.parametrize("key", ["accent", "background"])
@pytest.mark.parametrize("given", ["#FFB347", "#808080", "#777777", "#E07B39"])
def test_the_colour_that_is_said_to_pass_does(tmp_path: Path, key: str, given: str) -> None:
    with pytest.raises(UserInputError) as refused:
        Settings.read(study(tmp_path, f'{key} = "{given}"'))
    sentence = str(refused.value)
    assert "and must be 4.5:1" in sentence
    better = sentence.split("; '")[1].partition("' would pass")[0]
    look = Settings.read(study(tmp_path, f'{key} = "{better}"')).look
    assert contrast(look.accent, look.background) >= 4.5


def test_the_contrast_is_that_of_wcag() -> None:
    assert contrast("#000000", "#FFFFFF") == pytest.approx(21)
    assert contrast("#777777", "#FFFFFF") == pytest.approx(4.48, abs=0.005)
    assert contrast(Look().accent, Look().background) > 4.5


@pytest.mark.parametrize("name", ["./missing.svg", "./logo.png"])
def test_a_logo_that_is_missing_or_no_svg_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "logo.png").write_bytes(b"")
    with pytest.raises(UserInputError, match=r"look\.logo: there is no SVG file"):
        read_study(Settings.read(study(tmp_path, f'logo = "{name}"')))


@pytest.mark.usefixtures("qapp")
def test_the_start_screen_shows_the_labs_name_logo_and_colours(tmp_path: Path) -> None:
    (tmp_path / "logo.svg").write_text(LOGO, "utf-8")
    look = 'name = "Robot Lab"\nlogo = "./logo.svg"\naccent = "#7A1F3D"\nbackground = "#F4F4F8"'
    settings = Settings.read(study(tmp_path, look))
    assert read_study(settings).own_pictures == (tmp_path / "logo.svg",)
    with headless(settings, tmp_path / "data") as app:
        shown = {item.objectName(): item for item in items(app.window.contentItem())}
        words = [item for item in shown["lab"].childItems() if item.property("text") == "Robot Lab"]
        assert words[0].property("color").name() == "#7a1f3d"
        assert shown["logo"].property("source").toLocalFile() == str(tmp_path / "logo.svg")
        picture = app.window.grabWindow()
        assert picture.pixelColor(2, 2).name() == "#f4f4f8"
        logo = shown["logo"].mapRectToScene(shown["logo"].boundingRect()).center()
        assert picture.pixelColor(round(logo.x()), round(logo.y())).name() == "#000000"
