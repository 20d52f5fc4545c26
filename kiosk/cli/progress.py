"""How far something long is, and how long it will still take."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn


class Tell(Protocol):
    """Is told how much is done; of how much, where that was not known before."""

    def __call__(self, done: int, of: int | None = None, /) -> None:
        """Draw it."""
        ...


@contextmanager
def progress_bar(what: str, total: int | None = None, *, hidden: bool) -> Iterator[Tell]:
    """A bar with rate and time left on the error stream; nothing without a terminal, or when ``hidden``."""
    columns = (
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    console = Console(stderr=True)
    with Progress(*columns, console=console, disable=hidden or not console.is_terminal, transient=True) as bar:
        task = bar.add_task(what, total=total, rate="")

        def tell(done: int, of: int | None = None, /) -> None:
            speed = bar.tasks[0].speed
            bar.update(task, completed=done, total=of, rate=f"{speed:,.0f}/s" if speed else "")

        yield tell
