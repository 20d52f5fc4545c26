"""Puts the rooms together: from a study file to what a sitting follows."""

from __future__ import annotations

import logging
import subprocess
from logging.handlers import RotatingFileHandler
from pathlib import Path

from platformdirs import user_data_path

from kiosk import BadInput
from kiosk.assistant.qtable import QTable
from kiosk.assistant.wording import Catalogue
from kiosk.settings import ASSETS, Settings
from kiosk.study.condition import Condition
from kiosk.study.declared.information import Information, check_alike
from kiosk.study.declared.questionnaire import Questionnaire
from kiosk.study.plan import Plan, Study
from kiosk.study.stages import Course

DATA = user_data_path("recollect", appauthor=False)
"""Where a study's data are kept unless told otherwise."""

LOG = "recollect.log"
LOG_BYTES = 1_000_000
LOGS_KEPT = 3

_GIT_DEADLINE_S = 2


def read_settings(study: Path | None, robot_host: str | None = None, robot_port: int | None = None) -> Settings:
    """The settings of a study file, or the study's own without one; a robot's host or port goes before the file's."""
    settings = Settings.read(study) if study else Settings()
    if robot_host is None and robot_port is None:
        return settings
    robot = settings.robot
    found = {"kind": "furhat" if robot.kind == "none" else robot.kind}
    given = {"host": robot_host or robot.host, "port": robot_port or robot.port}
    return settings.model_copy(update={"robot": robot.model_copy(update=found | given)})


def read_study(settings: Settings) -> Study:
    """Everything that a study file names, read; raises BadInput for what is not there or does not fit."""
    plans = tuple(make_plan(settings, language) for language in settings.languages)
    check_alike({plan.language: plan.information for plan in plans}, settings.find("consent", settings.consent.text))
    return Study(plans)


def make_plan(settings: Settings, language: str | None = None) -> Plan:
    """All that a sitting in a language, or in the study's first, follows; raises BadInput for what is not there."""
    language = language or settings.languages[0]
    help_given = settings.assistance
    Course.of(settings.stages)
    return Plan(
        settings=settings,
        condition=Condition.named(help_given.condition),
        policy=QTable.named(help_given.policy),
        catalogue=Catalogue(settings.find("sentences", language)),
        information=Information.of(settings.find("consent", settings.consent.text), language),
        about_you=_questionnaire(settings, settings.about_you),
        questionnaires=tuple(_questionnaire(settings, name) for name in settings.questionnaires),
        deck=_deck(settings, settings.game.deck),
        practice_deck=_deck(settings, settings.practice.deck),
    )


def _questionnaire(settings: Settings, name: str) -> Questionnaire:
    shipped = settings.find("questionnaires", f"{name}.toml")
    return Questionnaire.read(shipped if shipped.is_file() else settings.find("questionnaires", name))


def _deck(settings: Settings, name: str) -> tuple[str, ...]:
    """The names of a deck's cards, in alphabetical order; raises BadInput if there is no such deck."""
    folder = settings.find("cards", name)
    if not folder.is_dir():
        decks = ", ".join(sorted(path.name for path in (ASSETS / "cards").iterdir() if path.is_dir()))
        raise BadInput(f"there is no deck {name!r}; there are {decks}")
    return tuple(sorted(path.stem for path in folder.glob("*.svg")))


def log_into(folder: Path) -> None:
    """Keep a log in a data folder, in files that never grow large; it holds faults and failures, nothing personal.

    Raises BadInput if it cannot be written there.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        handler = RotatingFileHandler(folder / LOG, maxBytes=LOG_BYTES, backupCount=LOGS_KEPT, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"the data folder {folder} cannot be used: {error.strerror}") from error
    logging.basicConfig(
        handlers=[handler], level=logging.WARNING, format="%(asctime)s %(levelname)s %(name)s: %(message)s"
    )


def code_commit() -> str:
    """The commit that runs, with "-dirty" if it was changed since; "released" outside a checkout."""
    try:
        described = subprocess.run(
            ["git", "describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"],  # noqa: S607 - git is on the path
            cwd=Path(__file__).parent,
            capture_output=True,
            text=True,
            timeout=_GIT_DEADLINE_S,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return "released"
    return described.stdout.strip()
