"""CSV tables that are no questionnaire, and what is said of each of their cells; ``{table}`` names the file."""

from __future__ import annotations

HEAD = "id,kind,points,scale,reverse,required,lowest,highest,text_en,lowest_en,highest_en,left_en,right_en,options_en"
LIKERT = "one,likert,5,S,,,,,How?,little,much,,,"


def rows(*lines: str, head: str = HEAD) -> str:
    """Return a table of these lines."""
    return "\n".join((head, *lines)) + "\n"


def cell(old: str, new: str) -> str:
    """Return the table of one good row with a cell replaced."""
    assert old in LIKERT
    return rows(LIKERT.replace(old, new))


TABLES: dict[str, tuple[str | bytes, tuple[str, ...]]] = {
    # The file
    "empty": ("", ("{table}: its first line must name the columns, with commas or semicolons between them",)),
    "too long": ("x" * (2**20 + 1), ("{table} is too long: it has more than 1024 KiB",)),
    "nothing but text": (
        "Dear all,",
        (
            "{table}: there is no column 'Dear all'; there are id, kind, points, scale, reverse, required, "
            "lowest, highest, longest, pictures, relevant, visits, not_applicable, text_en, lowest_en, highest_en, "
            "left_en, right_en, options_en",
            "{table}: the column 'id' is missing",
            "{table}: the column 'kind' is missing",
            "{table}: a column with texts is missing, such as 'text_en'",
        ),
    ),
    "one column": (
        "text_en\nHow?\n",
        ("{table}: its first line must name the columns, with commas or semicolons between them",),
    ),
    "bars": (
        rows(LIKERT).replace(",", "|"),
        ("{table}: its first line must name the columns, with commas or semicolons between them",),
    ),
    "another encoding": (
        rows(LIKERT).encode().replace(b"How?", b"\x81?"),
        ("{table} is neither UTF-8 nor Windows-1252; save it as CSV UTF-8",),
    ),
    "open quotes": (rows(LIKERT.replace("How?", '"How?')), ("{table} is not CSV: unexpected end of data",)),
    "no rows": (rows(), ("{table} has no items under its columns",)),
    # Columns
    "misspelt column": (
        rows(LIKERT, head=HEAD.replace("reverse", "reversed")),
        ("{table}: there is no column 'reversed'; did you mean 'reverse'?",),
    ),
    "unknown column": (
        rows(LIKERT, head=HEAD.replace("reverse", "colour")),
        (
            "{table}: there is no column 'colour'; there are id, kind, points, scale, reverse, required, "
            "lowest, highest, longest, pictures, relevant, visits, not_applicable, text_en, lowest_en, highest_en, "
            "left_en, right_en, options_en",
        ),
    ),
    "column twice": (
        rows(LIKERT, head=HEAD.replace("reverse", "points")),
        ("{table}: the column 'points' is there twice",),
    ),
    "no ids": (
        rows(LIKERT, head=HEAD.replace("id,", "scale,", 1).replace("points,scale", "points,longest")),
        ("{table}: the column 'id' is missing",),
    ),
    "no texts": (
        rows(LIKERT, head=HEAD.replace("text_en", "pictures")),
        ("{table}: a column with texts is missing, such as 'text_en'",),
    ),
    "words without texts": (
        rows(LIKERT, head=HEAD.replace("left_en", "lowest_it")),
        ("{table}: there is a column 'lowest_it', but no column 'text_it'",),
    ),
    "too many cells": (rows(LIKERT + ",,x"), ("{table}, row 2: it has 16 cells, but there are 14 columns",)),
    # Cells
    "no id": (
        cell("one,", ","),
        ("{table}, row 2, column id: it is empty, but an item of the kind 'likert' needs it",),
    ),
    "bad id": (
        cell("one,", "item 1,"),
        (
            "{table}, row 2, column id: 'item 1' is no name; a name begins with a letter and has letters, "
            "digits, _ and - only",
        ),
    ),
    "id twice": (rows(LIKERT, LIKERT), ("{table}, row 3, column id: 'one' stands in row 2 too",)),
    "no kind": (cell("likert", ""), ("{table}, row 2, column kind: it is empty",)),
    "unknown kind": (
        cell("likert", "stars"),
        ("{table}, row 2, column kind: it must be one of {kinds}, but it is 'stars'",),
    ),
    "points in words": (
        cell(",5,", ",five,"),
        ("{table}, row 2, column points: it must be a whole number, but it is 'five'",),
    ),
    "fraction": (cell(",5,", ",5.0,"), ("{table}, row 2, column points: it must be a whole number, but it is '5.0'",)),
    "one point": (cell(",5,", ",1,"), ("{table}, row 2, column points: it must be from 2 to 11, but it is 1",)),
    "bad scale": (
        cell(",S,", ",my scale,"),
        (
            "{table}, row 2, column scale: 'my scale' is no name; a name begins with a letter and has letters, "
            "digits, _ and - only",
        ),
    ),
    "neither yes nor no": (
        cell(",S,,", ",S,maybe,"),
        ("{table}, row 2, column reverse: it must be yes or no, but it is 'maybe'",),
    ),
    "no text": (
        cell("How?", ""),
        ("{table}, row 2, column text_en: it is empty, but an item of the kind 'likert' needs it",),
    ),
    "no end": (
        cell("little", " "),
        ("{table}, row 2, column lowest_en: it is empty, but an item of the kind 'likert' needs it",),
    ),
    "a cell that the kind has not": (
        cell("much,,,", "much,,,a=A;b=B"),
        ("{table}, row 2, column options_en: an item of the kind 'likert' has none, so the cell must be empty",),
    ),
    "language without a column": (
        rows("one,likert,How?,Come?,a,b", head="id,kind,text_en,text_it,lowest_en,highest_en"),
        (
            "{table}, row 2, column lowest_it: there is no such column, but an item of the kind 'likert' needs it",
            "{table}, row 2, column highest_it: there is no such column, but an item of the kind 'likert' needs it",
        ),
    ),
    "slider that has no length": (
        rows("one,slider,,,,,7,7,How?,,,a,b,"),
        ("{table}, row 2, column lowest: its lowest 7 must be below its highest 7",),
    ),
    "integer without a number": (
        rows("one,integer,,,,,low,,How?,,,,,"),
        ("{table}, row 2, column lowest: it must be a whole number, but it is 'low'",),
    ),
    "one option": (
        rows("one,single,,,,,,,How?,,,,,a=A"),
        ("{table}, row 2, column options_en: it must have at least 2 entries, but it has 1",),
    ),
    "options without ids": (
        rows("one,single,,,,,,,How?,,,,,A;B"),
        ("{table}, row 2, column options_en: it must be like id=word;id=word, each id once, but it is 'A;B'",),
    ),
    "option twice": (
        rows("one,single,,,,,,,How?,,,,,a=A;a=B"),
        ("{table}, row 2, column options_en: it must be like id=word;id=word, each id once, but it is 'a=A;a=B'",),
    ),
    "bad option": (
        rows("one,single,,,,,,,How?,,,,,a b=A;c=C"),
        (
            "{table}, row 2, column options_en: 'a b' is no name; a name begins with a letter and has letters, "
            "digits, _ and - only",
        ),
    ),
    "options that differ": (
        rows("one,single,How?,Come?,a=A;b=B,b=B;a=A", head="id,kind,text_en,text_it,options_en,options_it"),
        ("{table}, row 2, column options_it: its ids must be those of options_en, in the same order",),
    ),
    "scale of different lengths": (
        rows(LIKERT, LIKERT.replace("one", "two").replace("5", "7")),
        ("{table}: items: those of the scale 'S' have different ends, so they cannot be summed",),
    ),
    "scale that cannot be summed": (
        rows("one,integer,,S,,,,,How?,,,,,"),
        ("{table}: items: 'one' is no rating, so it cannot belong to the scale 'S'",),
    ),
    "every bad cell": (
        rows("1,likert,x,S,perhaps,,,,,a,b,,,", "two,stars,,,,,,,?,,,,,"),
        (
            "{table}, row 2, column text_en: it is empty, but an item of the kind 'likert' needs it",
            "{table}, row 2, column reverse: it must be yes or no, but it is 'perhaps'",
            "{table}, row 2, column points: it must be a whole number, but it is 'x'",
            "{table}, row 2, column id: '1' is no name; a name begins with a letter and has letters, digits, _ "
            "and - only",
            "{table}, row 3, column kind: it must be one of {kinds}, but it is 'stars'",
        ),
    ),
}
