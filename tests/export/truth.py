"""Check every hint of a data set by what its sentence claims; nothing but the exported tables is read.

The boards, the flips and the counts are rebuilt here, and the sentences are read by the grammar below. To check 300
sessions: ``python -m tests.export.truth 300``.
"""

from __future__ import annotations

import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from kiosk.assistance.policy import NO_GATE, Gate
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import Stage
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.experiment.driver import Driver, at_random, with_memory
from tests.export.conftest import rows_of
from tests.export.visitors import store
from tests.samples import CATALOGUES, mixed, whole

Row = dict[str, str]

TOLD = {
    "tom": (True, True),
    "notom": (False, True),
    "mentalised_unexplained": (False, True),
    "random_explained": (True, True),
    "remind": (True, False),
}
"""What a hint of each condition says: a reason, a place."""

_REASONS = {
    "en": """
        0 0 | Let us look somewhere new. / Here is a pair that you have not met yet. / There is a pair that you have not turned up yet.
        0 0 | There is a pair still waiting to be seen for the first time. / Two cards that belong together are still unseen.
        0 1 | You have seen one @ card once, and the other one not yet. / One @ card has been up once; the other is still unseen.
        0 1 | You have seen one @ card once, but never its partner. / One of the two @ cards has been up once; the other is still unseen.
        0 1 | There are two @ cards: you have seen one of them once, and not the other.
        1 1 | You have seen both @ cards, each of them once. / Both @ cards have been up once already.
        1 1 | You have met the two @ cards once each. / Both @ cards have been up, each of them once.
        + + | You have seen both @ cards.
        0 2 | You have seen one @ card more than once, and the other one never. / One @ card has been up at least twice, the other not at all.
        0 2 | You have turned up the same @ card more than once, but never the other one.
        0 2 | There are two @ cards: you have seen one of them more than once, the other never.
        0 2 | One of the two @ cards has been up at least twice, the other not at all.
        1 2 | You have seen one @ card more than once, and the other one just once. / One @ card has been up at least twice, the other only once.
        1 2 | You have met one @ card more than once, and the other a single time.
        1 2 | There are two @ cards: you have seen one of them more than once, the other just once.
        1 2 | One of the two @ cards has been up at least twice, the other only once.
        2 2 | You have seen both @ cards more than once. / Both @ cards have been up at least twice by now.
        2 2 | You have met each of the two @ cards more than once. / Both @ cards have been up, each of them at least twice.
        o1 m0 | This @ card is new, and its partner has not been seen yet either. / You had not met this @ card before, nor its partner.
        o1 m0 | This @ card is up for the first time, and its partner is still unseen.
        o1 m0 | This is the first @ card that you turn up; you have not seen the other one.
        o? m0 | The other @ card has not been up yet.
        o1 m1 | This @ card is new, but you have seen its partner once.
        o? m1 | You have seen the other @ card once before. / You have already met the partner of this @ card once.
        o? m1 | You have seen the other @ card once. / The other @ card has been up once before.
        o2 m0 | You have seen this @ card before, but never its partner. / This @ card was up before; its partner has not been up yet.
        o2 m0 | You have met this @ card already. Its partner is still unseen. / You have seen this @ card before, but not the other one.
        o2 m0 | This @ card was up before; the other one has not been up yet.
        o2 m1 | You have seen this @ card before, and its partner once. / This @ card was up before, and its partner has been up once.
        o2 m1 | You have met this @ card already, and its partner once. / You have seen this @ card before, and the other one once.
        o2 m1 | This @ card was up before, and the other one has been up once.
        o1 m2 | This @ card is new, but you have seen its partner more than once.
        o? m2 | You have met the other @ card more than once. / The partner of this @ card has been up at least twice.
        o? m2 | You have seen the other @ card more than once. / The other @ card has been up at least twice.
        o2 m2 | You have met this @ card and its partner more than once each. / This @ card and its partner have both been up at least twice.
        o2 m2 | You have seen this @ card before, and the other one more than once.
        o2 m2 | This @ card was up before, and the other one has been up at least twice.
    """,
    "it": """
        0 0 | Proviamo a guardare in un posto nuovo. / Qui c'è una coppia che non hai ancora incontrato. / Due carte uguali non sono ancora uscite.
        0 0 | C'è una coppia ancora tutta da scoprire. / C'è una coppia che non hai ancora visto.
        0 1 | Hai visto una volta una carta con @, l'altra non ancora. / Una delle due carte @ è già uscita una volta, l'altra ancora no.
        0 1 | Di @ ne hai incontrat* un* sol*, e una volta sola. / Una delle due carte con @ è uscita una volta, l'altra non ancora.
        0 1 | Delle due carte con @ ne hai vista una, una volta; l'altra non ancora.
        1 1 | Hai visto tutte e due le carte con @, una volta ciascuna. / Le due carte @ sono già uscite, una volta ciascuna.
        1 1 | * due @ l* hai già incontrat*, una volta ciascun*. / Le due carte con @ sono uscite tutte e due, una volta ciascuna.
        + + | Hai già visto tutte e due le carte con @.
        0 2 | Hai visto più di una volta una carta con @, ma l'altra mai. / Una delle due carte @ è uscita almeno due volte, l'altra mai.
        0 2 | Di @ ne hai incontrat* un* sol*, ma più di una volta. / Una delle due carte con @ è uscita almeno due volte, l'altra non ancora.
        0 2 | Delle due carte con @ ne hai vista una più di una volta, l'altra mai.
        1 2 | Hai visto più di una volta una carta con @, e l'altra una volta sola. / Una delle due carte @ è uscita almeno due volte, l'altra soltanto una.
        1 2 | Un* de* due @ l'hai incontrat* più di una volta, l'altr* una volta sola.
        1 2 | Delle due carte con @ ne hai vista una più di una volta, l'altra una volta sola.
        1 2 | Una delle due carte con @ è uscita almeno due volte, l'altra una volta sola.
        2 2 | Hai visto più di una volta tutte e due le carte con @. / Le due carte @ sono uscite almeno due volte ciascuna.
        2 2 | * due @ l* hai già incontrat* più di una volta ciascun*. / Hai già visto tutte e due le carte con @, ciascuna più di una volta.
        2 2 | Le due carte con @ sono uscite tutte e due, almeno due volte ciascuna.
        o1 m0 | È la prima volta che vedi @, e la carta gemella non è ancora uscita. / Questa carta con @ è nuova, e la sua gemella non l'hai ancora vista.
        o1 m0 | Quest* è * prim* @ che incontri: l'altr* non l'hai ancora vist*. / È la prima carta con @ che giri; l'altra non l'hai ancora vista.
        o? m0 | L'altra carta con @ non è ancora uscita.
        o1 m1 | Questa carta con @ è nuova, ma la sua gemella l'hai già vista una volta.
        o1 m1 | È la prima volta che vedi @, ma una volta hai già incontrato l'altr*.
        o? m1 | L'altra carta @ è già uscita una volta. / L'altra carta con @ l'hai già vista una volta. / L'altra carta con @ è già uscita una volta.
        o2 m0 | Questa carta con @ l'avevi già vista, la sua gemella mai. / Questa carta @ era già uscita, la sua gemella non ancora.
        o2 m0 | Avevi già incontrato @, ma non l'altr*. / Questa carta con @ l'avevi già vista, l'altra non ancora.
        o2 m0 | Questa carta con @ era già uscita, l'altra non ancora.
        o2 m1 | Questa carta con @ l'avevi già vista, e la sua gemella l'hai vista una volta. / Avevi già incontrato @, e una volta anche l'altr*.
        o2 m1 | Questa carta @ era già uscita, e la sua gemella è uscita una volta. / Questa carta con @ era già uscita, e l'altra è uscita una volta.
        o2 m1 | Questa carta con @ l'avevi già vista, e l'altra l'hai vista una volta.
        o1 m2 | Questa carta con @ è nuova, ma la sua gemella l'hai già vista più di una volta.
        o1 m2 | È la prima volta che vedi @, ma hai già incontrato più di una volta l'altr*.
        o? m2 | L'altra carta @ è già uscita almeno due volte. / L'altra carta con @ l'hai già vista più di una volta.
        o? m2 | L'altra carta con @ è già uscita almeno due volte.
        o2 m2 | Questa carta @ e la sua gemella sono uscite almeno due volte ciascuna. / * due @ l* hai incontrat* più di una volta ciascun*.
        o2 m2 | Questa carta con @ l'avevi già vista, e l'altra l'hai vista più di una volta.
        o2 m2 | Questa carta con @ era già uscita, e l'altra è uscita almeno due volte.
    """,
    "es": """
        0 0 | Vamos a mirar en un sitio nuevo. / Aquí hay una pareja que todavía no has visto. / Dos cartas iguales todavía no han salido.
        0 0 | Queda una pareja que aún está por descubrir. / Hay una pareja que todavía no has visto.
        0 1 | Has visto una vez una carta con @; la otra, todavía no. / Una de las dos cartas @ ya ha salido una vez; la otra, aún no.
        0 1 | De * dos @ solo has visto un*, y una sola vez. / Una de las dos cartas con @ ha salido una vez; la otra, todavía no.
        0 1 | De las dos cartas con @ has visto una, una vez; la otra, todavía no.
        1 1 | Has visto las dos cartas con @, una vez cada una. / Las dos cartas @ ya han salido, una vez cada una.
        1 1 | * dos @ ya te han salido, una vez cada un*. / Las dos cartas con @ ya han salido, una vez cada una.
        + + | Ya has visto las dos cartas con @.
        0 2 | Has visto más de una vez una carta con @, pero la otra nunca. / Una de las dos cartas @ ha salido al menos dos veces; la otra, ninguna.
        0 2 | De * dos @ solo has visto un*, pero más de una vez. / Una de las dos cartas con @ ha salido al menos dos veces; la otra, todavía no.
        0 2 | De las dos cartas con @ has visto una más de una vez; la otra, nunca.
        1 2 | Has visto más de una vez una carta con @, y la otra una sola vez. / Una de las dos cartas @ ha salido al menos dos veces; la otra, solo una.
        1 2 | Un* de * dos @ ya te ha salido más de una vez; * otr*, una sola.
        1 2 | De las dos cartas con @ has visto una más de una vez; la otra, una sola vez.
        1 2 | Una de las dos cartas con @ ha salido al menos dos veces; la otra, una sola vez.
        2 2 | Has visto más de una vez las dos cartas con @. / Las dos cartas @ han salido al menos dos veces cada una.
        2 2 | * dos @ ya te han salido más de una vez cada un*. / Ya has visto las dos cartas con @, más de una vez cada una.
        2 2 | Las dos cartas con @ ya han salido, al menos dos veces cada una.
        o1 m0 | Es la primera vez que ves @, y su pareja todavía no ha salido. / Esta carta con @ es nueva, y su pareja aún no la has visto.
        o1 m0 | Est* es * primer* @ que te sale: * otr* todavía no l* has visto. / Es la primera carta con @ que levantas; la otra todavía no la has visto.
        o? m0 | La otra carta con @ todavía no ha salido.
        o1 m1 | Esta carta con @ es nueva, pero su pareja ya la has visto una vez.
        o1 m1 | Es la primera vez que ves @, pero ya te ha salido una vez * otr*.
        o? m1 | La otra carta @ ya ha salido una vez. / La otra carta con @ ya la has visto una vez. / La otra carta con @ ya ha salido una vez.
        o2 m0 | Esta carta con @ ya la habías visto, pero su pareja nunca. / Esta carta @ ya había salido; su pareja, todavía no.
        o2 m0 | Ya te había salido @, pero no * otr*. / Esta carta con @ ya la habías visto; la otra, todavía no.
        o2 m0 | Esta carta con @ ya había salido; la otra, todavía no.
        o2 m1 | Esta carta con @ ya la habías visto, y su pareja la has visto una vez. / Ya te había salido @, y una vez también * otr*.
        o2 m1 | Esta carta @ ya había salido, y su pareja ha salido una vez. / Esta carta con @ ya había salido, y la otra ha salido una vez.
        o2 m1 | Esta carta con @ ya la habías visto, y la otra la has visto una vez.
        o1 m2 | Esta carta con @ es nueva, pero su pareja ya la has visto más de una vez.
        o1 m2 | Es la primera vez que ves @, pero ya te ha salido más de una vez * otr*.
        o? m2 | La otra carta @ ya ha salido al menos dos veces. / La otra carta con @ ya la has visto más de una vez.
        o? m2 | La otra carta con @ ya ha salido al menos dos veces.
        o2 m2 | Esta carta @ y su pareja han salido al menos dos veces cada una. / * dos @ te han salido más de una vez cada un*.
        o2 m2 | Esta carta con @ ya la habías visto, y la otra la has visto más de una vez.
        o2 m2 | Esta carta con @ ya había salido, y la otra ha salido al menos dos veces.
    """,
}  # fmt: skip
"""What each reason claims: how often the two cards were up in either order, or the open card (o) and its mate (m).

2 is twice or more, + once or more, ? is left open. @ is the picture's name with its article, * an ending or an article.
"""

_WHERE = {
    "en": (
        r"(?:Try (?:a|the) card in|Have a look (?:in|at)|I would turn (?:a|the) card in|The partner is in"
        r"|Look for its partner in|You will find the match in)",
        "row",
        "column",
    ),
    "it": (
        r"(?:Prova una carta della|Prova la carta in|Dai un'occhiata alla(?: carta in)?|Io girerei una carta nella"
        r"|Io girerei la carta in|La carta gemella è (?:nella|in)|Cerca l'altra (?:nella|in)"
        r"|Quella uguale la trovi (?:nella|in))",
        "riga",
        "colonna",
    ),
    "es": (
        r"(?:Prueba (?:una|la) carta de la|Echa un vistazo a la|Yo levantaría una carta en la"
        r"|Yo levantaría la carta de la|Su pareja está en la|Busca la otra en la|La que falta la encuentras en la)",
        "fila",
        "columna",
    ),
}

_NAMES = {
    "it": "bear orso orsi, butterfly farfalla farfalle, cat gatto gatti, duck anatra anatre, elephant elefante elefanti, "
    "fish pesce pesci, frog rana rane, hedgehog riccio ricci, ladybird coccinella coccinelle, owl gufo gufi, "
    "rabbit coniglio conigli, turtle tartaruga tartarughe",
    "es": "bear oso osos, butterfly mariposa mariposas, cat gato gatos, duck pato patos, elephant elefante elefantes, "
    "fish pez peces, frog rana ranas, hedgehog erizo erizos, ladybird mariquita mariquitas, owl búho búhos, "
    "rabbit conejo conejos, turtle tortuga tortugas",
}
_PICTURES = {
    language: {n: w.split()[0] for w in names.split(", ") for n in w.split()[1:]} for language, names in _NAMES.items()
}
_PLACE = {
    language: re.compile(rf"{lead} (?:{row} (?P<row>\d+))?(?:, )?(?:{column} (?P<column>\d+))?\.")
    for language, (lead, row, column) in _WHERE.items()
}


def _grammar(text: str) -> list[tuple[re.Pattern[str], str]]:
    rules = []
    for line in filter(None, map(str.strip, text.splitlines())):
        claim, _, wordings = line.partition(" | ")
        for wording in wordings.split(" / "):
            pattern = re.escape(wording).replace("@", "(?P<card>.+?)").replace(r"\*", r"\w*")
            rules.append((re.compile(pattern), claim))
    return rules


_RULES = {language: _grammar(text) for language, text in _REASONS.items()}


def _holds(claimed: str, count: int) -> bool:
    return {"?": True, "+": count >= 1, "2": count >= 2}.get(claimed, str(count) == claimed)


def _is_true(claim: str, *, second: bool, other: int, target: int) -> bool:
    one, two = claim.split()
    if one.startswith("o"):
        return second and _holds(one[1:], other) and _holds(two[1:], target)
    low, high = sorted((other, target))
    return _holds(one, low) and _holds(two, high)


def read_hint(sentence: str, language: str) -> tuple[list[tuple[str, str]], dict[str, int]] | None:
    """Read a sentence: every claim that it may make with the picture it names, and its place; None if it is unread."""
    place = _PLACE[language].search(sentence)
    said = sentence[: place.start()].rstrip() if place else sentence
    if place and place.end() != len(sentence):
        return None
    where = {name: int(number) for name, number in place.groupdict().items() if number} if place else {}
    if place and not where:
        return None
    claims = []
    for pattern, claim in _RULES[language] if said else ():
        read = pattern.fullmatch(said)
        if read:
            word = (read.groupdict().get("card") or "").split("'")[-1].split(" ")[-1]
            claims.append((claim, _PICTURES.get(language, {}).get(word, word)))
    return None if said and not claims else (claims, where)


@dataclass(frozen=True)
class _Around:
    """What the tables say of the moment of a hint; places are row and column from 1."""

    number: int
    flips: Mapping[int, tuple[int, int]]
    target: tuple[int, int]
    mate: tuple[int, int]
    seen: tuple[int, int]
    place: dict[str, int]
    explained: bool
    picture: str
    language: str

    @property
    def second(self) -> bool:
        """Whether the hint is for the second card of a move."""
        return self.number % 2 == 0


class Checker:
    """The boards and flips of a data set, and what is wrong with its hints."""

    def __init__(self, folder: Path) -> None:
        """Read the tables."""
        self.people = {row["participant_id"]: row for row in rows_of(folder, "participants")}
        self.hints = rows_of(folder, "hints")
        self._cards: dict[tuple[str, str], dict[tuple[int, int], str]] = defaultdict(dict)
        for row in rows_of(folder, "cards"):
            self._cards[row["participant_id"], row["board"]][int(row["row"]), int(row["column"])] = row["picture"]
        self._flips: dict[tuple[str, str], dict[int, tuple[int, int]]] = defaultdict(dict)
        for row in rows_of(folder, "flips"):
            place = int(row["row"]), int(row["column"])
            self._flips[row["participant_id"], row["board"]][int(row["flip"])] = place

    def faults(self, hint: Mapping[str, str]) -> list[str]:
        """Say what is not true of one hint, by the board and the flips before it."""
        return [*self._of_columns(hint), *self._of_sentence(hint)]

    def _around(self, hint: Mapping[str, str]) -> _Around:
        key, number = (hint["participant_id"], hint["board"]), int(hint["flip"])
        cards, flips, person = self._cards[key], self._flips[key], self.people[hint["participant_id"]]
        target = int(hint["target_row"]), int(hint["target_column"])
        mate = next(place for place, picture in cards.items() if picture == cards[target] and place != target)
        before = Counter(place for at, place in flips.items() if at < number)
        explained, located = TOLD[person["condition"]]
        wanted = {"sug_row": ("row",), "sug_col": ("column",), "sug_card": ("row", "column")}[hint["action"]]
        place = {name: at for name, at in zip(("row", "column"), target, strict=True) if located and name in wanted}
        names = cards[target], person["language"]
        return _Around(number, flips, target, mate, (before[target], before[mate]), place, explained, *names)

    def _of_columns(self, hint: Mapping[str, str]) -> Iterator[str]:
        around = self._around(hint)
        flip, place = around.flips.get(around.number), around.place
        if (hint["seen"], hint["mate_seen"]) != tuple(map(str, around.seen)):
            yield "the counts are others"
        if hint["picture"] != around.picture:
            yield "the picture is another"
        if hint["move_card"] != ("second" if around.second else "first"):
            yield "it is the other card of the move"
        if around.second and around.flips[around.number - 1] != around.mate:
            yield "the target is not the mate of the open card"
        if {name: int(hint[f"told_{name}"]) for name in ("row", "column") if hint[f"told_{name}"]} != place:
            yield "the columns name another place"
        if flip is not None:
            went = all(flip[name == "column"] == at for name, at in place.items())
            went = went if place else flip in (around.target, around.mate)
            if hint["followed"] != str(went).lower():
                yield "it was followed, or was not"

    def _of_sentence(self, hint: Mapping[str, str]) -> Iterator[str]:
        around = self._around(hint)
        read = read_hint(hint["sentence"], around.language)
        if read is None:
            yield "the sentence is unread"
            return
        claims, where = read
        if where != around.place:
            yield "the sentence names another place"
        if bool(claims) is not around.explained:
            yield "a reason is given in spite of the condition, or lacks"
        target, other = around.seen
        if claims and not any(
            _is_true(claim, second=around.second, other=other, target=target) and named in ("", around.picture)
            for claim, named in claims
        ):
            yield "the reason is false"


def played(folder: Path, sessions: int) -> Path:
    """Play sessions in every condition that helps and in every language, and export them."""
    visitors = []
    for seed in range(1, sessions + 1):
        condition = Condition([*TOLD][seed % len(TOLD)])
        catalogue = CATALOGUES[("en", "it", "es")[seed // len(TOLD) % 3]]
        settings = {"conditions": {"remind": {"location": False}}}
        plan = replace(
            whole(condition, mixed(seed % 11, NO_GATE if seed % 2 else Gate()), **settings), catalogue=catalogue
        )
        driver = Driver(plan, seed)
        driver.to(Stage.GAME)
        driver.play(at_random(seed) if seed % 3 else with_memory(seed))
        driver.to(Stage.OVER)
        visitors.append((driver, seed))
    store(folder / "data", visitors)
    export_dataset(folder / "data", folder / "set", PsychDs)
    return folder / "set"


def main(sessions: int) -> int:
    """Check so many sessions, and print what was found."""
    with TemporaryDirectory() as folder:
        checker = Checker(played(Path(folder), sessions))
    found = [(hint["sentence"], fault) for hint in checker.hints for fault in checker.faults(hint)]
    print(f"{len(checker.people)} sessions, {len(checker.hints)} hints, {len(found)} faults")
    for sentence, fault in found[:20]:
        print(f"{fault}: {sentence}")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
