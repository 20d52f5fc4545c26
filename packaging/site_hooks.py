"""What mkdocs does not do by itself: the list of pages, links that leave the site, diagrams."""

import posixpath
import re
from collections import defaultdict
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

INDEX = "README.md"
"""The page with the list of all pages, in the folder of the pages."""


def on_config(config: dict[str, Any]) -> dict[str, Any]:
    """Take the list of pages from the index, which is the only place where it is written."""
    config["nav"] = navigation(Path(config["docs_dir"], INDEX).read_text("utf-8"))
    return config


def navigation(index: str) -> list[dict[str, Any]]:
    """Return mkdocs' navigation: the index, then each of its headings with the pages below it."""
    sections = re.split(r"^## (.+)$", index, flags=re.M)
    return [
        {"Recollect": INDEX},
        *(
            {
                title: [
                    {name.replace("`", ""): page}
                    for name, page in re.findall(r"^- \[(.+?)\]\(([^)]+\.md)\)", text, flags=re.M)
                ]
            }
            for title, text in zip(sections[1::2], sections[2::2], strict=True)
        ),
    ]


def on_page_markdown(markdown: str, page: Any, **_others: Any) -> str:
    """Draw diagrams, and turn links to files of the checkout into their text, as the site goes without the checkout."""
    drawn = re.sub(r"^```mermaid\n(.*?)^```$", lambda block: diagram(block[1]), markdown, flags=re.M | re.S)
    return inside_only(drawn, page.file.src_uri)


def inside_only(markdown: str, place: str) -> str:
    """Return a page, which stands at a place below the pages, without the links that leave the pages."""

    def kept(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(place), link[2]))
        return link[1] if target.startswith("..") else link[0]

    return re.sub(r"(?<!!)\[([^\]]+)\]\(([^):#]+)(?:#[^)]*)?\)", kept, markdown)


ROW, BOX, LEFT, WIDTH = 74, 34, 150, 150  # px: from stage to stage, height, left edge and width of a stage's box
STYLE = (
    "text{font:12px sans-serif;fill:currentColor} .stage{font-weight:bold;text-anchor:middle;font-size:14px}"
    " .left{text-anchor:end} rect,path{fill:none;stroke:currentColor;stroke-width:1.3} .more{opacity:.75}"
)


def diagram(mermaid: str) -> str:
    """Return a state diagram as SVG, as the site brings no script that would draw it.

    The stages stand in a column. Arrows to the next one are straight; others go around, forward on the right, back on
    the left. What a stage does with an event that leaves it where it is stands beside it.
    """
    arrows: dict[tuple[str, str], list[str]] = defaultdict(list)
    for start, end, event in re.findall(r"^ +(\S+) --> (\S+?)(?:: (.+))?$", mermaid, flags=re.M):
        arrows[start, end] += [event] if event else []
    stages = list(_in_order(list(arrows)))
    lines = [f"<rect x='{LEFT}' y='{ROW * k + 10}' width='{WIDTH}' height='{BOX}' rx='8'/>" for k in range(len(stages))]
    lines += [
        f"<text class='stage' x='{LEFT + WIDTH // 2}' y='{ROW * k + 32}'>{escape(stage)}</text>"
        for k, stage in enumerate(stages)
    ]
    for (start, end), events in arrows.items():
        if "[*]" not in {start, end}:
            lines += _arrow(stages.index(start), stages.index(end), [escape(event) for event in events])
    notes = re.findall(r"^ {8}(.+)$", mermaid, flags=re.M)
    told = "".join(f"<li>{escape(note.rstrip(';'))}</li>" for note in notes)
    return (
        f"<svg viewBox='0 0 900 {ROW * len(stages)}' role='img' aria-label='The stages of a session'>"
        f"<style>{STYLE}</style><defs><marker id='tip' viewBox='0 0 8 8' refX='7' refY='4' markerWidth='8'"
        " markerHeight='8' orient='auto'><path d='M0,0 L8,4 L0,8 z' style='fill:currentColor'/></marker></defs>"
        f"{''.join(lines)}</svg><ul>{told}</ul>\n"
    )


def _in_order(arrows: list[tuple[str, str]]) -> Iterator[str]:
    """Yield the stages in the order in which a session that leaves none out goes through them."""
    at = "[*]"
    seen = {at}
    while True:
        ends = [end for start, end in arrows if start == at and end not in seen]
        if not ends:
            return
        # Of two ways on, the longer one leads through the stage from which the other can still be reached.
        at = next((end for end in ends if all((end, other) in arrows for other in ends if other != end)), ends[0])
        seen.add(at)
        yield at


def _arrow(start: int, end: int, events: list[str]) -> Iterator[str]:
    """Yield the arrow between two stages, given by their places in the column, and its words."""
    right, middle = LEFT + WIDTH, BOX // 2 + 10
    words = ", ".join(events)
    if start == end:
        yield f"<text class='more' x='{right + 12}' y='{ROW * start + middle + 4}'>{words}</text>"
    elif end == start + 1:
        x, y = LEFT + WIDTH // 2, ROW * start + 10 + BOX
        yield f"<path d='M{x},{y} L{x},{ROW * end + 8}' marker-end='url(#tip)'/>"
        yield f"<text x='{x + 8}' y='{y + 24}'>{words}</text>"
    else:
        down = end > start
        x, out = (right, right + 480 + 50 * (end - start)) if down else (LEFT, LEFT - 60 - 20 * (start - end))
        shift = 9 if down else -9  # the words of a stage stand at its middle
        a, b = ROW * start + middle + shift, ROW * end + middle + shift
        yield f"<path d='M{x},{a} C{out},{a} {out},{b} {x},{b}' marker-end='url(#tip)'/>"
        at = (x + 3 * out) / 4 + (8 if down else -8)
        yield f"<text class='{'right' if down else 'left'}' x='{at:.0f}' y='{(a + b) / 2 + 4:.0f}'>{words}</text>"
