"""How the command line ends where something cannot be done: in one sentence, with a code that tells why."""

from __future__ import annotations

import errno
import os

import pytest

from kiosk import StorageError, UserInputError
from kiosk.cli import main


@pytest.mark.parametrize(
    ("failure", "code", "said"),
    [
        (UserInputError("one", "two"), 2, "recollect: one\nrecollect: two\n"),
        (
            StorageError("it cannot be used: disk full"),
            1,
            "recollect: it cannot be used: disk full\n",
        ),
        (
            OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "a.txt"),
            1,
            "recollect: a.txt cannot be written: disk full\n",
        ),
        (OSError(errno.EDQUOT, os.strerror(errno.EDQUOT)), 1, "recollect: disk full\n"),
    ],
    ids=lambda each: type(each).__name__,
)
def test_a_refusal_and_a_full_disk_end_with_a_sentence_and_their_own_codes(
    failure: Exception, code: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail() -> None:
        raise failure

    monkeypatch.setattr(main, "recollect", fail)
    with pytest.raises(SystemExit) as end:
        main.main()
    assert end.value.code == code
    assert capsys.readouterr().err == said


def test_a_fault_of_ours_is_not_called_a_full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> None:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    monkeypatch.setattr(main, "recollect", fail)
    with pytest.raises(PermissionError):
        main.main()
