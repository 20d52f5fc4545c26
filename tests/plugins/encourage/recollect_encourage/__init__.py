"""An action of the assistant: it encourages the player, and points nowhere."""

from pathlib import Path

from kiosk.assistance.policy import ActionSpec, Precision

ENCOURAGE = ActionSpec(
    name="encourage",
    precision=Precision.NOTHING,
    needs_target=False,
    message="encourage",
    cost=0.01,
    sentences=Path(__file__).parent / "sentences",
)
