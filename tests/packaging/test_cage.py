"""What started ``recollect-cage`` learns how the supervisor ended, though cage forgets it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE_S

SCRIPT = Path(__file__).parents[2] / "packaging" / "linux" / "recollect-cage"
CAGE = '#!/bin/sh\nwhile [ "$1" != -- ]; do shift; done\nshift\n"$@"\nexit 0\n'

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="cage is for Linux")


@pytest.mark.parametrize(
    ("supervisor", "code"),
    [
        ("exit 0", 0),
        ("exit 2", 2),
        ("exit 1", 1),
        ("kill -9 $$", 137),
        ('[ "$1$2$3$4" = "run--supervise--studya b" ]', 0),
    ],
)
def test_the_keepers_exit_code_is_told(tmp_path: Path, supervisor: str, code: int) -> None:
    assert ended(tmp_path, CAGE, supervisor) == code


def test_a_cage_that_breaks_is_no_good_end(tmp_path: Path) -> None:
    assert ended(tmp_path, "#!/bin/sh\nkill -9 $$\n", "exit 0") == 1


def test_a_supervisor_that_is_asked_to_end_is_waited_for_although_cage_is_gone(tmp_path: Path) -> None:
    gone_at_once = '#!/bin/sh\nwhile [ "$1" != -- ]; do shift; done\nshift\n"$@" &\nsleep 0.1\nkill $PPID\nexit 1\n'
    assert ended(tmp_path, gone_at_once, "sleep 0.4; exit 0") == 0


def ended(folder: Path, cage: str, supervisor: str) -> int:
    """Return the exit code with this cage, and this supervisor inside."""
    for name, text in (("cage", cage), ("recollect", f"#!/bin/sh\n{supervisor}\n")):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    environment = os.environ | {"PATH": f"{folder}:{os.environ['PATH']}", "TMPDIR": str(folder)}
    done = subprocess.run(
        ["/bin/sh", SCRIPT, "--study", "a b"], env=environment, capture_output=True, check=False, timeout=PATIENCE_S
    )
    assert sorted(path.name for path in folder.iterdir()) == ["cage", "recollect"]
    return done.returncode
