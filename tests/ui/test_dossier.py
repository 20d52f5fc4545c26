"""A study is one PDF for an ethics board, with every screen and every text in each language."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtGui import QTextDocument

from kiosk import UserInputError
from kiosk.config import Settings
from kiosk.study.loader import read_study
from kiosk.ui import dossier
from kiosk.ui.dossier import write_dossier

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
    out = tmp_path / "study.pdf"
    pages = write_dossier(STUDY, 8, out)
    assert pages > 5
    assert out.read_bytes().startswith(b"%PDF")
    assert [file.name for file in tmp_path.iterdir()] == ["study.pdf"]
    (text,) = written
    for plan in STUDY.plans:
        assert all(paragraph.split("'")[0] in text for paragraph in plan.information.consent.paragraphs)
        assert all(point.split("'")[0] in text for point in plan.information.consent.points)
        assert all(item.text[plan.language].split("'")[0] in text for item in plan.questionnaires[0].items)
        for screen in ("attract", "board", "items-1"):
            assert f"-{screen}.png" in text.split(f"({plan.language})")[1]
    assert STUDY.sha256 in text
    assert "lab@university.test" in text


def test_a_place_that_cannot_be_written_is_refused_before_anything_is_done(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there is no folder"):
        write_dossier(STUDY, 8, tmp_path / "nowhere" / "study.pdf")
