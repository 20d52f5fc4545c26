"""The robots that a study file can name.

A driver is imported only when it is asked for: that takes half a second.
"""

from __future__ import annotations

from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.config import NO_ROBOT, Settings
from kiosk.config import RobotConfig as RobotSettings
from kiosk.errors import validation_messages
from kiosk.extensions import Extension, ExtensionGroup, find
from kiosk.robots.embodiment import Capability, RobotDriver


def load_driver(extension: Extension) -> type[RobotDriver]:
    """Import a driver.

    Raises UserInputError if it is none, or does not go by the name that it is registered by.
    """
    driver = extension.load()
    if not isinstance(driver, type) or not issubclass(driver, RobotDriver):
        raise extension.broken(f"{extension.entry.value} is no class derived from kiosk.robots.embodiment.RobotDriver")
    if getattr(driver, "name", None) != extension.name:
        raise extension.broken(f"its class must have name = {extension.name!r}")
    if missing := sorted(driver.__abstractmethods__):
        raise extension.broken(f"its class lacks {', '.join(missing)}")
    return driver


def create_robot(settings: RobotSettings, language: str) -> RobotDriver | None:
    """Return the robot of these settings, not yet looked for; None if the avatar is to be alone.

    Raises UserInputError for a robot that is not installed or is broken, and for options that it does not take.
    """
    if settings.kind == NO_ROBOT:
        return None
    extension = find(ExtensionGroup.ROBOTS, settings.kind)
    driver = load_driver(extension)
    if settings.pack and Capability.CLIPS not in driver.capabilities:
        raise UserInputError(f"robot.pack: the driver {settings.kind} cannot have its robot play a voice pack's clips")
    try:
        driver.options.model_validate(settings.options)
    except ValidationError as error:
        sentences = validation_messages(error, settings.options, driver.options)
        raise UserInputError(*(f"robot.options: {sentence}" for sentence in sentences)) from error
    try:
        return driver(settings, language)
    except UserInputError:
        raise
    except Exception as error:
        raise extension.broken(f"{type(error).__name__}: {error}") from error


def check_robot(settings: Settings) -> None:
    """Raise UserInputError if the robot of a study file cannot be used; it is not looked for."""
    try:
        create_robot(settings.robot, settings.language_codes[0])
    except UserInputError as refusal:
        raise UserInputError(*(f"{settings.name}: {sentence}" for sentence in refusal.sentences)) from refusal
