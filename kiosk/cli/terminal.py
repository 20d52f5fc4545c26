"""What a terminal shows and takes.

Texts of studies, visitors, robots and brokers neither steer it nor stand for markup. What was typed before a question
came is no answer to it.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, TextIO

import click

if TYPE_CHECKING:
    from rich.console import Console

_STEERING = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069]")
"""Control characters, ends of lines that few know, and what turns the direction of text around."""


def harmless(text: str) -> str:
    r"""Return a text in which characters that would steer a terminal stand by their numbers, as \x1b."""
    return _STEERING.sub(lambda found: ascii(found[0])[1:-1], text)


def one_line(text: str) -> str:
    """Return a harmless text without ends of lines, after which words could pass for the program's own."""
    return harmless(" ".join(text.splitlines()))


def counted(number: int, one: str) -> str:
    """Return a number with its noun, which gets an s unless the number is 1."""
    return f"{number:,} {one}" if number == 1 else f"{number:,} {one}s"


def tell_line(text: str, *, err: bool = False) -> None:
    """Print a text on one line, whatever it quotes of a study, a record or a path."""
    click.echo(one_line(text), err=err)


def tell_caution(what: object, *, err: bool = False) -> None:
    """Print a caution on one line, whatever it quotes of a study or a record."""
    tell_line(f"caution: {what}", err=err)


def confirm(question: str, *, default: bool = False) -> bool:
    """Ask a question that is answered by yes or no, after all that is printed."""
    drop_typed_ahead()
    return click.confirm(question, default=default, err=True)


def drop_typed_ahead() -> None:
    """Forget what was typed at the terminal and not read yet.

    Input from a pipe or a file was written for the questions that come, and stays.
    """
    if sys.stdin is None or sys.stdin.closed or not sys.stdin.isatty():
        return
    if sys.platform == "win32":
        import msvcrt  # noqa: PLC0415 - there is none elsewhere

        while msvcrt.kbhit():
            msvcrt.getwch()
    else:
        import termios  # noqa: PLC0415 - there is none on Windows

        termios.tcflush(sys.stdin.fileno(), termios.TCIFLUSH)


class HarmlessStream:
    """A text stream that prints what would steer the terminal by its number."""

    def __init__(self, stream: TextIO) -> None:
        """Print to this stream."""
        self.rich_proxied_file = stream
        """What rich draws on, whose own colours and movements must get through."""

    def __getattr__(self, name: str) -> Any:
        """Return everything else that the stream has; but no way around it."""
        if name == "buffer":
            raise AttributeError(name)
        return getattr(self.rich_proxied_file, name)

    def write(self, text: str) -> int:
        """Write a text."""
        self.rich_proxied_file.write(harmless(text))
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        """Write texts, one after another."""
        for line in lines:
            self.write(line)

    def __iter__(self) -> Iterator[str]:
        """Read lines, if the stream can be read."""
        return iter(self.rich_proxied_file)


def console(*, stderr: bool = False, least_width: int = 0) -> Console:
    """Return what draws tables and bars, and takes nothing in their texts for markup or an emoji's name.

    Without a terminal, or in a narrow window, lines may be as long as ``least_width``, so that no word is cut.
    """
    from rich.console import Console, ConsoleOptions, RenderableType  # noqa: PLC0415 - most commands draw nothing
    from rich.segment import Segment  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    class HarmlessConsole(Console):
        def render_str(self, text: str, **given: Any) -> Text:
            return super().render_str(harmless(text), **given)

        def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterator[Segment]:
            for segment in super().render(renderable, options):
                # What moves the terminal is rich's own, and stands in segments of its own.
                yield segment if segment.control else Segment(harmless(segment.text), segment.style)

    drawn = HarmlessConsole(stderr=stderr, markup=False, emoji=False, highlight=False)
    drawn.width = max(drawn.width, least_width)
    return drawn
