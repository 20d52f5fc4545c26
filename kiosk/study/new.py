"""Make the folder of a new study from a template; all of it may be changed."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, NO_ROBOT, Settings, pictures_in, shipped_names
from kiosk.errors import validation_messages
from kiosk.study.decks import NAMES, names_in, names_table, read_names
from kiosk.study.forming import card_forms
from kiosk.study.reference import as_short_study_file

TEMPLATES = ASSETS / "templates"

STUDY_FILE = "study.toml"

_SHOWN = frozenset(
    (
        *("title", "languages", "about_you", "questionnaires", "texts"),
        *("game.rows", "game.columns", "game.deck", "practice.deck", "assistance.name"),
        *("randomisation.target_n", "randomisation.block_size"),
        *("consent.text", "consent.adult", "consent.contact", "voice.enabled"),
        *("robot.kind", "robot.host", "screen.text_size", "look.name"),
    )
)
"""Keys that a new study file has even where they are as without it."""


@dataclass(frozen=True)
class Template:
    """A study to begin with: what it is in a line, its languages, and the keys of its study file."""

    name: str
    about: str
    languages: tuple[str, ...]
    study: Mapping[str, Any]
    packages: tuple[str, ...] = ()
    """The Python packages in its folder, without which the study cannot be run."""

    @property
    def folder(self) -> Path:
        """Where its own files are."""
        return TEMPLATES / self.name

    @property
    def own_languages(self) -> dict[str, Path]:
        """The languages that come with it alone, and the folders of their sentences."""
        return {file.parent.name: file.parent for file in sorted(self.folder.glob("*/screens.ftl"))}

    @property
    def sentences(self) -> dict[str, Path]:
        """All languages that a study made from it can have, and the folders of their sentences."""
        return shipped_names("sentences") | self.own_languages


def templates() -> dict[str, Template]:
    """Map the names of all templates to what they are."""
    return {each.name: each for each in map(_template, sorted(TEMPLATES.glob("*/template.toml")))}


def _template(file: Path) -> Template:
    given = tomllib.loads(file.read_text("utf-8"))
    languages = tuple(given.get("languages", ("en",)))
    return Template(file.parent.name, given["about"], languages, given["study"], tuple(given.get("packages", ())))


def find_template(name: str) -> Template:
    """Return the template of a name; raises UserInputError with the names that there are."""
    there = templates()
    if name not in there:
        raise UserInputError(f"there is no template {name!r}; there are {', '.join(there)}")
    return there[name]


def _where_it_is(language: str) -> str:
    """Return which template brings a language, or where to read how one is added."""
    for template in templates().values():
        if language in template.own_languages:
            return f"the template {template.name!r} has it"
    return "docs/how-to/add-a-language.md says how to add one"


@dataclass(frozen=True)
class NewStudy:
    """What is asked before a study is made; ``robot`` are the keys of its section [robot]."""

    template: Template
    title: str
    contact: str
    languages: tuple[str, ...]
    robot: Mapping[str, Any]

    def files(self) -> dict[str, bytes]:
        """Return all files of the study's folder by their paths in it.

        Raises UserInputError for a language that the template lacks, and for answers that no study file can have.
        """
        there = self.template.sentences
        if not self.languages:
            raise UserInputError(f"a study has at least one language; there are {', '.join(there)}")
        for language in self.languages:
            if language not in there:
                raise UserInputError(
                    f"the template {self.template.name!r} has no language {language!r} (it has {', '.join(there)}); "
                    f"{_where_it_is(language)}"
                )
        settings = self._settings()
        return {
            STUDY_FILE: as_short_study_file(settings, _SHOWN, _head(self.template)).encode(),
            "README.md": _readme(self).encode(),
            **dict(self._information()),
            **dict(self._questionnaires()),
            **{f"texts/{language}.ftl": _own_texts(language).encode() for language in self.languages},
            **dict(self._cards()),
            **dict(self._own_languages()),
            **dict(self._packages()),
        }

    def _settings(self) -> Settings:
        """Return what the study file is to hold."""
        given = _nested(self.template.study)
        given["title"] = self.title or given["title"]
        given["languages"] = list(self.languages)
        given["texts"] = {language: f"texts/{language}.ftl" for language in self.languages}
        given["game"] = {"deck": "./cards"} | given.get("game", {})
        given["consent"] = {"text": "./information", "contact": self.contact} | given.get("consent", {})
        if self.robot:
            given["robot"] = dict(self.robot)
        names = [given.get("about_you", "about-you"), *given.get("questionnaires", Settings().questionnaires)]
        given["about_you"], *given["questionnaires"] = (f"./questionnaires/{name}.toml" for name in names)
        try:
            return Settings.model_validate(given)
        except ValidationError as error:
            raise UserInputError(*validation_messages(error, given, Settings)) from error

    def _information(self) -> Iterator[tuple[str, bytes]]:
        for language in self.languages:
            own = self.template.folder / "information" / f"{language}.toml"
            file = own if own.is_file() else ASSETS / "consent" / "study" / f"{language}.toml"
            yield f"information/{language}.toml", file.read_bytes()

    def _questionnaires(self) -> Iterator[tuple[str, bytes]]:
        study = self.template.study
        for name in (study.get("about_you", "about-you"), *study.get("questionnaires", Settings().questionnaires)):
            own = self.template.folder / "questionnaires" / f"{name}.toml"
            file = own if own.is_file() else ASSETS / "questionnaires" / f"{name}.toml"
            yield f"questionnaires/{name}.toml", file.read_bytes()

    def _cards(self) -> Iterator[tuple[str, bytes]]:
        """Yield a deck of the study's own, to be replaced by other pictures, and the table of its names."""
        own = self.template.folder / "cards"
        cards = pictures_in(own if own.is_dir() else ASSETS / "cards" / Settings().game.deck)
        yield from ((f"cards/{file.name}", file.read_bytes()) for file in cards.values())
        spoken = {language: Catalogue(self.template.sentences[language]) for language in self.languages}
        forms = {language: card_forms(catalogue) for language, catalogue in spoken.items()}
        named = {language: names.forms for language, names in read_names(own).items()}
        names = {language: named.get(language) or names_in(catalogue, cards) for language, catalogue in spoken.items()}
        yield f"cards/{NAMES}", names_table(cards, forms, names).encode()

    def _own_languages(self) -> Iterator[tuple[str, bytes]]:
        for language, folder in self.template.own_languages.items():
            if language in self.languages:
                yield from ((f"{language}/{file.name}", file.read_bytes()) for file in sorted(folder.glob("*.ftl")))

    def _packages(self) -> Iterator[tuple[str, bytes]]:
        folder = self.template.folder / "packages"
        for file in sorted(folder.rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                yield f"packages/{file.relative_to(folder).as_posix()}", file.read_bytes()


def _nested(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy that may be changed."""
    return {key: _nested(value) if isinstance(value, Mapping) else value for key, value in given.items()}


def _head(template: Template) -> str:
    return (
        f"# {template.about[:1].upper()}{template.about[1:]}.\n"
        "# It has the keys that are changed most often; 'recollect study reference' lists all others. Times are in\n"
        "# milliseconds (ms). Check this file with: recollect study check study.toml\n"
    )


def _own_texts(language: str) -> str:
    return (
        f"### Own words for single messages of the language {language!r}. Whatever is not here is as shipped.\n"
        "### 'recollect study translations' lists all messages. Without the # in front of it, this line would replace\n"
        "### the label of a button:\n\n"
        "# about-continue = ...\n"
    )


def _readme(study: NewStudy) -> str:
    template = study.template
    robot = study.robot.get("kind", template.study.get("robot", {}).get("kind"))
    own = [language for language in study.languages if language in template.own_languages]
    lines = [
        f"# {study.title or template.study['title']}",
        "",
        f"Made from the template `{template.name}` ({template.about}).",
        "",
        "| file | what it holds |",
        "|---|---|",
        f"| `{STUDY_FILE}` | the study: stages, conditions, numbers of visitors, times |",
        "| `information/` | what visitors are told and agree to, in each language; an ethics board approves it |",
        "| `questionnaires/` | the questions about the visitor, and those after the game |",
        f"| `cards/` | the pictures (PNG, JPEG, WebP or SVG), and `{NAMES}` with their names |",
        "| `texts/` | own words for single sentences and labels |",
        *(
            f"| `{each}/` | all sentences of the language `{each}`, which does not come with Recollect |"
            for each in own
        ),
        *(("| `packages/` | Python packages that the study needs |",) if template.packages else ()),
        "",
        "In this folder:",
        "",
        *(f"    pip install ./packages/{name}" for name in template.packages),
        f"    recollect study check {STUDY_FILE}      # is all of it right?",
        f"    recollect study cards {STUDY_FILE} --sheet cards.png",
        f"    recollect rehearse --headless --study {STUDY_FILE} --shots pictures",
        f"    recollect run --study {STUDY_FILE}",
        "",
        "Without a PIN every session is a trial. `recollect study set-pin` prints the lines that set one.",
    ]
    if robot and robot != NO_ROBOT:
        tried = f"recollect robot --kind {robot}"
        lines += ["", f"The robot is `{robot}`; try it with `{tried}`. Without it the avatar helps."]
    return "\n".join((*lines, ""))


def default_languages(template: Template, given: Sequence[str]) -> tuple[str, ...]:
    """Return the languages of a new study, each once: those that are given, or the template's."""
    return tuple(dict.fromkeys(given)) or template.languages
