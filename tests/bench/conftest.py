"""The benches of the window draw offscreen, like every test of it."""

from __future__ import annotations

from tests.ui.conftest import qapp_cls

__all__ = ["qapp_cls"]
