"""Italian and Spanish agree with every card: articles and genders, written out here by hand a second time."""

from __future__ import annotations

import re

import pytest

from kiosk.assistance.hint_sentences import reasoning
from tests.assistance.test_languages import CARDS, catalogue, hints

ITALIAN = {
    "apple": ("la mela", "della mela", "questa mela", "mele"),
    "banana": ("la banana", "della banana", "questa banana", "banane"),
    "bear": ("l'orso", "dell'orso", "quest'orso", "orsi"),
    "butterfly": ("la farfalla", "della farfalla", "questa farfalla", "farfalle"),
    "cat": ("il gatto", "del gatto", "questo gatto", "gatti"),
    "cherry": ("la ciliegia", "della ciliegia", "questa ciliegia", "ciliegie"),
    "duck": ("l'anatra", "dell'anatra", "quest'anatra", "anatre"),
    "elephant": ("l'elefante", "dell'elefante", "quest'elefante", "elefanti"),
    "fish": ("il pesce", "del pesce", "questo pesce", "pesci"),
    "frog": ("la rana", "della rana", "questa rana", "rane"),
    "grapes": ("il grappolo d'uva", "del grappolo d'uva", "questo grappolo d'uva", "grappoli d'uva"),
    "hedgehog": ("il riccio", "del riccio", "questo riccio", "ricci"),
    "ladybird": ("la coccinella", "della coccinella", "questa coccinella", "coccinelle"),
    "owl": ("il gufo", "del gufo", "questo gufo", "gufi"),
    "pear": ("la pera", "della pera", "questa pera", "pere"),
    "rabbit": ("il coniglio", "del coniglio", "questo coniglio", "conigli"),
    "strawberry": ("la fragola", "della fragola", "questa fragola", "fragole"),
    "turtle": ("la tartaruga", "della tartaruga", "questa tartaruga", "tartarughe"),
}
SPANISH = {
    "apple": ("la manzana", "de la manzana", "esta manzana", "manzanas"),
    "banana": ("el plátano", "del plátano", "este plátano", "plátanos"),
    "bear": ("el oso", "del oso", "este oso", "osos"),
    "butterfly": ("la mariposa", "de la mariposa", "esta mariposa", "mariposas"),
    "cat": ("el gato", "del gato", "este gato", "gatos"),
    "cherry": ("la cereza", "de la cereza", "esta cereza", "cerezas"),
    "duck": ("el pato", "del pato", "este pato", "patos"),
    "elephant": ("el elefante", "del elefante", "este elefante", "elefantes"),
    "fish": ("el pez", "del pez", "este pez", "peces"),
    "frog": ("la rana", "de la rana", "esta rana", "ranas"),
    "grapes": ("el racimo de uvas", "del racimo de uvas", "este racimo de uvas", "racimos de uvas"),
    "hedgehog": ("el erizo", "del erizo", "este erizo", "erizos"),
    "ladybird": ("la mariquita", "de la mariquita", "esta mariquita", "mariquitas"),
    "owl": ("el búho", "del búho", "este búho", "búhos"),
    "pear": ("la pera", "de la pera", "esta pera", "peras"),
    "rabbit": ("el conejo", "del conejo", "este conejo", "conejos"),
    "strawberry": ("la fresa", "de la fresa", "esta fresa", "fresas"),
    "turtle": ("la tortuga", "de la tortuga", "esta tortuga", "tortugas"),
}
FEMININE = {
    "it": {"apple", "banana", "butterfly", "cherry", "duck", "frog", "ladybird", "pear", "strawberry", "turtle"},
    "es": {"apple", "butterfly", "cherry", "frog", "ladybird", "pear", "strawberry", "turtle"},
}


@pytest.mark.parametrize(
    ("language", "table", "forms", "gender"),
    [
        ("it", ITALIAN, ("il", "del", "questo", "plurale"), "genere"),
        ("es", SPANISH, ("el", "del", "este", "plural"), "genero"),
    ],
)
def test_every_card_has_its_article_and_gender(
    language: str, table: dict[str, tuple[str, ...]], forms: tuple[str, ...], gender: str
) -> None:
    assert set(table) == set(CARDS)
    for name, expected in table.items():
        card = catalogue(language).card(name)
        assert tuple(card[f"card-{form}"] for form in forms) == expected
        assert card[f"card-{gender}"] == ("f" if name in FEMININE[language] else "m"), name
        assert expected[0].removeprefix("l'").split(" ", 1)[-1] == card["card"]


BEFORE_A_CARD = {
    "it": {"f": "il|un|questo|primo|i due|uno dei due", "m": "la|una|questa|prima|le due|una delle due"},
    "es": {"f": "el|un|este|primer|los dos|uno de los dos", "m": "la|una|esta|primera|las dos|una de las dos"},
}
"""What may not stand before a card of this gender."""
ANYWHERE = {"it": r"l'altro\b|ciascuno|\bprimo\b|\bli hai", "es": r"\bel otro|cada uno|\bprimer\b|solo has visto uno"}
"""What may not be said at all of a feminine card; of a masculine one, "carta" makes the opposite possible."""


@pytest.mark.parametrize("language", ["it", "es"])
@pytest.mark.parametrize("name", CARDS)
def test_whatever_is_said_of_a_card_agrees_with_it(language: str, name: str) -> None:
    card = catalogue(language).card(name)
    gender = "f" if name in FEMININE[language] else "m"
    names = f"{card['card']}|{card['card-plurale' if language == 'it' else 'card-plural']}"
    disagreeing = rf"\b({BEFORE_A_CARD[language][gender]}) ({names})\b"
    for hint in hints(name):
        for sentence in catalogue(language).wordings(reasoning(hint), **card):
            assert not re.search(disagreeing, sentence, re.IGNORECASE), sentence
            assert gender == "m" or not re.search(ANYWHERE[language], sentence), sentence
