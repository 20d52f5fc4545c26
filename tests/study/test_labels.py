"""Which names are one, and which texts are taken for something else, by the programs that read a data set."""

from __future__ import annotations

import pytest

from kiosk.experiment.labels import FORMULA, MISSING, NUMBER, TRUTH, alike, fold_name, is_reserved, read_as

COMPOSED, DECOMPOSED = "caf\N{LATIN SMALL LETTER E WITH ACUTE}", "cafe\N{COMBINING ACUTE ACCENT}"


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("flips", "Flips"),
        ("form-a", "form_a"),
        ("About-You", "about_you"),
        (COMPOSED, DECOMPOSED),
        (COMPOSED.upper(), DECOMPOSED),
        ("straße", "STRASSE"),
        ("cat", "cat."),
        ("cat", "cat . "),
        ("\N{FULLWIDTH LATIN CAPITAL LETTER A}", "a"),
        ("\N{GREEK SMALL LETTER FINAL SIGMA}", "\N{GREEK CAPITAL LETTER SIGMA}"),
    ],
)
def test_names_that_are_one_for_readers_fold_to_one(one: str, other: str) -> None:
    assert fold_name(one) == fold_name(other)
    assert list(alike([one, "else", other])) == [(one, other)]


@pytest.mark.parametrize(("one", "other"), [("form-a", "forma"), ("q1", "q2"), ("cafe", COMPOSED), (".a", "a")])
def test_other_names_do_not(one: str, other: str) -> None:
    assert fold_name(one) != fold_name(other)
    assert list(alike([one, other, one])) == []


@pytest.mark.parametrize("name", ["con", "NUL", "Aux", "prn", "com1", "LPT9", "con.toml", "aux. "])
def test_the_names_of_devices_are_reserved(name: str) -> None:
    assert is_reserved(name)


@pytest.mark.parametrize("name", ["contact", "com", "nul1", "my-con", "lpt"])
def test_names_that_only_look_like_devices_are_not(name: str) -> None:
    assert not is_reserved(name)


FORMULAS = ["=1+1", "+1+1", "-1+1", "-5", "@SUM(A1)", '=HYPERLINK("http://example.org")', '"=1+1"', " =1+1"]
FORMULAS += [f"{before}=1" for before in "\t\r\n\0\u00a0\u200b\ufeff"]
FORMULAS += [f"{sign}1" for sign in "\uff1d\uff0b\uff0d\uff20\ufe62\ufe63\ufe66\ufe6b\u2212"]
NUMBERS = ["1E-0001", "1E-1", "1e5", "1D5", "1E5", ".5E3", "0x1F", "007", "0001", "1.10", "0.5", "0.0", "1,5"]
NUMBERS += ["1.234.567", "1'000", "5%", "$5", "(5)", "1 1/2", " 5", "5 ", "\uff13", "\u0663", "1234567890123456"]
NUMBERS += ["inf", "Infinity", "INF", "MAR1", "MAR-1", "1-MAR", "3 March 2024", "5 Mai", "M\u00e4rz 3", "d\u00e9c. 24"]
NUMBERS += ["SEPT2", "2024-05-01", "1/2", "1.2.", "2024\u5e745\u67081\u65e5", "12:30", "5 pm", "5:30 AM"]
MISREAD = {
    FORMULA: FORMULAS,
    NUMBER: NUMBERS,
    TRUTH: ["TRUE", "true", "False", "T", "F", "WAHR", "Falsch", "VRAI", "vero", "VERDADERO"],
    MISSING: ["NA", "N/A", "n/a", "NaN", "nan", "null", "NULL", "None", "<NA>", "#N/A", " ", "\u00a0"],
}
TEXTS = ["", "a", "none", "mar", "may", "march on", "P0001", "A-P0001", "1E-P0001", "MAR-P0001", "r0001", "E5", "A1"]
TEXTS += ["session-0001", "3 cats", "abc123-dirty", "deadbeef", "0.1.0", "0.12.3", "2.0.1", "x=1", "a@b", "Na", "t"]
TEXTS += ["2024-05-01T10:00:00.000+00:00", "second 3", "'quoted'", "about-you=1", "{}", "f", "yes", "no", "a, b; c"]


def test_a_text_that_a_reader_takes_for_something_else_is_known() -> None:
    kinds = {text: kind for kind, texts in MISREAD.items() for text in texts}
    assert {text: read_as(text) for text in kinds} == kinds


def test_other_texts_stay_texts() -> None:
    assert [text for text in TEXTS if read_as(text) is not None] == []


@pytest.mark.parametrize("text", ["0", "1", "42", "123456789012345"])
def test_plain_whole_numbers_come_out_as_they_went_in(text: str) -> None:
    assert read_as(text) is None
