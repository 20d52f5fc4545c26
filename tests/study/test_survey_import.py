"""Questionnaires come in from survey programs; what cannot be asked here is named, and nothing is lost in silence."""

from __future__ import annotations

import json
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.sax.saxutils import escape

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.items import Integer, Likert, Multiple, Single, Slider
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.study.csv_import import Heading, read_items
from kiosk.study.survey_import import is_survey, read_survey

HEADING = Heading(id="asked", version="1", note="n")
MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATIONS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"


def workbook(file: Path, sheets: dict[str, list[list[str]]], extra: str = "") -> Path:
    """Write the least that a spreadsheet program would write."""
    listed = "".join(f'<sheet name="{name}" sheetId="{n}" r:id="r{n}"/>' for n, name in enumerate(sheets, 1))
    related = "".join(f'<Relationship Id="r{n}" Target="worksheets/s{n}.xml"/>' for n, _ in enumerate(sheets, 1))
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(
            "xl/workbook.xml", f'<workbook xmlns="{MAIN}" xmlns:r="{RELATIONS}"><sheets>{listed}</sheets></workbook>'
        )
        archive.writestr("xl/_rels/workbook.xml.rels", f"<Relationships>{related}</Relationships>")
        texts: list[str] = []
        for number, rows in enumerate(sheets.values(), 1):
            lines = ""
            for at, row in enumerate(rows, 1):
                cells = ""
                for column, text in zip("ABCDEFGH", row, strict=False):
                    if text:
                        cells += f'<c r="{column}{at}" t="s"><v>{len(texts)}</v></c>'
                        texts.append(text)
                lines += f'<row r="{at}">{cells}</row>'
            archive.writestr(
                f"xl/worksheets/s{number}.xml",
                f'{extra}<worksheet xmlns="{MAIN}"><sheetData>{lines}</sheetData></worksheet>',
            )
        shared = "".join(f"<si><t>{escape(text)}</t></si>" for text in texts)
        archive.writestr("xl/sharedStrings.xml", f'<sst xmlns="{MAIN}">{shared}</sst>')
    return file


SURVEY = [
    ["type", "name", "label::English (en)", "label::Deutsch (de)", "required", "relevant", "constraint"],
    ["note", "hello", "Hello.", "Hallo."],
    ["select_one yn", "liked", "Did you like it?", "Hat es gefallen?", "yes", "${age} > 3"],
    ["select_multiple yn", "both", "Which?", "Welche?"],
    ["integer", "age", "How old?", "Wie alt?", "", "", ". >= 1 and . < 100"],
    ["begin group", "g"],
    ["text", "why not", "Why?", "Warum?"],
    ["end group"],
    ["geopoint", "where", "Where?", "Wo?"],
]
CHOICES = [
    ["list_name", "name", "label::English (en)", "label::Deutsch (de)"],
    ["yn", "1", "Yes", "Ja"],
    ["yn", "0", "No", "Nein"],
]


def test_an_xlsform_is_taken_and_what_is_not_is_named_by_its_row(tmp_path: Path) -> None:
    file = workbook(tmp_path / "form.xlsx", {"survey": SURVEY, "choices": CHOICES})
    read, left = read_survey(file, HEADING)
    assert [(item.id, item.kind) for item in read.items] == [
        ("hello", "page"), ("liked", "single"), ("both", "multiple"), ("age", "integer"), ("why_not", "text"),
    ]  # fmt: skip
    liked, age = read.items[1], read.items[3]
    assert isinstance(liked, Single)
    assert liked.text == {"en": "Did you like it?", "de": "Hat es gefallen?"}
    assert liked.ids == ("1", "0")
    assert liked.required is True
    assert isinstance(age, Integer)
    assert (age.lowest, age.highest) == (1, 99)
    assert "survey, row 3: its condition (${age} > 3) is not taken: it is always asked" in left
    assert "survey, row 9: the type 'geopoint' is not taken" in left
    assert any("the name 'why not' is 'why_not' here" in each for each in left)
    assert any("begin group" in each for each in left)


REDCAP = """\
"Variable / Field Name","Form Name","Section Header","Field Type","Field Label","Choices, Calculations, OR Slider Labels","Field Note","Text Validation Type OR Show Slider Number","Text Validation Min","Text Validation Max",Identifier?,"Branching Logic (Show field only if...)","Required Field?"
sex,f,,radio,"<b>Sex</b>","1, Male | 2, Female",,,,,,,y
age,f,,text,Age,,,integer,18,99,,"[sex] = '1'",
mood,f,,slider,Mood,"bad | so so | good",,,,,,,
ok,f,,yesno,OK?,,,,,,,,
sum,f,,calc,Sum,"[a]+[b]",,,,,,,
"""  # noqa: E501 - as REDCap writes it


def test_a_redcap_dictionary_is_taken(tmp_path: Path) -> None:
    file = tmp_path / "dictionary.csv"
    file.write_text(REDCAP, "utf-8-sig")
    assert is_survey(file)
    read, left = read_survey(file, HEADING)
    assert [(item.id, item.kind) for item in read.items] == [
        ("sex", "single"), ("age", "integer"), ("mood", "slider"), ("ok", "single"),
    ]  # fmt: skip
    sex, age, mood, _ = read.items
    assert isinstance(sex, Single)
    assert (sex.text, sex.ids, sex.required) == ({"en": "Sex"}, ("1", "2"), True)
    assert isinstance(age, Integer)
    assert (age.lowest, age.highest) == (18, 99)
    assert isinstance(mood, Slider)
    assert (mood.left, mood.right) == ({"en": "bad"}, {"en": "good"})
    assert "row 6, sum: the field type 'calc' is not taken" in left
    assert "row 2, sex: its markup is not taken; the words are" in left
    assert age.relevant == "sex = 1"
    assert not any("branching logic" in each for each in left)


LIME = [
    ["class", "type/scale", "name", "relevance", "text", "language", "mandatory"],
    ["S", "", "sid", "", "1", "", ""],
    ["G", "", "group", "1", "", "de", ""],
    ["Q", "F", "trust", "1", "Wie sehr?", "de", "Y"],
    ["SQ", "", "a", "", "Dem Roboter", "de", ""],
    ["SQ", "", "b", "", "Dem Spiel", "de", ""],
    ["A", "", "A1", "", "wenig", "de", ""],
    ["A", "", "A2", "", "sehr", "de", ""],
    ["Q", "M", "which", "trust > 1", "Welche?", "de", "N"],
    ["SQ", "", "x", "", "Eins", "de", ""],
    ["SQ", "", "y", "", "Zwei", "de", ""],
    ["Q", "5", "stars", "1", "Sterne?", "de", "N"],
    ["Q", "*", "equation", "1", "{a+b}", "de", "N"],
]


def test_a_limesurvey_file_is_taken(tmp_path: Path) -> None:
    file = tmp_path / "survey.txt"
    file.write_text("\n".join("\t".join(row) for row in LIME), "utf-8-sig")
    assert is_survey(file)
    read, left = read_survey(file, HEADING)
    assert [item.id for item in read.items] == ["trust_a", "trust_b", "which", "stars"]
    first, _, which, stars = read.items
    assert isinstance(first, Single)
    assert first.text == {"de": "Wie sehr?\nDem Roboter"}
    assert isinstance(which, Multiple)
    assert isinstance(stars, Likert)
    assert stars.points == 5
    assert any("its relevance (trust > 1) is not taken" in each for each in left)
    assert any("the type '*' is not taken" in each for each in left)


def test_a_limesurvey_array_without_parts_is_one_question_with_its_text_once(tmp_path: Path) -> None:
    file = tmp_path / "survey.txt"
    rows = [row for row in LIME[:8] if row[0] != "SQ"]
    file.write_text("\n".join("\t".join(row) for row in rows), "utf-8")
    (item,) = read_survey(file, HEADING)[0].items
    assert (item.id, item.text) == ("trust", {"de": "Wie sehr?"})


def question(name: str, kind: str, selector: str, **more: object) -> dict[str, object]:
    payload = {"QuestionText": f"{name}?", "DataExportTag": name, "QuestionType": kind, "Selector": selector, **more}
    return {"Element": "SQ", "Payload": payload}


def test_a_qualtrics_file_is_taken(tmp_path: Path) -> None:
    choices = {"1": {"Display": "Yes"}, "2": {"Display": "No"}}
    elements = [
        {"Element": "BL", "Payload": []},
        question("Q1", "MC", "SAVR", Choices=choices, ChoiceOrder=["2", "1"]),
        question(
            "Q2", "Matrix", "Likert", Choices=choices, Answers={"1": {"Display": "low"}, "2": {"Display": "high"}}
        ),
        question("Q3", "TE", "SL", Validation={"Settings": {"ForceResponse": "ON"}}, DisplayLogic={"0": {}}),
        question("Q4", "Captcha", "V2"),
    ]
    file = tmp_path / "survey.qsf"
    file.write_text(json.dumps({"SurveyElements": elements}), "utf-8")
    read, left = read_survey(file, HEADING)
    assert [item.id for item in read.items] == ["Q1", "Q2_1", "Q2_2", "Q3"]
    first = read.items[0]
    assert isinstance(first, Single)
    assert first.ids == ("2", "1")
    assert "the question Q4: the question type 'Captcha' V2 is not taken" in left
    assert "the question Q3: its display logic is not taken: it is always asked" in left


CONDITIONS = [
    ["type", "name", "label::English (en)", "relevant"],
    ["select_one yn", "liked", "Did you like it?"],
    ["select_multiple yn", "both", "Which?", "selected(${liked}, '1') and not(${liked} = '0')"],
    ["integer", "age", "How old?", "${both} != ''"],
    ["text", "why", "Why?", "${age} >= 18 or ${liked} = '0'"],
    ["text", "sum", "Sum?", "${age} + 1 > 18"],
    ["text", "gone", "Gone?", "${nowhere} = 1"],
    ["text", "never", "Never?", "${age} > 3 and ${age} < 2"],
    ["begin group", "g", "", "${age} > 3"],
    ["text", "then", "Then?"],
    ["begin_repeat", "r", "", "${sum} != ''"],
    ["text", "both of them", "Both?", "${liked} = '1'"],
    ["text", "neither", "Neither?", "${age} < 2"],
    ["end_repeat"],
    ["end group"],
    ["begin group", "h", "", "position(..) = 1"],
    ["text", "last", "Last?", "${age} > 1"],
    ["end group"],
    ["text", "after", "After?"],
]


def test_conditions_of_an_xlsform_are_taken_as_far_as_they_can_be_said(tmp_path: Path) -> None:
    file = workbook(tmp_path / "form.xlsx", {"survey": CONDITIONS, "choices": CHOICES})
    read, left = read_survey(file, HEADING)
    assert {item.id: item.relevant for item in read.items} == {
        "liked": "",
        "both": "selected(liked, 1) and not(liked = 0)",
        "age": "answered(both)",
        "why": "age >= 18 or liked = 0",
        "sum": "",
        "gone": "",
        "never": "",
        "then": "age > 3",
        "both_of_them": "(age > 3) and (answered(sum)) and (liked = 1)",
        "neither": "(age > 3) and (answered(sum))",
        "last": "age > 1",
        "after": "",
    }
    told = "its condition ({}) is not taken: it is always asked"
    for row, condition in ((6, "${age} + 1 > 18"), (7, "${nowhere} = 1"), (8, "${age} > 3 and ${age} < 2")):
        assert f"survey, row {row}: {told.format(condition)}" in left
    assert f"survey, row 13: {told.format('${age} < 2')}" in left
    assert "survey, row 16: its condition (position(..) = 1) is not taken: what is in it is always asked" in left
    assert sum("condition" in each for each in left) == 5


def test_a_shuffled_import_takes_no_conditions_and_says_so(tmp_path: Path) -> None:
    file = workbook(tmp_path / "form.xlsx", {"survey": CONDITIONS[:3], "choices": CHOICES})
    read, left = read_survey(file, replace(HEADING, order=ItemOrder.SHUFFLED))
    assert [item.relevant for item in read.items] == ["", ""]
    assert any(each.startswith("survey, row 3: its condition") for each in left)


@pytest.mark.parametrize(
    ("logic", "condition"),
    [
        ("[sex] = '1'", "sex = 1"),
        ('[sex] <> "1" and [age] >= 18', "sex != 1 and age >= 18"),
        ("[seen(2)] = '1' or [seen(1)] = '0'", "selected(seen, '2') or not selected(seen, '1')"),
        ("[age] <> ''", "answered(age)"),
        ("[age] = ''", "not answered(age)"),
        ("datediff([a], 'today', 'y') > 3", ""),
        ("[arm_1][age] > 3", ""),
    ],
)
def test_branching_logic_of_redcap_is_taken_as_far_as_it_can_be_said(
    tmp_path: Path, logic: str, condition: str
) -> None:
    head, sex, age = (REDCAP.replace(",\"[sex] = '1'\",", ",,").splitlines()[line] for line in (0, 1, 2))
    seen = 'seen,f,,checkbox,Seen,"1, Cat | 2, Dog",,,,,,,'
    quoted = logic.replace('"', '""')
    last = f'last,f,,text,Last,,,,,,,"{quoted}",'
    file = tmp_path / "dictionary.csv"
    file.write_text("\n".join((head, sex, age, seen, last)), "utf-8")
    read, left = read_survey(file, HEADING)
    assert read.items[-1].relevant == condition
    assert any(logic in each for each in left) is (not condition)


@pytest.mark.parametrize(
    ("relevance", "condition"),
    [
        ("stars.NAOK > 2", "stars > 2"),
        ("((stars.NAOK == 3) && !is_empty(stars))", "((stars = 3) and answered(stars))"),
        ("stars == '1' or stars == 5", "stars = 1 or stars = 5"),
        ("count(that.stars) > 2", ""),
    ],
)
def test_relevance_of_limesurvey_is_taken_as_far_as_it_can_be_said(
    tmp_path: Path, relevance: str, condition: str
) -> None:
    rows = [LIME[0], LIME[2], ["Q", "5", "stars", "1", "Sterne?", "de", "N"]]
    rows.append(["Q", "S", "last", relevance, "Warum?", "de", "N"])
    file = tmp_path / "survey.txt"
    file.write_text("\n".join("\t".join(row) for row in rows), "utf-8")
    read, left = read_survey(file, HEADING)
    assert read.items[-1].relevant == condition
    assert any(relevance in each for each in left) is (not condition)


def test_the_relevance_of_a_group_of_limesurvey_is_that_of_its_questions(tmp_path: Path) -> None:
    rows = [LIME[0], LIME[2], ["Q", "5", "stars", "1", "Sterne?", "de", "N"]]
    rows += [["G", "", "few", "stars < 3", "", "de", ""], ["Q", "S", "why", "1", "Warum?", "de", "N"]]
    rows += [["Q", "S", "else", "stars == 1", "Und?", "de", "N"], LIME[2], ["Q", "S", "end", "1", "Ende?", "de", "N"]]
    file = tmp_path / "survey.txt"
    file.write_text("\n".join("\t".join(row) for row in rows), "utf-8")
    read, left = read_survey(file, HEADING)
    assert [item.relevant for item in read.items] == ["", "stars < 3", "(stars < 3) and (stars = 1)", ""]
    assert not any("relevance" in each for each in left)


def test_display_logic_of_qualtrics_is_taken_where_it_asks_for_choices(tmp_path: Path) -> None:
    def line(operator: str, choice: str, conjunction: str = "", of: str = "QID1") -> dict[str, str]:
        place = f"q://{of}/SelectableChoice/{choice}"
        return {"LogicType": "Question", "LeftOperand": place, "Operator": operator, "Conjuction": conjunction}

    def logic(*lines: dict[str, str]) -> dict[str, object]:
        group = {str(number): each for number, each in enumerate(lines)} | {"Type": "If"}
        return {"0": group, "Type": "BooleanExpression", "inPage": False}

    choices = {"1": {"Display": "Yes"}, "2": {"Display": "No"}}
    first = question("Q1", "MC", "SAVR", Choices=choices) | {"PrimaryAttribute": "QID1"}
    shown = logic(line("Selected", "1"), line("NotSelected", "2", "AndIf"))
    elements = [
        first,
        question("Q2", "TE", "SL", DisplayLogic=shown),
        question("Q3", "TE", "SL", DisplayLogic=logic(line("Selected", "1", of="QID9"))),
        question("Q4", "TE", "SL", DisplayLogic=logic(line("GreaterThan", "1"))),
    ]
    file = tmp_path / "survey.qsf"
    file.write_text(json.dumps({"SurveyElements": elements}), "utf-8")
    read, left = read_survey(file, HEADING)
    assert [item.relevant for item in read.items] == ["", "(selected(Q1, '1')) and not selected(Q1, '2')", "", ""]
    told = "its display logic is not taken: it is always asked"
    assert left == [f"the question Q3: {told}", f"the question Q4: {told}"]


def bad_workbook(folder: Path, kind: str) -> Path:
    """Write a file that is no form, of one kind or another."""
    file = folder / "form.xlsx"
    match kind:
        case "no workbook":
            file.write_bytes(b"PK, but not really")
        case "entities":
            workbook(file, {"survey": SURVEY}, '<!DOCTYPE x [<!ENTITY a "aaaa">]>')
        case "no sheet":
            workbook(file, {"other": SURVEY})
        case "a bomb":
            with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
                archive.writestr("xl/workbook.xml", bytes(20_000_000))
        case "nothing to ask":
            workbook(file, {"survey": [SURVEY[0], SURVEY[-1]]})
    return file


@pytest.mark.parametrize(
    ("kind", "why"),
    [
        ("no workbook", r"is not an \.xlsx workbook"),
        ("entities", "document type"),
        ("no sheet", "has no sheet 'survey'"),
        ("a bomb", "is too large"),
        ("nothing to ask", "has nothing that can be asked here"),
        ("missing", "cannot be read"),
    ],
)
def test_a_workbook_that_is_no_form_is_refused(kind: str, why: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=why):
        read_survey(bad_workbook(tmp_path, kind), HEADING)


@pytest.mark.parametrize("content", ["[]", "{}", "not JSON", '{"SurveyElements": [{"Element": "SQ", "Payload": 1}]}'])
def test_a_qsf_file_that_is_none_is_refused(content: str, tmp_path: Path) -> None:
    (tmp_path / "s.qsf").write_text(content, "utf-8")
    with pytest.raises(UserInputError):
        read_survey(tmp_path / "s.qsf", HEADING)


def test_the_command_writes_what_is_taken_and_names_the_rest(tmp_path: Path) -> None:
    file = workbook(tmp_path / "form.xlsx", {"survey": SURVEY, "choices": CHOICES})
    out = tmp_path / "asked.toml"
    command = ["study", "import", str(file), "--id", "asked", "--version", "1", "--out", str(out), "--per-page", "3"]
    said = CliRunner().invoke(recollect, command)
    assert said.exit_code == 0, said.output
    assert "5 items written to" in said.output
    assert "not taken: survey, row 9: the type 'geopoint' is not taken" in said.output
    assert Questionnaire.read(out).per_page == 3


def test_the_command_names_what_has_to_be_changed_before_a_study_takes_it(tmp_path: Path) -> None:
    choices = [CHOICES[0], ["yn", "yes", "Yes", "Ja"], ["yn", "YES", "Indeed", "Gewiss"]]
    file = workbook(tmp_path / "form.xlsx", {"survey": SURVEY[:3], "choices": choices})
    out = tmp_path / "asked.toml"
    said = CliRunner().invoke(
        recollect, ["study", "import", str(file), "--id", "asked", "--version", "1", "--out", str(out)]
    )
    assert said.exit_code == 0, said.output
    assert f"to change in {out} before it is used:" in said.output
    assert "the options 'yes' and 'YES' are one name" in said.output


def test_a_table_in_windows_1252_is_read_with_its_accents(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_bytes("id;kind;text_it\nfine;page;Perché è così\n".encode("cp1252"))
    assert read_items(file, HEADING).items[0].text == {"it": "Perché è così"}
