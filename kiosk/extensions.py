"""Find what other packages add to Recollect: robots, kinds of questionnaire items and assistive actions.

A package registers a thing by an entry point in the group of its sort; what comes with Recollect is registered in the
same form, in the table below. Nothing is imported before it is used.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from enum import Enum
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from kiosk import UserInputError, __version__
from kiosk.lazy_dataclass import dataclass

OWN = "recollect"
"""The package that what is built in comes with."""


class ExtensionGroup(Enum):
    """A sort of thing that can be added, by its group of entry points."""

    ROBOTS = "recollect.robots"
    ITEMS = "recollect.items"
    ACTIONS = "recollect.actions"

    @property
    def noun(self) -> str:
        """What one of them is called in a sentence."""
        return _NOUNS[self]


_NOUNS = {
    ExtensionGroup.ROBOTS: "robot",
    ExtensionGroup.ITEMS: "kind of item",
    ExtensionGroup.ACTIONS: "action",
}

# A build without Python carries no entry points, so these do not stand in pyproject.toml. What stands in brackets is
# the optional set of libraries that a driver needs.
_BUILT_IN: Mapping[ExtensionGroup, Mapping[str, str]] = {
    ExtensionGroup.ROBOTS: {
        "furhat": "kiosk.robots.furhat:Furhat",
        "furhat-realtime": "kiosk.robots.furhat_realtime:FurhatRealtime [realtime]",
    },
    ExtensionGroup.ITEMS: {
        "likert": "kiosk.experiment.items:Likert",
        "differential": "kiosk.experiment.items:Differential",
        "slider": "kiosk.experiment.items:Slider",
        "pictures": "kiosk.experiment.items:Pictures",
        "single": "kiosk.experiment.items:Single",
        "multiple": "kiosk.experiment.items:Multiple",
        "integer": "kiosk.experiment.items:Integer",
        "text": "kiosk.experiment.items:ShortText",
        "page": "kiosk.experiment.items:TextPage",
    },
    ExtensionGroup.ACTIONS: {
        "no_help": "kiosk.assistance.policy:NO_HELP",
        "sug_col": "kiosk.assistance.policy:SUG_COL",
        "sug_row": "kiosk.assistance.policy:SUG_ROW",
        "sug_card": "kiosk.assistance.policy:SUG_CARD",
        "encouragement": "kiosk.assistance.policy:ENCOURAGEMENT",
        "praise": "kiosk.assistance.policy:PRAISE",
    },
}

_NAME = re.compile(r"[a-z][a-z0-9_-]*")


@dataclass(frozen=True)
class Extension:
    """One thing that a package registered: its name in study files, the package, and the package's version."""

    group: ExtensionGroup
    name: str
    package: str
    version: str
    entry: EntryPoint

    @property
    def is_built_in(self) -> bool:
        """Whether it comes with Recollect."""
        return self.package == OWN

    @property
    def described(self) -> str:
        """What it is and where it comes from, for a sentence."""
        return f"the {self.group.noun} {self.name!r} of the package {self.package} {self.version}"

    def broken(self, why: str) -> UserInputError:
        """Return the error that says why it cannot be used."""
        return UserInputError(f"{self.described} cannot be used: {why}")

    def load(self) -> object:
        """Import it; raises UserInputError, whatever goes wrong in the package."""
        if not _NAME.fullmatch(self.name):
            raise self.broken("a name has small letters, digits, - and _ only, and begins with a letter")
        try:
            return self.entry.load()
        except ModuleNotFoundError as error:
            extras = ",".join(self.entry.extras)
            remedy = f"; install {self.package}[{extras}]" if extras else ""
            raise self.broken(f"the package {error.name} is missing{remedy}") from error
        except Exception as error:  # the package's own code runs here, and may raise anything
            raise self.broken(f"{type(error).__name__}: {' '.join(str(error).split()) or 'no message'}") from error


@cache
def registered_entries() -> Mapping[ExtensionGroup, tuple[EntryPoint, ...]]:
    """Read what every package registers, for all groups at once: it takes opening a file of each package."""
    there = entry_points()
    return {group: tuple(there.select(group=group.value)) for group in ExtensionGroup}


@cache
def installed(group: ExtensionGroup) -> tuple[Extension, ...]:
    """List everything of a group: what is built in, then what other packages registered, by name."""
    own = [
        Extension(group, name, OWN, __version__, EntryPoint(name, place, group.value))
        for name, place in _BUILT_IN.get(group, {}).items()
    ]
    found = registered_entries()[group]
    others = [
        Extension(group, each.name, each.dist.name, each.dist.version, each) for each in found if each.dist is not None
    ]
    return (*own, *sorted(others, key=lambda each: (each.name, each.package)))


def registered_names(group: ExtensionGroup) -> tuple[str, ...]:
    """List the names of a group, each once."""
    return tuple(dict.fromkeys(each.name for each in installed(group)))


def find(group: ExtensionGroup, name: str) -> Extension:
    """Return what goes by a name; raises UserInputError if nothing does, or two packages claim it."""
    matching = [each for each in installed(group) if each.name == name]
    if not matching:
        there = ", ".join(registered_names(group))
        raise UserInputError(f"there is no {group.noun} {name!r}; there are {there}")
    if len(matching) > 1:
        packages = " and ".join(f"{each.package} {each.version}" for each in matching)
        raise UserInputError(f"the {group.noun} {name!r} is registered twice, by the packages {packages}; remove one")
    return matching[0]
