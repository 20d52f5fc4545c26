"""Codes of languages: how they are spelt, and which of them mean the same language."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.language_codes import babel_codes, distance, is_right, standard, with_region


@pytest.mark.parametrize(
    ("given", "spelt"),
    [
        ("de", "de"),
        ("DE", "de"),
        ("pt_BR", "pt-BR"),
        ("pt-br", "pt-BR"),
        ("zh-hant-tw", "zh-Hant-TW"),
        ("es_419", "es-419"),
        ("en-GB-x-rp", "en-GB-x-rp"),
    ],
)
def test_a_code_is_spelt_in_one_way(given: str, spelt: str) -> None:
    assert standard(given) == spelt
    assert standard(spelt) == spelt


@pytest.mark.parametrize("code", ["", "d", "de2", "english", "de-", "de--AT", "../en", "en.toml", "de AT", "x" * 5000])
def test_what_is_no_code_is_refused_in_a_short_sentence(code: str) -> None:
    assert not is_right(code)
    with pytest.raises(ValueError, match="is no language code, such as 'de' or 'pt-BR'") as refused:
        standard(code)
    assert len(str(refused.value)) < 120


@pytest.mark.parametrize(
    ("one", "other"),
    [
        *[("no", "nb"), ("zh", "cmn"), ("he", "iw"), ("id", "in"), ("fil", "tl"), ("en", "eng"), ("ar", "arb")],
        *[("pt-BR", "pt_br"), ("zh-TW", "cmn-TW"), ("zh", "zh-cmn"), ("ro", "mo")],
    ],
)
def test_two_codes_of_one_language_mean_the_same(one: str, other: str) -> None:
    assert distance(one, other) == distance(other, one) == 0


@pytest.mark.parametrize(
    ("one", "other"),
    [
        *[("no", "nog"), ("ha", "haw"), ("sm", "smj"), ("zh", "yue"), ("nn", "nb"), ("en", "enm"), ("en", "")],
        *[("pt-BR", "pt-PT"), ("sr-Latn", "sr-Cyrl"), ("en", "de"), ("en", "?")],
    ],
)
def test_two_languages_are_never_the_same(one: str, other: str) -> None:
    assert distance(one, other) is None
    assert distance(other, one) is None


@pytest.mark.parametrize(
    ("wanted", "offered"),
    [
        ("pt", ["pt", "pt-BR", "pt-BR-x-carioca"]),
        ("pt-BR", ["pt-BR", "pt"]),
        ("es-MX", ["es-MX", "es-419", "es"]),
        ("en-AU", ["en-AU", "en-001", "en"]),
        ("zh-CN", ["cmn-CN", "cmn", "cmn-Latn-pinyin"]),
    ],
)
def test_the_nearest_code_is_the_most_exact(wanted: str, offered: list[str]) -> None:
    far = [distance(wanted, code) for code in offered]
    assert None not in far
    assert far == sorted(far, key=lambda each: each or 0)
    assert len(set(far)) == len(far)


def test_every_code_has_one_that_babel_knows_so_that_numbers_have_forms() -> None:
    assert babel_codes("pt-BR-x-carioca")[0] == "pt-BR"
    assert babel_codes("sm") == babel_codes("qps") == ["en"]


@pytest.mark.parametrize(("code", "told"), [("it", "it-IT"), ("no", "nb-NO"), ("pt-PT", "pt-PT"), ("qps", "qps")])
def test_a_robot_that_wants_a_region_gets_the_likely_one(code: str, told: str) -> None:
    assert with_region(code) == told


@given(st.text(max_size=12), st.text(max_size=12))
def test_any_two_texts_can_be_compared(one: str, other: str) -> None:
    assert distance(one, other) == distance(other, one) or not (is_right(one) and is_right(other))
    if is_right(one):
        assert distance(one, standard(one)) == 0
