"""The screens of this machine, in the order in which a study file counts them."""

from __future__ import annotations

from PySide6.QtGui import QGuiApplication, QScreen


def numbered_screens() -> list[QScreen]:
    """All screens, the primary one first, the others in the system's order."""
    primary = QGuiApplication.primaryScreen()
    return [primary, *(screen for screen in QGuiApplication.screens() if screen is not primary)]
