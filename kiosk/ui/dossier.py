"""Write a study as a PDF for an ethics board: flow, screens, texts, what is stored, and hashes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from html import escape, unescape
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QMarginsF, QUrl
from PySide6.QtGui import QImage, QPageLayout, QPageSize, QPdfWriter, QTextDocument

from kiosk import UserInputError, __version__, unwritable
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, NO_ROBOT, RobotConfig, Settings
from kiosk.experiment.condition import Condition
from kiosk.experiment.information import Information
from kiosk.experiment.items import Choice, Integer, Question, Rating, TextPage, in_language
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.questionnaire import Item
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.files import check_writable
from kiosk.store.recorder import Recorder
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.screenshots import Screenshots
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
        document.setHtml("".join(dossier_html(study, minutes, shots)))
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


class _Words:
    """The dossier's own words in one language; all of them are in English where a study's own language lacks any."""

    def __init__(self, catalogue: Catalogue) -> None:
        english = Catalogue(ASSETS / "sentences" / "en")
        needed = {name for name in english.written if name.startswith(_WORDS)}
        self._catalogue = catalogue if needed <= catalogue.written.keys() else english

    def __call__(self, message: str, **variables: str | int) -> str:
        """Return a text, ready for HTML."""
        return escape(self._catalogue.text(f"{_WORDS}{message}", **variables))


_WORDS = "dossier-"


def dossier_html(study: StudyConfig, minutes: int, shots: Mapping[str, Iterable[Path]]) -> Iterator[str]:
    """Yield the dossier as HTML; ``shots`` holds the pictures of the screens by language."""
    words = _Words(study.plans[0].catalogue)
    yield f"<h1>{escape(study.settings.title)}</h1>"
    yield f"<p class='note'>{words('written')} {study.sha256} ({__version__})</p>"
    for number, plan in enumerate(study.plans):
        yield from _language(plan, minutes, shots[plan.language], on_new_page=number > 0)
    yield f"<h2>{words('hashes')}</h2><p>{words('hashes-line')}</p>"
    rows = ((each.key, each.name, each.version or "", each.sha256) for each in study.sources)
    yield _table((words("key"), words("name"), words("version"), "SHA-256"), rows)


def _language(plan: SessionConfig, minutes: int, shots: Iterable[Path], *, on_new_page: bool) -> Iterator[str]:
    """Yield all that there is to say in one language."""
    words, settings, language = _Words(plan.catalogue), plan.settings, plan.language
    place = " style='page-break-before: always'" if on_new_page else ""
    yield f"<h1{place}>{escape(plan.catalogue.text('language-name'))} ({escape(language)})</h1>"
    yield f"<p>{words('minutes', minutes=minutes)}</p><h2>{words('flow')}</h2>"
    stages = ((stage, words(f"stage-{stage}")) for stage in settings.stages)
    yield _table((words("stage"), words("happens")), stages)
    yield from _conditions(settings, words)
    yield from _device(settings, words)
    yield f"<h2>{words('stored')}</h2>"
    yield _table(("", ""), _stored(settings, words))
    yield from _information(plan.information, words)
    yield f"<h2>{words('items')}</h2>"
    for asked in (plan.about_you, *plan.questionnaires):
        yield f"<h3>{escape(asked.id)}, {words('version')} {escape(asked.version)}</h3>"
        yield f"<p class='note'>{escape(asked.note)}</p>"
        yield f"<p>{escape(in_language(asked.title, language))}</p><ol>" if asked.title else "<ol>"
        yield from (f"<li>{'<br/>'.join(_item(item, language, words))}</li>" for item in asked.items)
        yield "</ol>"
    yield f"<h2>{words('screens')}</h2>"
    for file in shots:
        source = _url(language, file).toString()
        yield f"<p><img src='{escape(source)}' width='{SCREEN_WIDTH}'/><br/>{escape(file.stem)}</p>"


def _table(heads: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    """Return a table; its heads are HTML already, and so are words in its rows."""
    first = "".join(f"<th>{head}</th>" for head in heads)
    lines = ("".join(f"<td>{cell}</td>" for cell in row) for row in rows)
    return f"<table><tr>{first}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


def _conditions(settings: Settings, words: _Words) -> Iterator[str]:
    targets: dict[str, object] = dict(settings.randomisation.target_n) or {settings.assistance.condition: ""}
    rows = []
    for name, target in targets.items():
        cell = settings.condition(Condition(name).name)
        told = {(True, True): "why-where", (True, False): "why", (False, True): "where", (False, False): "plain"}
        message = f"help-{told[cell.explanation, cell.location]}" if cell.helps else "help-none"
        told_of = words("help-gaze" if cell.gaze_only else message)
        if cell.comments:
            rates = {"praise": f"{100 * cell.praise:g}", "encourage": f"{100 * cell.encourage:g}"}
            told_of += f" {words('help-comments', **rates)}"
        rows.append((escape(name), target, told_of))
    yield f"<h2>{words('conditions')}</h2><p>{words('conditions-line')}</p>"
    yield _table((words("condition"), words("visitors"), words("help")), rows)


def _device(settings: Settings, words: _Words) -> Iterator[str]:
    yield f"<h2>{words('helper')}</h2>"
    robot = settings.robot
    if robot.kind == NO_ROBOT:
        yield f"<p>{words('avatar')}</p>"
    else:
        does = {"speaks": True, "gestures": robot.gestures, "gaze": robot.gaze}
        points = "".join(f"<li>{words(f'robot-{name}')}</li>" for name, does_it in does.items() if does_it)
        yield f"<p>{words('robot')} {escape(robot.kind)}</p><ul>{points}</ul><p>{words('robot-limits')}</p>"
    yield f"<p>{words('stop')}</p>"


def _stored(settings: Settings, words: _Words) -> Iterator[tuple[str, str]]:
    """Yield what is said of the data, each with its heading."""
    care, consent = settings.experimenter, settings.consent
    for name in ("what", "what-not", "where"):
        yield words(name), words(f"{name}-line")
    yield words("copies"), words("copies-line", minutes=care.backup_every, count=care.backups)
    yield words("how-long"), words("how-long-line")
    contact = consent.contact or unescape(words("contact-none"))
    yield words("who"), words("who-line", contact=contact)
    yield words("who-stops"), words(f"who-stops-{'delete' if consent.on_withdrawal == 'delete' else 'keep'}")
    yield words("age"), words("age-line", count=consent.adult)


def _information(sheet: Information, words: _Words) -> Iterator[str]:
    yield f"<h2>{words('information')}, {words('version')} {escape(sheet.version)}</h2>"
    for page in (sheet.about, sheet.consent, sheet.debrief):
        points = "".join(f"<p><b>{escape(each)}</b></p>" for each in page.points)
        yield f"<h3>{escape(page.title)}</h3>{points}" + "".join(
            f"<p>{escape(each).replace(chr(10), '<br/>')}</p>" for each in page.paragraphs
        )
        if page is sheet.consent:
            marks = (f"{each.text}{'' if each.required else ' *'}" for each in sheet.consent.purposes)
            listed = "".join(f"<li>{escape(each)}</li>" for each in marks)
            yield f"<ul>{listed}</ul><p class='note'>* {words('optional')}</p>"


def _item(item: Item, language: str, words: _Words) -> Iterator[str]:
    """Yield what an item asks, and what can be answered, in lines."""
    yield f"<b>{escape(in_language(item.text, language).strip())}</b>"
    match item:
        case Choice():
            options = ", ".join(in_language(option.text, language) for option in item.options)
            yield f"{words('answer-any' if item.answer_format.several else 'answer-one')} {escape(options)}"
        case Integer():
            yield words("answer-whole", lowest=item.lowest, highest=item.highest)
        case Rating():
            least, most = item.ends
            _, *ends = (in_language(text, language) for text in item.texts())
            yield f"{words('answer-points', lowest=least, highest=most)} {escape(' / '.join(ends))}"
        case TextPage():
            yield words("answer-page")
        case _:
            yield words("answer-text")
    if isinstance(item, Question) and item.not_applicable:
        yield words("not-applicable")
    if item.relevant:
        yield f"{words('relevant')} {escape(item.relevant)}"
