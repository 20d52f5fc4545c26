"""All settings of one study file."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    Field,
    PrivateAttr,
    field_validator,
    model_validator,
)

from kiosk import UserInputError
from kiosk.config.devices import NO_ROBOT, VOICE_ENGINES, MarkersConfig, Remote, RobotConfig, VoiceConfig, host_fault
from kiosk.config.look import ExperimenterConfig, Keys, Look, Screen
from kiosk.config.models import MOST_CHARACTERS, MOST_ENTRIES, MOST_IN_TEXT, MOST_QUOTED, ConfigModel, read_text
from kiosk.config.session import (
    CONDITION_NAME,
    KNOWN_CONDITIONS,
    PAPER_CONDITIONS,
    STAGES,
    Allocation,
    AssistanceConfig,
    ConditionConfig,
    ConsentConfig,
    Game,
    Idle,
    Practice,
    Privacy,
    ReturningConfig,
    Timing,
)
from kiosk.errors import (
    toml_line,
)
from kiosk.extensions import ExtensionGroup, registered_names
from kiosk.lazy_dataclass import dataclass
from kiosk.places import ENDINGS, Located, code_of, is_path, is_there, shipped_place


@dataclass(frozen=True)
class PackageOrigin:
    """The packed study that settings came from; ``shipped`` are the hashes of what came with Recollect there."""

    path: Path
    sha256: str
    shipped: Mapping[str, str]


def _one_line(text: str) -> str:
    if len(text.splitlines()) > 1:
        raise ValueError(f"{text[:MOST_QUOTED]!r} has more than one line")
    return text


OwnText = Annotated[str, Field(max_length=MOST_IN_TEXT)]


class Settings(ConfigModel):
    """Everything that one study may set."""

    file_kind = "study file"

    title: Annotated[
        str,
        Field(min_length=1, max_length=MOST_CHARACTERS, description="What the study is called, in the data set."),
        AfterValidator(_one_line),
    ] = "A memory game with a helping robot"
    languages: Annotated[
        tuple[str, ...],
        Field(
            min_length=1,
            max_length=MOST_ENTRIES,
            strict=False,
            description="The languages to choose from; the first is shown at rest.",
        ),
    ] = ("en", "it", "es")
    texts: Annotated[
        dict[str, OwnText | dict[str, OwnText | dict[str, OwnText]]],
        Field(
            max_length=MOST_ENTRIES,
            description="Own words for single messages of a language: [texts.en] with a key for each message, or "
            'en = "texts/en.ftl", a file with them.',
        ),
    ] = {}
    stages: Annotated[
        tuple[str, ...], Field(min_length=1, strict=False, description="The stages of a session, in their order.")
    ] = STAGES
    about_you: Annotated[
        str, Field(description="The questionnaire about the visitor: a name in assets/questionnaires, or a path.")
    ] = "about-you"
    questionnaires: Annotated[
        tuple[str, ...],
        Field(
            min_length=1,
            max_length=MOST_ENTRIES,
            strict=False,
            description="The questionnaires after the game: names, or paths.",
        ),
    ] = ("social-intelligence", "trust", "another-game")
    game: Game = Game()
    practice: Practice = Practice()
    assistance: AssistanceConfig = AssistanceConfig()
    conditions: Annotated[
        dict[str, ConditionConfig], Field(max_length=MOST_ENTRIES, description="The conditions, by their names.")
    ] = PAPER_CONDITIONS
    randomisation: Allocation = Allocation()
    consent: ConsentConfig = ConsentConfig()
    timing: Timing = Timing()
    idle_ms: Idle = Idle()
    voice: VoiceConfig = VoiceConfig()
    robot: RobotConfig = RobotConfig()
    screen: Screen = Screen()
    look: Look = Look()
    shortcuts: Keys = Keys()
    experimenter: ExperimenterConfig = ExperimenterConfig()
    privacy: Privacy = Privacy()
    returning: ReturningConfig = ReturningConfig()
    markers: MarkersConfig = MarkersConfig()
    remote: Annotated[Remote, Field(exclude=True)] = Remote()

    _file: Path | None = PrivateAttr(None)
    """The study file; what it names by a path lies in its folder. It is no setting, and is not recorded."""
    _package: PackageOrigin | None = PrivateAttr(None)

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a study file; the paths in it start from its own folder."""
        return super().read(path)._at(path)

    @classmethod
    def from_package(cls, given: Mapping[str, Any], file: Path, package: PackageOrigin) -> Self:
        """Return the settings of a packed study whose files were put beside ``file``; raises ValidationError."""
        return cls.model_validate(given)._at(file, package)

    def _at(self, file: Path, package: PackageOrigin | None = None) -> Self:
        """Note where they were read; raises UserInputError for a robot that is not installed."""
        self._file, self._package = file, package
        # Not in the model: a stored session stays readable where its robot is not installed.
        kinds = (NO_ROBOT, *registered_names(ExtensionGroup.ROBOTS))
        if self.robot.kind not in kinds:
            offered = f"{', '.join(map(repr, kinds[:-1]))} or {kinds[-1]!r}"
            raise UserInputError(f"{self.name}: robot.kind must be {offered}, but it is {self.robot.kind!r}")
        fault = host_fault(self.robot.host)
        if fault:
            line = self.line_of("robot", "host")
            raise UserInputError(f"{self.name}: robot.host: {fault}" + (f" (line {line})" if line else ""))
        return self

    @property
    def package(self) -> PackageOrigin | None:
        """The packed study that they came from; None if they did not."""
        return self._package

    @property
    def name(self) -> str:
        """What to call them in a refusal."""
        if self._package:
            return f"the packed study {self._package.path}"
        return f"the {self.file_kind} {self._file}" if self._file else "the study"

    def line_of(self, *key: str | int) -> int | None:
        """Return the line of a key in the study file, counted from 1; None for what is not there."""
        if self._file is None:
            return None
        try:
            return toml_line(read_text(self.name, self._file), key)
        except UserInputError:
            # The file has changed since it was read.
            return None

    def own_texts(self, code: str) -> Mapping[str, str | Mapping[str, str]]:
        """Return the messages of a language that the study file itself replaces."""
        own = self._texts_of(code)
        return {} if isinstance(own, str) else own

    def own_texts_file(self, code: str) -> Path | None:
        """Return the file that replaces messages of a language, if the study file names one."""
        own = self._texts_of(code)
        return self.beside(own) if isinstance(own, str) else None

    def texts_place(self, code: str, message: str) -> tuple[Path, int | None]:
        """Return the file and the line in which the study file replaces a message."""
        key = next((key for key in self.texts if code_of(key) == code), code)
        return self._file or Path("study.toml"), self.line_of("texts", key, message)

    def _texts_of(self, code: str) -> str | Mapping[str, str | Mapping[str, str]]:
        return next((own for key, own in self.texts.items() if code_of(key) == code), {})

    @field_validator("conditions")
    @classmethod
    def _name_conditions(cls, declared: dict[str, ConditionConfig]) -> dict[str, ConditionConfig]:
        for name, condition in declared.items():
            if not CONDITION_NAME.fullmatch(name):
                raise ValueError(
                    f"{name!r} is no name of a condition: it has small letters, digits and _ only, at most 40, and "
                    "begins with a letter"
                )
            known = KNOWN_CONDITIONS.get(name)
            if known is not None and known != condition.model_copy(update={"policy": "", "timing": {}}):
                raise ValueError(f"{name!r} has a meaning of its own; give a condition that is different another name")
        return declared

    @property
    def all_conditions(self) -> dict[str, ConditionConfig]:
        """Every condition by its name: what is declared, and what is known without that."""
        return KNOWN_CONDITIONS | self.conditions

    def condition(self, name: str) -> ConditionConfig:
        """Return the condition of a name; raises UserInputError with all the names there are."""
        there = self.all_conditions
        if name not in there:
            raise UserInputError(f"there is no condition {name!r}; there are {', '.join(there)}")
        return there[name]

    @model_validator(mode="after")
    def _reword_what_is_spoken(self) -> Self:
        spoken = {code_of(name) for name in self.languages}
        strange = [language for language in self.texts if code_of(language) not in spoken]
        if strange:
            raise ValueError(f"texts: {strange[0]!r} is none of the languages")
        return self

    @model_validator(mode="after")
    def _name_things_once(self) -> Self:
        spoken = {code_of(language) for language in self.voice.speakers} - {code_of(name) for name in self.languages}
        if spoken:
            raise ValueError(f"voice.speakers: {min(spoken)!r} is none of the languages")
        unknown = [name for name in self.voice.speakers.values() if name not in VOICE_ENGINES and not is_path(name)]
        if unknown:
            known = ", ".join(VOICE_ENGINES)
            raise ValueError(
                f"voice.speakers: {unknown[0]!r} is no engine ({known}), and no path such as './voices/en'"
            )
        for key, names in (
            ("languages", self.languages),
            ("stages", self.stages),
            ("questionnaires", (self.about_you, *self.questionnaires)),
        ):
            twice = [name for name, count in Counter(names).items() if count > 1]
            if twice:
                raise ValueError(f"{key}: {twice[0]!r} stands twice")
        return self

    @property
    def sha256(self) -> str:
        """The hash of every setting, given or default, so that a session's settings can be told apart later."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    @property
    def own_fonts(self) -> tuple[Path, ...]:
        """The files of the study's own fonts."""
        return tuple(map(self.beside, self.look.fonts))

    @property
    def voice_from_here(self) -> VoiceConfig:
        """The voice's settings, whose packs are named by whole paths and whose languages as the session has them."""
        speakers = {
            code_of(language): str(self.beside(name).absolute()) if is_path(name) else name
            for language, name in self.voice.speakers.items()
        }
        return self.voice.model_copy(update={"speakers": speakers})

    def with_base_dir(self, other: Settings) -> Settings:
        """Return the same settings, whose paths start from the folder of another study file."""
        copied = self.model_copy()
        copied._file = other._file
        return copied

    @property
    def language_codes(self) -> tuple[str, ...]:
        """List the codes of the languages.

        A language that is named by a path has its folder's name as its code.
        """
        return tuple(code_of(name) for name in self.languages)

    def resolve_asset(self, kind: str, name: str) -> Path:
        """Return the path of what the study file calls by this name, whether it is there or not."""
        found = self.locate(kind, name)
        return self.beside(name) if found is None else found.path

    def is_shipped(self, kind: str, name: str) -> bool:
        """Return whether the study file means something shipped by this name."""
        found = self.locate(kind, name)
        return found is not None and found.is_shipped

    def locate(self, kind: str, name: str) -> Located | None:
        """Find what the study file calls by this name; None if there is nothing.

        A name with a slash or an ending is a path from the study file's own folder, and nothing else. Any other name
        is that of something shipped or, if nothing shipped has it, of something in the study file's folder.
        """
        if not name:
            return None
        ending = ENDINGS.get(kind, "")
        names = (f"{name}{ending}", name) if ending else (name,)
        own = next((path for path in map(self.beside, names) if is_there(path, ending)), None)
        shipped = None if is_path(name) else shipped_place(kind, name)
        if shipped is not None:
            return Located(shipped, is_shipped=True, unused=own)
        return None if own is None else Located(own)

    def beside(self, name: str) -> Path:
        """Return a path as the study file means it: from its own folder; a backslash is a slash, too."""
        path = Path(name.replace("\\", "/"))
        return self._file.parent / path if self._file else path
