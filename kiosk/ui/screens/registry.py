"""Every screen there is, together: what they all are told at once, and whom they tell."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Protocol

from PySide6.QtCore import QObject

from kiosk.assistance.wording import Catalogue
from kiosk.experiment import events as happened
from kiosk.experiment.events import InputDevice, WorldEvent
from kiosk.experiment.session_config import StudyConfig
from kiosk.lazy_dataclass import dataclass
from kiosk.ui.cards import CardPictures
from kiosk.ui.experimenter.view_model import ExperimenterScreen
from kiosk.ui.screens.attract import AttractScreen
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.board import BoardScreen
from kiosk.ui.screens.consent import AgeScreen, ConsentScreen
from kiosk.ui.screens.debrief import DebriefScreen
from kiosk.ui.screens.pages import AboutScreen, IntroductionScreen, ResultScreen, ThanksScreen
from kiosk.ui.screens.questionnaire import FormScreen
from kiosk.ui.screens.returning import ReturnScreen
from kiosk.ui.screens.shell import KioskScreen


class InputHandler(Protocol):
    """Takes what visitors do to the screens."""

    def now_ms(self) -> int:
        """Return the time of an event that happens now, in ms since the session began."""
        ...

    def input_device(self) -> InputDevice | None:
        """Return what the visitor used last; None if that is not known."""
        ...

    def pointer_trace(self) -> tuple[tuple[int, float, float], ...]:
        """Return the way of the pointer since the last tap; nothing where it may not be recorded."""
        ...

    def start(self, language: str) -> None:
        """Begin a session in this language."""
        ...

    def dispatch(self, event: WorldEvent) -> None:
        """Have the session handle an event."""
        ...


@dataclass(frozen=True)
class ScreenSet:
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
    returning: ReturnScreen
    avatar: AvatarScreen
    experimenter: ExperimenterScreen

    @classmethod
    def of(cls, study: StudyConfig, owner: QObject) -> ScreenSet:
        """Return the screens of a study, all of them empty; they live as long as ``owner``."""
        catalogues = [plan.catalogue for plan in study.plans]
        first, resolve = catalogues[0], study.settings.resolve_asset
        pictures = CardPictures(study.settings)
        avatar = AvatarScreen(owner)
        avatar.call(study.settings.assistance.name)
        kiosk = KioskScreen(first, owner)
        kiosk.plan(study.settings.stages)
        return cls(
            kiosk=kiosk,
            attract=AttractScreen(pictures.deck(study.settings.game.deck), catalogues, owner),
            about=AboutScreen(owner),
            consent=ConsentScreen(first, owner),
            age=AgeScreen(first, owner),
            form=FormScreen(first, partial(resolve, "scales"), owner),
            introduction=IntroductionScreen(owner),
            board=BoardScreen(first, pictures, owner),
            result=ResultScreen(first, owner),
            debrief=DebriefScreen(first, owner),
            thanks=ThanksScreen(owner),
            returning=ReturnScreen(first, owner),
            avatar=avatar,
            experimenter=ExperimenterScreen(owner),
        )

    @property
    def resting(self) -> Catalogue:
        """The language while no visitor is there."""
        return self.attract.resting

    @property
    def by_name(self) -> dict[str, QObject]:
        """Every screen by its name, which is also what QML calls it."""
        return {name: screen for name, screen in vars(self).items() if isinstance(screen, QObject)}

    def set_language(self, catalogue: Catalogue) -> None:
        """Show everything in this language."""
        for screen in (
            self.kiosk,
            self.consent,
            self.age,
            self.form,
            self.board,
            self.result,
            self.debrief,
            self.returning,
        ):
            screen.set_language(catalogue)

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
            self.returning,
            self.avatar,
        ):
            screen.clear()
        self.set_language(self.resting)

    def clear_unseen(self) -> Iterator[None]:
        """Leave nothing of a visitor on the pages that do not stand there; yields before each, and at the end."""
        for screen, names in (
            (self.about, {"about"}),
            (self.consent, {"consent"}),
            (self.form, {"form"}),
            (self.board, {"practice", "game"}),
            (self.result, {"result"}),
            (self.debrief, {"debrief"}),
        ):
            if self.kiosk.shown not in names:
                yield
                screen.clear()
        yield

    def connect_input(self, to: InputHandler) -> None:
        """Hand on what visitors do: the language of a new one, and an event for everything after that."""
        dispatch, now_ms = to.dispatch, to.now_ms
        self.attract.started.connect(to.start)
        self.kiosk.stopped.connect(lambda: dispatch(happened.StopPressed(at_ms=now_ms())))
        self.kiosk.went_back.connect(lambda: self._go_back(to))
        self.kiosk.asked_again.connect(lambda: dispatch(happened.RepeatPressed(at_ms=now_ms())))
        self.kiosk.language_selected.connect(
            lambda language: dispatch(happened.LanguageSelected(at_ms=now_ms(), language=language))
        )
        self.kiosk.text_size_selected.connect(
            lambda size: dispatch(happened.TextSizeSelected(at_ms=now_ms(), size=happened.TextSize(size)))
        )
        self.kiosk.sound_selected.connect(lambda on: dispatch(happened.SoundSelected(at_ms=now_ms(), on=on)))
        self.kiosk.confirmed.connect(lambda: dispatch(happened.PresenceConfirmed(at_ms=now_ms())))
        self.consent.ticked.connect(
            lambda purpose, ticked: dispatch(
                happened.ConsentPurposeToggled(at_ms=now_ms(), purpose=purpose, ticked=ticked)
            )
        )
        self.consent.agreed.connect(lambda: dispatch(happened.ConsentSubmitted(at_ms=now_ms())))
        self.consent.declined.connect(lambda: dispatch(happened.ConsentDeclined(at_ms=now_ms())))
        self.age.answered.connect(lambda adult: dispatch(happened.AgeConfirmed(at_ms=now_ms(), adult=adult)))
        self.form.typed.connect(lambda: dispatch(happened.TypingActivity(at_ms=now_ms())))
        self.form.answered.connect(
            lambda item, value: dispatch(happened.ResponseGiven(at_ms=now_ms(), item=item, value=value))
        )
        self.board.tapped.connect(
            lambda position: dispatch(
                happened.CardSelected(
                    at_ms=now_ms(), position=position, device=to.input_device(), trace=to.pointer_trace()
                )
            )
        )
        self.board.skipped.connect(lambda: dispatch(happened.PracticeSkipped(at_ms=now_ms())))
        for screen in (self.about, self.form, self.introduction, self.result, self.debrief, self.thanks):
            screen.continued.connect(lambda: dispatch(happened.ContinuePressed(at_ms=now_ms())))

    def _go_back(self, to: InputHandler) -> None:
        """Go back a page; what is being typed is answered first."""
        self.form.finish_typing()
        to.dispatch(happened.BackPressed(at_ms=to.now_ms()))
