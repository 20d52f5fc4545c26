"""Every screen there is, together: what they all are told at once, and whom they tell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, QUrl

from kiosk.assistant.wording import Catalogue
from kiosk.study import events as happened
from kiosk.study.events import WorldEvent
from kiosk.study.plan import Study
from kiosk.ui.panel.screen import ExperimenterScreen
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.board import BoardScreen
from kiosk.ui.screens.deciding import AgeScreen, ConsentScreen
from kiosk.ui.screens.form import FormScreen
from kiosk.ui.screens.plain import AttractScreen, KioskScreen
from kiosk.ui.screens.reading import AboutScreen, DebriefScreen, IntroductionScreen, ResultScreen, ThanksScreen


class Tell(Protocol):
    """Takes an event of this kind, with what belongs to it."""

    def __call__(self, kind: type[WorldEvent], **what: object) -> None:
        """Something happened just now."""
        ...


@dataclass(frozen=True)
class Screens:
    """Everything that can be shown."""

    kiosk: KioskScreen
    attract: AttractScreen
    about: AboutScreen
    consent: ConsentScreen
    age: AgeScreen
    form: FormScreen
    introduction: IntroductionScreen
    board: BoardScreen
    result: ResultScreen
    debrief: DebriefScreen
    thanks: ThanksScreen
    avatar: AvatarScreen
    experimenter: ExperimenterScreen

    @classmethod
    def of(cls, study: Study, owner: QObject) -> Screens:
        """The screens of a study, all of them empty; they live as long as ``owner``."""
        catalogues = [plan.catalogue for plan in study.plans]
        first, find = catalogues[0], study.settings.find
        return cls(
            kiosk=KioskScreen(first, owner),
            attract=AttractScreen(_pictures(study, partial(find, "cards")), catalogues, owner),
            about=AboutScreen(owner),
            consent=ConsentScreen(owner),
            age=AgeScreen(first, owner),
            form=FormScreen(first, partial(find, "scales"), owner),
            introduction=IntroductionScreen(owner),
            board=BoardScreen(first, partial(find, "cards"), owner),
            result=ResultScreen(first, owner),
            debrief=DebriefScreen(first, owner),
            thanks=ThanksScreen(owner),
            avatar=AvatarScreen(owner),
            experimenter=ExperimenterScreen(owner),
        )

    @property
    def resting(self) -> Catalogue:
        """The language while nobody is there."""
        return self.attract.resting

    @property
    def by_name(self) -> dict[str, QObject]:
        """Every screen by its name, which is also what QML calls it."""
        return {name: screen for name, screen in vars(self).items() if isinstance(screen, QObject)}

    def speak(self, catalogue: Catalogue) -> None:
        """Show everything in this language."""
        for screen in (self.kiosk, self.age, self.form, self.board, self.result, self.debrief):
            screen.speak(catalogue)

    def clear(self) -> None:
        """Leave nothing of a visitor, and show the language again that is shown at rest."""
        for screen in (
            self.kiosk,
            self.attract,
            self.about,
            self.consent,
            self.age,
            self.form,
            self.introduction,
            self.board,
            self.result,
            self.debrief,
            self.thanks,
            self.avatar,
        ):
            screen.clear()
        self.speak(self.resting)

    def listen(self, start: Callable[[str], None], tell: Tell) -> None:
        """Hand on what visitors do: ``start`` takes the language of a new one, ``tell`` everything after that."""
        self.attract.started.connect(start)
        self.kiosk.confirmed.connect(partial(tell, happened.StillHereTapped))
        self.consent.ticked.connect(
            lambda purpose, ticked: tell(happened.PurposeTicked, purpose=purpose, ticked=ticked)
        )
        self.consent.agreed.connect(partial(tell, happened.AgreeTapped))
        self.consent.declined.connect(partial(tell, happened.DeclineTapped))
        self.age.answered.connect(lambda adult: tell(happened.AgeTapped, adult=adult))
        self.form.typed.connect(partial(tell, happened.Typed))
        self.form.answered.connect(lambda item, value: tell(happened.AnswerGiven, item=item, value=value))
        self.board.tapped.connect(lambda position: tell(happened.CardTapped, position=position))
        self.board.skipped.connect(partial(tell, happened.SkipTapped))
        for screen in (self.about, self.form, self.introduction, self.result, self.debrief, self.thanks):
            screen.continued.connect(partial(tell, happened.ContinueTapped))


def _pictures(study: Study, folder_of: Callable[[str], Path]) -> list[str]:
    """The addresses of the pictures of the game's deck."""
    folder = folder_of(study.settings.game.deck)
    return [QUrl.fromLocalFile(str(folder / f"{card}.svg")).toString() for card in study.plans[0].deck]
