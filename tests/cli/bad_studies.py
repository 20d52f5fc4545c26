"""Study files that cannot be run, with the files that they name, and every sentence that is to be said of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import reduce
from pathlib import Path

from kiosk.config import ASSETS, STAGES, Settings
from kiosk.experiment.condition import CONDITIONS
from kiosk.experiment.labels import MISSING, NUMBER, TRUTH
from kiosk.experiment.questionnaire import KINDS
from kiosk.study.names import ONE_NAME

KNOWN = {
    "{assets}": str(ASSETS),
    "{sections}": ", ".join(Settings.model_fields),
    "{stages}": ", ".join(STAGES),
    "{conditions}": ", ".join(condition.name for condition in CONDITIONS),
    "{kinds}": ", ".join(map(repr, KINDS)),
}
"""What sentences list of what there is."""


@dataclass(frozen=True)
class Bad:
    """A study file, what is said of it, and the files beside it by their names.

    In what is said, ``{study}`` is the file and ``{here}`` its folder; for the rest see KNOWN.
    """

    study: str | bytes
    says: tuple[str, ...]
    beside: dict[str, str] = field(default_factory=dict)

    def write(self, folder: Path) -> Path:
        """Write all of it; the study file."""
        for name, content in self.beside.items():
            file = folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(content, "utf-8")
        study = folder / "study.toml"
        study.write_bytes(self.study if isinstance(self.study, bytes) else self.study.encode())
        return study

    def sentences(self, study: Path) -> list[str]:
        """Return what is said of it where it lies."""
        places = {"{study}": f"the study file {study}", "{here}": str(study.parent), **KNOWN}
        return [reduce(lambda text, place: text.replace(*place), places.items(), each) for each in self.says]


def asset(name: str) -> str:
    """Return the text of a shipped file."""
    return (ASSETS / name).read_text("utf-8")


QUESTIONS = """
id = "own"
version = "1"
note = "ours"
[[items]]
id = "one"
kind = "likert"
text = { en = "How?", it = "Come?", es = "¿Cómo?" }
lowest = { en = "little", it = "poco", es = "poco" }
highest = { en = "much", it = "molto", es = "mucho" }
"""
OWN = 'questionnaires = ["own.toml"]'
"""What a study file says to ask these questions."""

HEAD_OF_QUESTIONS, _, _ = QUESTIONS.partition("[[items]]")
ITEM = '[[items]]\nid = "i{}"\nkind = "text"\ntext = {{ en = "?" }}\n'

SHEETS = {f"sheets/{language}.toml": asset(f"consent/study/{language}.toml") for language in ("en", "it", "es")}
TOLD = '[consent]\ntext = "sheets"'
SENTENCES = {f"de/{file.name}": file.read_text("utf-8") for file in (ASSETS / "sentences" / "en").glob("*.ftl")}


UNTRANSLATED = (
    "there is no information sheet for the language 'de' in {assets}/consent/study",
    "the questionnaire {assets}/questionnaires/about-you.toml lacks words in 'de' for age, gender, robots",
    "the questionnaire {here}/own.toml lacks words in 'de' for one",
)
"""What else is said where a study is to be in German."""


def asked(*changes: tuple[str, str]) -> dict[str, str]:
    """Return the questionnaire with some of it replaced."""
    text = QUESTIONS
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return {"own.toml": text}


def told(language: str, old: str, new: str) -> dict[str, str]:
    """Return the information sheets with something in one language replaced."""
    name = f"sheets/{language}.toml"
    assert old in SHEETS[name]
    return SHEETS | {name: SHEETS[name].replace(old, new)}


def more_asked(purpose: str) -> str:
    """Return the end of a sheet's consent with one more purpose."""
    return f'[[consent.purposes]]\nid = "{purpose}"\ntext = "Yes."\n\n[debrief]'


STUDIES: dict[str, Bad] = {
    # The file itself
    "no toml": Bad(
        "title = A game",
        (
            "{study} is not TOML: this is no value; text stands in quotes, and true and false are written small "
            "(at line 1, column 9)",
        ),
    ),
    "half a table": Bad(
        "[game", ("{study} is not TOML: Expected ']' at the end of a table declaration (at end of document)",)
    ),
    "a key twice": Bad(
        "[game]\nrows = 4\nrows = 4", ("{study} is not TOML: a key is there twice (at end of document)",)
    ),
    "not utf-8": Bad(b"title = '\xff'", ("{study} is not UTF-8; save it with that encoding",)),
    # Keys and values
    "empty title": Bad('title = ""', ("{study}: title must not be empty",)),
    "text for a number": Bad('[game]\nrows = "four"', ("{study}: game.rows must be a whole number, but it is 'four'",)),
    "fraction for a whole number": Bad(
        "[game]\nrows = 4.0", ("{study}: game.rows must be a whole number, but it is 4.0",)
    ),
    "no rows": Bad("[game]\nrows = 0", ("{study}: game.rows must be from 1 to 12, but it is 0",)),
    "number for text": Bad("title = 5", ("{study}: title must be text in quotes, but it is 5",)),
    "number for yes": Bad("[voice]\nenabled = 1", ("{study}: voice.enabled must be true or false, but it is 1",)),
    "misspelt key": Bad("[game]\nrow = 4", ("{study}: game: there is no key 'row'; did you mean 'rows'?",)),
    "misspelt section": Bad("[tining]\nmood = 1", ("{study}: there is no key 'tining'; did you mean 'timing'?",)),
    "foreign key": Bad(
        "colour = 'red'",
        ("{study}: there is no key 'colour'; there are {sections}",),
    ),
    "section as a number": Bad("game = 4", ("{study}: game must be a table with keys of its own, but it is 4",)),
    "too fast a voice": Bad(
        "[voice]\nrate = 301", ("{study}: voice.rate must be from 80 to 300 words per minute, but it is 301",)
    ),
    "no number": Bad("[voice]\nvolume = nan", ("{study}: voice.volume must be from 0 to 1, but it is nan",)),
    "huge text": Bad(
        "[screen]\ntext_size = inf", ("{study}: screen.text_size must be from 0.5 to 1.3, but it is inf",)
    ),
    "number of very many digits": Bad(
        f"[timing]\nmood_ms = {'9' * 5000}",
        ("{study}: timing.mood_ms must be from 1 to 3600000 ms, but it is 999999999999...",),
    ),
    "number of very many digits and a fault after it": Bad(
        f"[timing]\nmood_ms = {'9' * 5000}\nmood_ms = 1",
        ("{study} is not TOML: a key is there twice (at end of document)",),
    ),
    "very long number in hexadecimal": Bad(
        f"[game]\nrows = 0x{'f' * 5000}",
        ("{study}: game.rows must be from 1 to 12, but it is 0xffffffffff...",),
    ),
    "very long number in a list": Bad(
        f"[robot]\nboard_size = [{'9' * 5000}, 1.0]",
        ("{study}: robot.board_size, number 1 must be from 0.01 to 10 m, but it is 999999999999...",),
    ),
    "huge quotas": Bad(
        "[randomisation]\ntarget_n = { tom = 1000000000, notom = 28 }",
        ("{study}: randomisation.target_n.tom must be from 1 to 10000, but it is 1000000000",),
    ),
    "huge time": Bad(
        "[idle_ms]\ngame = 99999999999999999999",
        ("{study}: idle_ms.game must be from 1 to 3600000 ms, but it is 99999999999999999999",),
    ),
    "board nowhere": Bad(
        "[robot]\nboard_middle = [inf, 0, nan]",
        (
            "{study}: robot.board_middle, number 1 must be from -10 to 10 m, but it is inf",
            "{study}: robot.board_middle, number 3 must be from -10 to 10 m, but it is nan",
        ),
    ),
    "long title": Bad(f"title = '{'x' * 501}'", ("{study}: title must have at most 500 characters",)),
    "long file": Bad(f"title = '{'x' * 2**20}'", ("{study} is too long: it has more than 1024 KiB",)),
    "key of very many parts": Bad(
        f"title{'.a' * 300_000} = 1", ("{study} has too many dots to be read: line 1 has 300000",)
    ),
    "brackets in brackets": Bad(
        f"title = {'[' * 10_000}", ("{study} is not TOML: brackets stand in brackets too often",)
    ),
    "very many languages": Bad(
        f"languages = [{', '.join(repr(f'l{n}') for n in range(51))}]",
        ("{study}: languages must have at most 50 entries, but it has 51",),
    ),
    "unknown rule": Bad(
        "[assistance]\ntarget_rule = 'random'",
        ("{study}: assistance.target_rule must be 'most_flipped' or 'most_recent', but it is 'random'",),
    ),
    "too large a step": Bad("[assistance]\nstep = 2", ("{study}: assistance.step must be from 0 to 1, but it is 2",)),
    "no list": Bad("languages = 'en'", ("{study}: languages must be a list in square brackets, but it is 'en'",)),
    "empty list": Bad("languages = []", ("{study}: languages must have at least 1 entry, but it has 0",)),
    "list of numbers": Bad("languages = ['en', 5]", ("{study}: language 2 must be text in quotes, but it is 5",)),
    "negative seed": Bad(
        "[randomisation]\nseed = -1",
        ("{study}: randomisation.seed must be from 0 to 9223372036854775807, but it is -1",),
    ),
    "quotas as a number": Bad(
        "[randomisation]\ntarget_n = 28", ("{study}: randomisation.target_n must be a table in braces, but it is 28",)
    ),
    "no quota": Bad(
        "[randomisation]\ntarget_n = { tom = 0, notom = 28 }",
        ("{study}: randomisation.target_n.tom must be from 1 to 10000, but it is 0",),
    ),
    "unknown robot": Bad(
        "[robot]\nkind = 'pepper'",
        ("{study}: robot.kind must be 'none', 'furhat' or 'furhat-realtime', but it is 'pepper'",),
    ),
    "no host": Bad("[robot]\nkind = 'furhat'\nhost = ''", ("{study}: robot.host must not be empty",)),
    "impossible port": Bad("[robot]\nport = 70000", ("{study}: robot.port must be from 1 to 65535, but it is 70000",)),
    "axes": Bad(
        "[robot]\naxes = 'x y'", ("{study}: robot.axes: 'x y' does not name x, y and z once each, such as 'x -z y'",)
    ),
    "a length too few": Bad(
        "[robot]\nboard_size = [0.4]", ("{study}: robot.board_size must have at least 2 entries, but it has 1",)
    ),
    "a place in words": Bad(
        "[robot]\nboard_middle = ['left', 0, 1]",
        ("{study}: robot.board_middle, number 1 must be a number, but it is 'left'",),
    ),
    "key without a modifier": Bad(
        "[shortcuts]\npanel = 'p'",
        ("{study}: shortcuts.panel: 'p' is no shortcut, such as 'Ctrl+Shift+P', and no function key",),
    ),
    "misspelt shortcut": Bad(
        "[shortcuts]\nabort = 'Ctrl+Shfit+E'",
        ("{study}: shortcuts.abort: 'Ctrl+Shfit+E' is no shortcut, such as 'Ctrl+Shift+P', and no function key",),
    ),
    "key twice": Bad(
        "[shortcuts]\nmute = 'Shift+Ctrl+P'", ("{study}: shortcuts: 'Shift+Ctrl+P' stands for 'panel' and for 'mute'",)
    ),
    "bare PIN": Bad(
        "[experimenter]\npin_hash = '1234'",
        ("{study}: experimenter.pin_hash: this is no hashed PIN, such as 'recollect study set-pin' prints",),
    ),
    "everything at once": Bad(
        "title = 5\n[game]\nrows = 0\n[voice]\nloud = 1",
        (
            "{study}: title must be text in quotes, but it is 5",
            "{study}: game.rows must be from 1 to 12, but it is 0",
            "{study}: voice: there is no key 'loud'; did you mean 'sounds'?",
        ),
    ),
    # What it names
    "unknown language": Bad(
        "languages = ['en', 'de']\nquestionnaires = ['own.toml']",
        (
            "{study}: languages: there is no language 'de' (shipped are en, es, it), and nothing at {here}/de",
            *UNTRANSLATED,
        ),
        asked(),
    ),
    "language twice": Bad("languages = ['en', 'en']", ("{study}: languages: 'en' stands twice",)),
    "sentences that lack one": Bad(
        "languages = ['en', 'de']\nquestionnaires = ['own.toml']",
        ("the sentences in {here}/de lack attract-title", *UNTRANSLATED),
        asked()
        | SENTENCES
        | {"de/screens.ftl": asset("sentences/en/screens.ftl").replace("attract-title", "attract-titel")},
    ),
    "sentences that are none": Bad(
        "languages = ['en', 'de']\nquestionnaires = ['own.toml']",
        ("{here}/de/hints.ftl, line 1, is not well-formed near: = what", *UNTRANSLATED),
        asked() | SENTENCES | {"de/hints.ftl": "= what"},
    ),
    "unknown stage": Bad(
        "stages = ['game', 'quiz']",
        ("{study}: stages: there is no stage 'quiz'; there are {stages}",),
    ),
    "stages without a game": Bad(
        "stages = ['about', 'thanks']", ("{study}: stages: without the stage 'game' there is nothing to study",)
    ),
    "stages out of order": Bad("stages = ['game', 'consent']", ("{study}: stages: 'consent' must come before 'game'",)),
    "stage twice": Bad("stages = ['game', 'game']", ("{study}: stages: 'game' stands twice",)),
    "unknown condition": Bad(
        "[assistance]\ncondition = 'tomm'",
        ("{study}: assistance.condition: there is no condition 'tomm'; there are {conditions}",),
    ),
    "unknown policy": Bad(
        "[assistance]\npolicy = 'best'",
        (
            "{study}: assistance.policy: there is no policy 'best' (shipped are default, no-help, none, "
            "study-like), and nothing at {here}/best",
        ),
    ),
    "policy that is none": Bad(
        "[assistance]\npolicy = 'mine.json'",
        ('the policy file {here}/mine.json cannot be used: it is not of the format "recollect-policy-1"',),
        {"mine.json": "{}"},
    ),
    "quota of no condition": Bad(
        "[randomisation]\ntarget_n = { tom = 28, control = 28 }",
        ("{study}: randomisation.target_n: there is no condition 'control'; there are {conditions}",),
    ),
    "block that does not divide": Bad(
        "[randomisation]\nblock_size = 5",
        (
            "{study}: randomisation.block_size: a block of 5 slots cannot hold 1 tom, 1 notom in ratio; "
            "2, 4, 6 and so on fit",
        ),
    ),
    "unknown deck": Bad(
        "[game]\ndeck = 'cars'",
        ("{study}: game.deck: there is no deck 'cars' (shipped are animals, fruit), and nothing at {here}/cars",),
    ),
    "no deck": Bad("[game]\ndeck = ''", ("{study}: game.deck: there is no deck '' (shipped are animals, fruit)",)),
    "deck that is too small": Bad(
        "[game]\ndeck = 'fruit'\n[practice]\ndeck = 'animals'",
        ("{study}: game.deck: a board of 4 x 6 needs 12 pictures, but the deck 'fruit' has 6",),
    ),
    "odd board": Bad(
        "[game]\nrows = 3\ncolumns = 5", ("{study}: game: a board of 3 x 5 has 15 places, but cards come in pairs",)
    ),
    "practice with the same pictures": Bad(
        "[practice]\ndeck = 'animals'",
        ("{study}: practice.deck: the game has the pictures 'animals' too; choose others",),
    ),
    # Information sheets
    "no sheets": Bad(
        "[consent]\ntext = 'lab'",
        (
            "{study}: consent.text: there is no folder of information sheets 'lab' (shipped are study), and "
            "nothing at {here}/lab",
        ),
    ),
    "no sheet in a language": Bad(
        TOLD,
        ("there is no information sheet for the language 'es' in {here}/sheets",),
        {name: text for name, text in SHEETS.items() if "/es" not in name},
    ),
    "sheets of two versions": Bad(
        TOLD,
        ("the information sheets in {here}/sheets have different versions: en: 2; it: 3; es: 2",),
        told("it", 'version = "2"', 'version = "3"'),
    ),
    "sheets with other purposes": Bad(
        TOLD,
        (
            "the information sheets in {here}/sheets have different purposes: "
            "en: share (optional); it: share (optional); es: share",
        ),
        told("es", "required = false\n", ""),
    ),
    "sheet without a debrief": Bad(
        TOLD,
        (
            "the information sheet {here}/sheets/it.toml: the key 'debrief' is missing",
            "the information sheet {here}/sheets/it.toml: there is no key 'debriefing'; did you mean 'debrief'?",
        ),
        told("it", "[debrief]", "[debriefing]"),
    ),
    "sheet with an empty paragraph": Bad(
        TOLD,
        ("the information sheet {here}/sheets/en.toml: about.paragraph 5 must not be empty",),
        told("en", r"It takes about ten minutes\nYou can stop whenever you like.", ""),
    ),
    "purpose twice": Bad(
        TOLD,
        ("the information sheet {here}/sheets/en.toml: consent.purposes: the purpose 'share' stands twice",),
        told("en", "[debrief]", more_asked("share")),
    ),
    "pointer without consent": Bad(
        "[privacy]\npointer_trace = true",
        ("{study}: privacy.pointer_trace: the consent has no purpose 'pointer' that a visitor could agree to",),
    ),
    # Questionnaires
    "unknown questionnaire": Bad(
        "about_you = 'me'",
        (
            "{study}: about_you: there is no questionnaire 'me' (shipped are about-you, another-game, gallery, "
            "psi, social-intelligence, trust), and nothing at {here}/me",
        ),
    ),
    "questionnaire twice": Bad(
        "questionnaires = ['trust', 'trust']", ("{study}: questionnaires: 'trust' stands twice",)
    ),
    "questionnaire that is none": Bad(
        OWN,
        (
            "the questionnaire {here}/own.toml is not TOML: Expected ']]' at the end of an array declaration "
            "(at line 1, column 8)",
        ),
        {"own.toml": "[[items]"},
    ),
    "questionnaire without items": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: items must have at least 1 entry, but it has 0",),
        {"own.toml": 'id = "own"\nversion = "1"\nnote = "x"\nitems = []'},
    ),
    "questionnaire without a note": Bad(
        OWN, ("the questionnaire {here}/own.toml: the key 'note' is missing",), asked(('note = "ours"\n', ""))
    ),
    "item without a kind": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): the key 'kind' is missing",),
        asked(('kind = "likert"\n', "")),
    ),
    "item of an unknown kind": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): kind must be one of {kinds}, but it is 'stars'",),
        asked(('"likert"', '"stars"')),
    ),
    "item with a misspelt key": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): there is no key 'pionts'; did you mean 'points'?",),
        asked(('kind = "likert"', 'kind = "likert"\npionts = 7')),
    ),
    "item with one point": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): points must be from 2 to 11, but it is 1",),
        asked(('kind = "likert"', 'kind = "likert"\npoints = 1')),
    ),
    "item without an end": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): the key 'lowest' is missing",),
        asked(('lowest = { en = "little", it = "poco", es = "poco" }\n', "")),
    ),
    "item without a language": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): text: 'How?' stands in no language; write { en = 'How?' }",),
        asked(('{ en = "How?", it = "Come?", es = "¿Cómo?" }', '"How?"')),
    ),
    "item that is not worded": Bad(
        OWN, ("the questionnaire {here}/own.toml lacks words in 'es' for one",), asked((', es = "¿Cómo?"', ""))
    ),
    "item with a bad name": Bad(
        OWN,
        (
            "the questionnaire {here}/own.toml: item 1 (item 1): id: 'item 1' is no name; a name begins with a "
            "letter and has letters, digits, _ and - only",
        ),
        asked(('id = "one"', 'id = "item 1"')),
    ),
    "items of one name in two": Bad(
        "questionnaires = ['own.toml', 'other.toml']",
        ("{study}: questionnaires: 'own' and 'other' both have the items one",),
        asked() | {"other.toml": QUESTIONS.replace("own", "other")},
    ),
    "questionnaires of one name": Bad(
        "questionnaires = ['own.toml', 'other.toml']",
        ("{study}: questionnaires: two of them have the id 'own'",),
        asked() | {"other.toml": QUESTIONS.replace("one", "two")},
    ),
    "scale that cannot be summed": Bad(
        OWN,
        (
            "the questionnaire {here}/own.toml: items: those of the scale 'S' have different ends, so they "
            "cannot be summed",
        ),
        asked(
            ('kind = "likert"', 'kind = "likert"\nscale = "S"'),
            (
                '"mucho" }\n',
                '"mucho" }\n[[items]]\nid = "two"\nkind = "slider"\nscale = "S"\ntext = { en = "?" }\n'
                'left = { en = "l" }\nright = { en = "r" }\n',
            ),
        ),
    ),
    "pictures that are not there": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: one: there is no picture {assets}/scales/faces/6.svg",),
        asked(('kind = "likert"', 'kind = "pictures"\npoints = 6')),
    ),
    "no such pictures": Bad(
        OWN,
        (
            "the questionnaire {here}/own.toml: one: there is no folder of pictures 'suns' (shipped are faces), "
            "and nothing at {here}/suns",
        ),
        asked(('kind = "likert"', 'kind = "pictures"\npictures = "suns"')),
    ),
    "fault in what a kind shares": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: likert.points must be from 2 to 11, but it is 12",),
        asked(("[[items]]", "[likert]\npoints = 12\n[[items]]")),
    ),
    "items that differ by capitals": Bad(
        OWN,
        (f"the questionnaire {{here}}/own.toml: the items 'one' and 'ONE' {ONE_NAME}",),
        {"own.toml": QUESTIONS + QUESTIONS[QUESTIONS.index("[[items]]") :].replace('"one"', '"ONE"')},
    ),
    "items of two that differ by a hyphen": Bad(
        "questionnaires = ['own.toml', 'other.toml']",
        (f"the items 'an-item' in {{here}}/own.toml and 'An_Item' in {{here}}/other.toml {ONE_NAME}",),
        asked(('"one"', '"an-item"')) | {"other.toml": QUESTIONS.replace("own", "other").replace('"one"', '"An_Item"')},
    ),
    "questionnaires that differ by a hyphen": Bad(
        "questionnaires = ['own.toml', 'other.toml']",
        (f"the questionnaires 'form-a' in {{here}}/own.toml and 'form_a' in {{here}}/other.toml {ONE_NAME}",),
        asked(('id = "own"', 'id = "form-a"'))
        | {"other.toml": QUESTIONS.replace('id = "own"', 'id = "form_a"').replace('"one"', '"two"')},
    ),
    "scales that differ by capitals": Bad(
        "questionnaires = ['own.toml', 'other.toml']",
        (f"the scales 'S' in {{here}}/own.toml and 's' in {{here}}/other.toml {ONE_NAME}",),
        asked(('kind = "likert"', 'kind = "likert"\nscale = "S"'))
        | {
            "other.toml": QUESTIONS.replace("own", "other")
            .replace('"one"', '"two"')
            .replace('kind = "likert"', 'kind = "likert"\nscale = "s"')
        },
    ),
    "questionnaire with the name of a device": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: id: Windows keeps the name 'Con' for a device; choose another",),
        asked(('id = "own"', 'id = "Con"')),
    ),
    "options that tables turn into something else": Bad(
        OWN,
        (
            f"the questionnaire {{here}}/own.toml: where: the options 'home' and 'Home' {ONE_NAME}",
            *(
                f"the questionnaire {{here}}/own.toml: where: the option {option!r} is taken for {misread} by programs "
                "that read tables; choose another id"
                for option, misread in (("NA", MISSING), ("MAR1", NUMBER), ("TRUE", TRUTH))
            ),
        ),
        {
            "own.toml": QUESTIONS
            + '[[items]]\nid = "where"\nkind = "single"\ntext = { en = "?", it = "?", es = "?" }\noptions = [\n'
            + "".join(
                f'{{ id = "{option}", text = {{ en = "o", it = "o", es = "o" }} }},\n'
                for option in ("home", "Home", "NA", "MAR1", "TRUE")
            )
            + "]\n"
        },
    ),
    "too long a name": Bad(
        OWN,
        (f"the questionnaire {{here}}/own.toml: item 1 ({'o' * 40}...): id must have at most 64 characters",),
        asked(('"one"', f'"{"o" * 70_000}"')),
    ),
    "too long a text": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): text.en must have at most 10000 characters",),
        asked(("How?", "How? " * 2001)),
    ),
    "too long a path": Bad(f"about_you = '{'a/' * 300}b'", ("{study}: about_you must have at most 500 characters",)),
    "title of two lines": Bad('title = "One\\nTwo"', ("{study}: title: 'One\\nTwo' has more than one line",)),
    "control characters": Bad(
        'title = \'a\'\nlanguages = [\'en\', "e\\u0000n"]\n[assistance]\nname = "\\u001b[31m"\n"\\u009b" = 1',
        (
            "{study}: language 2 has the control character U+0000; take it out",
            "{study}: a key has the control character U+009B; take it out",
            "{study}: assistance.name has the control character U+001B; take it out",
        ),
    ),
    "a control character in the sentences": Bad(
        "languages = ['en', 'de']\nquestionnaires = ['own.toml']",
        ("the file {here}/de/hints.ftl, line 2, has the control character U+001B; take it out", *UNTRANSLATED),
        asked() | SENTENCES | {"de/hints.ftl": "# Words\na = \x1b[31m"},
    ),
    "a control character in a question": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: item 1 (one): text.it has the control character U+0000; take it out",),
        asked(("Come?", "Come\\u0000?")),
    ),
    "more items than a form can have": Bad(
        OWN,
        ("the questionnaire {here}/own.toml: items must have at most 600 entries, but it has 601",),
        {"own.toml": HEAD_OF_QUESTIONS + "".join(ITEM.format(number) for number in range(601))},
    ),
    "more items than a study can have": Bad(
        "languages = ['en']\nquestionnaires = ['a.toml', 'b.toml']",
        ("{study}: questionnaires: together they have 1,003 items; a study has at most 1,000",),
        {
            f"{name}.toml": HEAD_OF_QUESTIONS.replace("own", name)
            + "".join(ITEM.format(f"{name}{number}") for number in range(500))
            for name in "ab"
        },
    ),
    "purposes that differ by capitals": Bad(
        TOLD,
        (f"the information sheets in {{here}}/sheets: the purposes 'share' and 'Share' {ONE_NAME}",),
        {name: sheet.replace("[debrief]", more_asked("Share")) for name, sheet in SHEETS.items()},
    ),
}
