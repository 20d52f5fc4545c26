"""Import questionnaires from survey programs: XLSForm, REDCap, LimeSurvey and Qualtrics.

What a questionnaire here can ask is taken; everything else is named line by line.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.errors import validation_messages
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.language_codes import is_right, standard
from kiosk.study.csv_import import Heading, text_of_table
from kiosk.study.survey_import.limesurvey import is_limesurvey, take_limesurvey
from kiosk.study.survey_import.qualtrics import read_document, take_qualtrics
from kiosk.study.survey_import.redcap import is_redcap, take_redcap
from kiosk.study.survey_import.survey import Survey
from kiosk.study.survey_import.xlsform import read_workbook, take_xlsform


def is_survey(file: Path) -> bool:
    """Whether a file is one of a survey program, and not a table as docs/how-to/extend.md describes it."""
    if file.suffix.lower() in {".xlsx", ".qsf"}:
        return True
    if file.suffix.lower() not in {".csv", ".txt", ".tsv"} or not file.is_file():
        return False
    first = text_of_table(f"the table {file}", file).partition("\n")[0]
    return is_redcap(first) or is_limesurvey(first)


def read_survey(file: Path, heading: Heading, language: str = "en") -> tuple[Questionnaire, list[str]]:
    """Return the questionnaire of a survey program's file, and what of it was not taken.

    ``language`` is that of formats that do not name one. Raises UserInputError if the file is none, or nothing in it
    can be asked here.
    """
    if not is_right(language):
        raise UserInputError(f"{language!r} is no language code, such as 'de' or 'pt-BR'")
    survey = Survey(f"the file {file}", standard(language))
    if file.suffix.lower() == ".xlsx":
        take_xlsform(survey, read_workbook(survey.name, file))
    elif file.suffix.lower() == ".qsf":
        take_qualtrics(survey, read_document(survey.name, file))
    else:
        text = text_of_table(survey.name, file)
        first = text.partition("\n")[0]
        take = take_redcap if is_redcap(first) else take_limesurvey
        dialect = "," if take is take_redcap else "\t"
        take(survey, list(csv.DictReader(io.StringIO(text, newline=""), delimiter=dialect)))
    if not survey.items:
        raise UserInputError(f"{survey.name} has nothing that can be asked here", *survey.left)
    survey.set_conditions(heading.order)
    given = {**vars(heading), "items": survey.items}
    try:
        return Questionnaire.model_validate(given), list(dict.fromkeys(survey.left))
    except ValidationError as error:
        faults = validation_messages(error, given, Questionnaire)
        raise UserInputError(*(f"{survey.name}: {each}" for each in faults)) from error
