"""The scenes in which a visitor decides whether anything is stored: consent, and the question of age."""

from __future__ import annotations

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Script
from kiosk.study.declared.information import Information
from kiosk.study.events import WorldEvent
from kiosk.study.scenes.scene import Scene


class Consent(Scene):
    """One box for each purpose, none ticked; agreeing counts once every required one is."""

    def __init__(self, information: Information, language: str) -> None:
        """Ask for the consent of this sheet."""
        self._information = information
        self._language = language
        self._ticked: frozenset[str] = frozenset()

    @property
    def characters(self) -> int:
        """How long the page is, boxes and all."""
        return self._information.consent.characters

    def enter(self, script: Script) -> None:
        """Show the boxes."""
        self._ticked = frozenset()
        script.do(do.ShowConsent(self._information.consent))

    def accepts(self, event: WorldEvent) -> bool:
        """Whether the purpose is one of those that are shown."""
        match event:
            case happened.PurposeTicked(purpose=purpose):
                return purpose in (offered.id for offered in self._information.consent.purposes)
        return True

    def react(self, event: WorldEvent, script: Script) -> None:
        """Keep the ticks, or conclude from them."""
        match event:
            case happened.PurposeTicked(purpose=purpose, ticked=ticked):
                self._ticked = self._ticked | {purpose} if ticked else self._ticked - {purpose}
                script.do(do.ShowTicks(self._ticked))
            case happened.AgreeTapped():
                self._agree(script)

    def _agree(self, script: Script) -> None:
        missing = self._information.consent.required - self._ticked
        purposes = tuple(purpose.id for purpose in self._information.consent.purposes)
        if missing:
            script.do(do.ShowMissing(tuple(purpose for purpose in purposes if purpose in missing)))
            return
        script.note(
            happened.ConsentGiven(
                at_ms=script.at_ms,
                version=self._information.version,
                sha256=self._information.sha256,
                language=self._language,
                purposes=tuple(purpose for purpose in purposes if purpose in self._ticked),
            )
        )


class AgeGate(Scene):
    """Whether the visitor is old enough for their sitting to be stored."""

    def __init__(self, adult: int) -> None:
        """Ask for this age in years."""
        self._adult = adult

    def enter(self, script: Script) -> None:
        """Ask."""
        script.do(do.ShowAgeQuestion(self._adult))
