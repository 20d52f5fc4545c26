"""Write a study as a PDF for an ethics board: flow, screens, texts, what is stored, and hashes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QMarginsF, QUrl
from PySide6.QtGui import QImage, QPageLayout, QPageSize, QPdfWriter, QTextDocument

from kiosk import UserInputError, __version__, unwritable
from kiosk.config import NO_ROBOT, RobotConfig, Settings
from kiosk.experiment.condition import Condition
from kiosk.experiment.questionnaire import Questionnaire, facts
from kiosk.experiment.session_config import SessionConfig, SessionKind, StudyConfig
from kiosk.files import check_writable
from kiosk.store.recorder import Recorder
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal, Screenshots
from kiosk.ui.session_runner import ConditionAssigner, RunContext
from kiosk.ui.simulated_visitor import BehaviourProfile, UiTimeout
from kiosk.ui.window import ClockMode, RunMode, WindowMode

SCREEN_WIDTH = 470
"""Of the picture of a screen on the page, in points."""
PICTURE_WIDTH = 1280
_MARGIN_MM = 18
_SEED = 1

_STYLE = """
body { font-family: 'Noto Sans'; font-size: 10pt; }
h1 { font-size: 20pt; } h2 { font-size: 15pt; } h3 { font-size: 12pt; }
th { text-align: left; } td, th { padding: 2px 8px 2px 0; vertical-align: top; }
p.note { color: #4A5A68; }
"""


def write_dossier(study: StudyConfig, minutes: int, out: Path) -> int:
    """Write the PDF, and return its number of pages; raises UserInputError or StorageError if it cannot be written.

    ``minutes`` is how long a visitor needs, about.
    A simulated visitor goes through a session in every language, so that every screen is as visitors see it.
    """
    check_writable(out)
    with TemporaryDirectory() as folder:
        shots = {language: _screens(study, language, Path(folder) / language) for language in study.languages}
        document = QTextDocument()
        document.setDefaultStyleSheet(_STYLE)
        for language, files in shots.items():
            for file in files:
                picture = QImage(str(file)).scaledToWidth(PICTURE_WIDTH)
                document.addResource(QTextDocument.ResourceType.ImageResource, _url(language, file), picture)
        document.setHtml("".join(_html(study, minutes, shots)))
        beside = out.with_name(f".{out.name}.new")
        writer = QPdfWriter(str(beside))
        writer.setTitle(study.settings.title)
        writer.setCreator(f"Recollect {__version__}")
        margins = QMarginsF(_MARGIN_MM, _MARGIN_MM, _MARGIN_MM, _MARGIN_MM)
        size = QPageSize(QPageSize.PageSizeId.A4)
        writer.setPageLayout(QPageLayout(size, QPageLayout.Orientation.Portrait, margins, QPageLayout.Unit.Millimeter))
        document.setPageSize(writer.pageLayout().paintRectPoints().size().toSizeF())
        document.print_(writer)
        del writer
        try:
            beside.replace(out)
        except OSError as error:
            raise unwritable(f"{out} cannot be written", error) from error
    return document.pageCount()


def _url(language: str, file: Path) -> QUrl:
    return QUrl(f"shot:///{language}/{file.name}")


def _screens(study: StudyConfig, language: str, folder: Path) -> list[Path]:
    """Return a picture of every screen of a session, in their order."""
    folder.mkdir()
    mode = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL)
    study = _without_robot(study)
    condition = study.condition(study.settings.assistance.condition)
    origin = RunContext("dossier", kind=SessionKind.SIMULATED, seed=lambda: _SEED, condition=condition)
    with (
        TemporaryDirectory() as unkept,
        Recorder(Path(unkept)) as recorder,
        App(mode, recorder, ConditionAssigner(study, recorder, origin)) as app,
    ):
        shots = Screenshots(app.window, folder, app.clock, 0)
        try:
            Rehearsal(app, _SEED, shots, BehaviourProfile(language=language)).run()
        except UiTimeout as stuck:
            raise UserInputError(f"a session in {language!r} does not come to its end: {stuck}") from stuck
    return sorted(folder.glob("*.png"))


def _without_robot(study: StudyConfig) -> StudyConfig:
    """Return the same study with the avatar alone, so that no robot need be there."""
    settings = study.settings.model_copy(update={"robot": RobotConfig()})
    return replace(study, plans=tuple(replace(plan, settings=settings) for plan in study.plans))


def _html(study: StudyConfig, minutes: int, shots: Mapping[str, Iterable[Path]]) -> Iterator[str]:
    settings = study.settings
    yield f"<h1>{escape(settings.title)}</h1>"
    yield (
        f"<p>A visitor needs about {minutes} minutes. Languages: "
        f"{escape(', '.join(study.languages))}.</p><p class='note'>Written by Recollect {__version__}. SHA-256 of the "
        f"study: {study.sha256}</p>"
    )
    yield "<h2>What happens in a session</h2>"
    yield _table(("stage", "what happens"), ((name, _STAGES.get(name, "")) for name in settings.stages))
    yield from _conditions(study)
    yield from _device(settings)
    yield from _stored(study)
    for plan in study.plans:
        yield from _language(plan, shots[plan.language])
    yield "<h2>Hashes</h2><p>Everything that sessions follow, with its SHA-256.</p>"
    rows = ((each.key, each.name, each.version or "", each.sha256) for each in study.sources)
    yield _table(("key", "name", "version", "SHA-256"), rows)


_STAGES = {
    "about": "The study is described.",
    "age": "The visitor says how old they are; those who are too young can play, and nothing is stored of them.",
    "consent": "The visitor agrees, or plays without being recorded.",
    "about_you": "Questions about the visitor.",
    "introduction": "The helper says what will happen.",
    "practice": "A short game to try it, which can be left at any time.",
    "game": "The game, with help as the condition says.",
    "result": "How the game went.",
    "questions": "The questionnaires.",
    "debrief": "The study is explained, with the code for deleting the data.",
    "thanks": "Thanks.",
}


def _table(heads: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    first = "".join(f"<th>{escape(head)}</th>" for head in heads)
    lines = ("".join(f"<td>{escape(str(cell))}</td>" for cell in row) for row in rows)
    return f"<table><tr>{first}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


def _conditions(study: StudyConfig) -> Iterator[str]:
    settings = study.settings
    targets: dict[str, object] = dict(settings.randomisation.target_n) or {settings.assistance.condition: ""}
    rows = []
    for name, target in targets.items():
        cell = settings.condition(Condition(name).name)
        reason = "says why" if cell.explanation else "gives no reason"
        place = "says where to look" if cell.location else "names no place"
        rows.append((name, target, f"A hint {reason} and {place}." if cell.helps else "There is no help."))
    yield "<h2>Conditions</h2><p>Each visitor is in one of them; the order was drawn before the first visitor.</p>"
    yield _table(("condition", "visitors", "help"), rows)


def _device(settings: Settings) -> Iterator[str]:
    yield "<h2>The helper, and safety</h2>"
    if settings.robot.kind == NO_ROBOT:
        yield "<p>The helper is a figure on the screen. No machine moves.</p>"
    else:
        does = ["speak"]
        does += ["show moods with its face"] if settings.robot.gestures else []
        does += ["look at the player and at the board"] if settings.robot.gaze else []
        yield (
            f"<p>The helper is a robot ({escape(settings.robot.kind)}). Recollect lets it {', '.join(does)}, and sends "
            "it nothing that moves it from its place. If it does not answer, a figure on the screen takes its place; "
            "the pictures here show that figure. The maker's instructions on safety, and the distance to the visitor, "
            "are the lab's to describe.</p>"
        )
    yield (
        "<p>A visitor can stop at any time. A visitor who does nothing is asked whether they are still there; then the "
        "session ends. An experimenter can pause or end it.</p>"
    )


def _stored(study: StudyConfig) -> Iterator[str]:
    settings = study.settings
    care = settings.experimenter
    rows = [
        ("What", "Every card that is turned and when, hints, answers, consent, and what was typed into text fields."),
        ("What not", "No name unless a visitor types it, no picture, no sound, no address of a device."),
        ("Where", "In a database in a folder on the kiosk, which only its user can read; nothing is sent elsewhere."),
        ("Copies", f"A copy every {care.backup_every} minutes between sessions; the newest {care.backups} are kept."),
        (
            "How long",
            "Recollect deletes nothing by itself after a time. How long the lab keeps the data stands in the "
            "information sheet, or is to be added here.",
        ),
        (
            "Who can delete it",
            "Each visitor gets a code. With it, the lab deletes the session and its copies on the kiosk "
            f"('recollect withdraw CODE'). Contact: {settings.consent.contact or 'none is given yet'}.",
        ),
        (
            "Who stops",
            "Their session is deleted at once." if settings.consent.on_withdrawal == "delete"
            else "What was recorded by then is kept as withdrawn, unless they ask for its deletion.",
        ),
        ("From which age", f"From {settings.consent.adult} years on; sessions of younger visitors are not stored."),
    ]  # fmt: skip
    yield "<h2>What is stored</h2>"
    yield _table(("", ""), rows)


def _language(plan: SessionConfig, shots: Iterable[Path]) -> Iterator[str]:
    sheet, language = plan.information, plan.language
    name = escape(plan.catalogue.text("language-name"))
    yield f"<h1 style='page-break-before: always'>{name} ({escape(language)})</h1>"
    yield f"<h2>Information and consent, version {escape(sheet.version)}</h2>"
    for page in (sheet.about, sheet.consent, sheet.debrief):
        points = "".join(f"<p><b>{escape(each)}</b></p>" for each in page.points)
        yield f"<h3>{escape(page.title)}</h3>{points}" + "".join(f"<p>{escape(each)}</p>" for each in page.paragraphs)
        if page is sheet.consent:
            marks = (f"{each.text}{'' if each.required else ' *'}" for each in sheet.consent.purposes)
            yield f"<ul>{''.join(f'<li>{escape(each)}</li>' for each in marks)}</ul><p class='note'>* not required</p>"
    yield "<h2>Every item</h2>"
    for asked in (plan.about_you, *plan.questionnaires):
        yield from _items(asked, language)
    yield "<h2>Every screen</h2>"
    for file in shots:
        source = _url(language, file).toString()
        yield f"<p><img src='{escape(source)}' width='{SCREEN_WIDTH}'/><br/>{escape(file.stem)}</p>"


def _items(asked: Questionnaire, language: str) -> Iterator[str]:
    yield f"<h3>{escape(asked.id)}, version {escape(asked.version)}</h3><p class='note'>{escape(asked.note)}</p>"
    yield f"<ol>{''.join(f'<li>{escape(facts(item, language))}</li>' for item in asked.items)}</ol>"
