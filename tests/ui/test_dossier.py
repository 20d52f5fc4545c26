"""A study is one PDF for an ethics board, with every screen and every text in each language."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from html import escape
from pathlib import Path

import pytest
from PySide6.QtGui import QTextDocument

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue
from kiosk.config import Settings
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.loader import read_study
from kiosk.ui import dossier
from kiosk.ui.dossier import dossier_html, write_dossier
from kiosk.ui.window import RunMode
from tests.ui.headless import HALF

STUDY = read_study(
    Settings.model_validate(
        {
            "languages": ["en", "it"],
            "stages": ["game", "questions"],
            "questionnaires": ["trust"],
            "game": {"rows": 2, "columns": 2},
            "consent": {"contact": "lab@university.test"},
        }
    )
)


@pytest.mark.usefixtures("qapp")
def test_the_pdf_has_every_text_and_screen_of_each_language(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []
    plain = QTextDocument.setHtml

    def keep(document: QTextDocument, text: str) -> None:
        written.append(text)
        plain(document, text)

    monkeypatch.setattr(QTextDocument, "setHtml", keep)
    monkeypatch.setattr(dossier, "PICTURE_WIDTH", 240)
    monkeypatch.setattr(dossier, "RunMode", partial(RunMode, size=HALF.size))
    out = tmp_path / "study.pdf"
    pages = write_dossier(STUDY, 8, out)
    assert pages > 5
    assert out.read_bytes().startswith(b"%PDF")
    assert [file.name for file in tmp_path.iterdir()] == ["study.pdf"]
    (text,) = written
    for plan in STUDY.plans:
        assert all(escape(paragraph) in text for paragraph in plan.information.consent.paragraphs)
        assert all(escape(point) in text for point in plan.information.consent.points)
        assert all(escape(item.text[plan.language]) in text for item in plan.questionnaires[0].items)
        assert {"en": "<p>How far do you agree?</p>", "it": "<p>Quanto sei d"}[plan.language] in text
        for screen in ("attract", "board", "items-1"):
            assert f"-{screen}.png" in text.split(f"({plan.language})")[1]
        part = text.split(f"({plan.language})")[1]
        assert {"en": "What is stored", "it": "Che cosa viene registrato"}[plan.language] in part
    assert "What is stored" not in text.split("(it)")[1]
    assert STUDY.sha256 in text
    assert "lab@university.test" in text


def test_every_part_is_in_its_own_language_and_in_english_where_that_lacks_words() -> None:
    settings = Settings.model_validate({"languages": ["it", "es", "en"], "robot": {"kind": "furhat"}})
    study = read_study(settings)
    shown = "".join(dossier_html(study, 8, dict.fromkeys(study.languages, ())))
    _, *parts = re.split(r"\((?:it|es|en)\)</h1>", shown)
    headings = ("Che cosa succede", "Qué ocurre", "What happens in a session")
    for part, own in zip(parts, headings, strict=True):
        assert [heading for heading in headings if heading in part] == [own]
        assert f"{settings.consent.adult} " in part
        assert "furhat" in part
    english = study.plans[2].catalogue
    bare = {name: text for name, text in study.plans[0].catalogue.sources.items() if name != "dossier.ftl"}
    lacking = Catalogue(Path("it"), bare)
    lacking.followed_by([english])
    part = "".join(dossier_html(StudyConfig((replace(study.plans[0], catalogue=lacking),)), 8, {"it": ()}))
    assert "What happens in a session" in part
    assert not any(word in part for word in ("Condizioni", "versione"))


def test_a_place_that_cannot_be_written_is_refused_before_anything_is_done(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there is no folder"):
        write_dossier(STUDY, 8, tmp_path / "nowhere" / "study.pdf")
