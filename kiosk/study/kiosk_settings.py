"""What belongs to one kiosk and lies beside a packed study, in a file of its own."""

from __future__ import annotations

from kiosk.config import ConfigModel, ExperimenterConfig


class _LocalRobot(ConfigModel):
    host: str | None = None
    port: int | None = None
    key: str | None = None


class _LocalScreen(ConfigModel):
    display: int | None = None
    operator_display: int | None = None


class _LocalVoice(ConfigModel):
    device: str | None = None


class LocalConfig(ConfigModel):
    """What belongs to one kiosk: its PIN and backups, its robot's address, its screen and its sound device."""

    file_kind = "file of this kiosk's settings"

    experimenter: ExperimenterConfig = ExperimenterConfig()
    robot: _LocalRobot = _LocalRobot()
    screen: _LocalScreen = _LocalScreen()
    voice: _LocalVoice = _LocalVoice()
