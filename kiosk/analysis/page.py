"""Pages made of sections, tables and figures: one HTML file without outside requests, Markdown, CSV and LaTeX."""

from __future__ import annotations

import csv
import html
import io
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import matplotlib as mpl
from matplotlib.figure import Figure

from kiosk.analysis.policy_figures import STYLE
from kiosk.config import ASSETS

CSS = ASSETS / "report" / "page.css"
SHORT = 16
"""A table of so many rows is not broken over two sheets of paper."""
MINUS = "\N{MINUS SIGN}"
NOTHING = "\N{EN DASH}"
"""Stands in a cell that has no number."""


@dataclass(frozen=True)
class ReportTable:
    """A table; the first cell of each row is its head."""

    id: str
    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


@dataclass(frozen=True)
class Picture:
    """A drawing as SVG; ``alt`` says in words what is seen."""

    id: str
    caption: str
    svg: str
    alt: str
    wide: bool = False


@dataclass(frozen=True)
class Gallery:
    """Small drawings side by side under one caption."""

    id: str
    caption: str
    pictures: tuple[Picture, ...]


@dataclass(frozen=True)
class DataSource:
    """A text to be copied."""

    label: str
    text: str


Block = str | ReportTable | Picture | Gallery | DataSource
"""A part of a section; a text is a paragraph."""


@dataclass(frozen=True)
class Section:
    """A part of a page, with its name in links."""

    id: str
    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class ReportPage:
    """A page; ``badge`` is printed on every sheet, and ``facts`` are pairs of a name and a value."""

    title: str
    badge: str
    badge_reason: str
    facts: tuple[tuple[str, str], ...]
    sections: tuple[Section, ...]


# Numbers


def number(value: float | None, digits: int = 2) -> str:
    """Return a number as it is read, with a true minus sign; a dash where there is none."""
    if value is None or math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return ("" if value > 0 else MINUS) + "\N{INFINITY}"
    shown = f"{value:.{digits}f}"
    return MINUS + shown[1:] if shown.startswith("-") and float(shown) else shown.removeprefix("-")


def p_value(p: float) -> str:
    """Return a p value as APA has it: without the zero, and never less than .001."""
    if math.isnan(p):
        return NOTHING
    return "< .001" if p < 0.001 else f"{p:.3f}".removeprefix("0")  # noqa: PLR2004 - APA's smallest p


def interval(low: float, high: float, digits: int = 2) -> str:
    """Return an interval in brackets."""
    return NOTHING if math.isnan(low) and math.isnan(high) else f"[{number(low, digits)}, {number(high, digits)}]"


def factor(value: float) -> str:
    """Return a Bayes factor, in three figures."""
    if math.isnan(value):
        return NOTHING
    return f"{value:.3g}" if 0.001 <= value < 1000 else f"{value:.1e}"  # noqa: PLR2004 - readable up to there


# HTML


def to_html(page: ReportPage) -> str:
    """Return the page as one HTML file; it asks for nothing outside itself, and prints."""
    counts = {"Table": 0, "Figure": 0}
    body = "".join(_section(section, counts) for section in page.sections)
    links = "".join(f'<li><a href="#{each.id}">{html.escape(each.title)}</a></li>' for each in page.sections)
    facts = "".join(
        f"<div><dt>{html.escape(name)}</dt><dd>{html.escape(value)}</dd></div>" for name, value in page.facts
    )
    kind = page.badge.lower()
    sheet = f'@page{{@top-right{{content:"{page.badge}"}}}}'
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(page.title)}</title>\n<style>{CSS.read_text('utf-8')}{sheet}</style></head>\n"
        f'<body><a class="skip" href="#content">Skip to the report</a>\n<header><p class="badge {kind}">'
        f"<strong>{page.badge}</strong> <span>{html.escape(page.badge_reason)}</span></p>\n"
        f"<h1>{html.escape(page.title)}</h1>\n<dl>{facts}</dl></header>\n"
        f'<nav aria-label="Contents"><details open><summary>Contents</summary><ol>{links}</ol></details></nav>\n'
        f'<main id="content">{body}</main></body></html>\n'
    )


def _section(section: Section, counts: dict[str, int]) -> str:
    blocks = "".join(_block(block, counts) for block in section.blocks)
    return f'\n<section id="{section.id}" aria-labelledby="{section.id}-title">\n<h2 id="{section.id}-title">' + (
        f"{html.escape(section.title)}</h2>\n{blocks}</section>"
    )


def _block(block: Block, counts: dict[str, int]) -> str:
    match block:
        case str():
            return f"<p>{html.escape(block)}</p>\n"
        case ReportTable():
            counts["Table"] += 1
            return _table(block, f"Table {counts['Table']}. ")
        case DataSource():
            return (
                f"<details class=source><summary>{html.escape(block.label)}</summary>"
                f'<pre tabindex="0" role="region" aria-label="{html.escape(block.label)}">'
                f"{html.escape(block.text)}</pre>"
                "</details>\n"
            )
    counts["Figure"] += 1
    label = f"<strong>Figure {counts['Figure']}.</strong> {html.escape(block.caption)}"
    if isinstance(block, Picture):
        wide = ' class="wide"' if block.wide else ""
        return f'<figure id="{block.id}"{wide}>{_drawing(block)}<figcaption>{label}</figcaption></figure>\n'
    drawings = "".join(_drawing(each) for each in block.pictures)
    return f'<figure id="{block.id}"><div class="gallery">{drawings}</div><figcaption>{label}</figcaption></figure>\n'


def _drawing(picture: Picture) -> str:
    """Return the drawing in the page; a wide one can be moved sideways where it does not fit."""
    named = f'<svg role="img" aria-label="{html.escape(picture.alt)}" '
    drawn = picture.svg.replace("<svg ", named, 1)
    if not picture.wide:
        return f'<div class="drawing">{drawn}</div>'
    return f'<div class="scroll" tabindex="0" role="region" aria-label="{html.escape(picture.caption)}">{drawn}</div>'


_NUMBERS = re.compile(r"[tUWF]?[\[\]()\d.,%<=\s/e+-]*")


def _table(table: ReportTable, label: str) -> str:
    numeric = [all(_is_numeric(row[at]) for row in table.rows) for at in range(len(table.head))]
    numeric[0] = False
    heads = "".join(
        f'<th scope="col"{_class(right)}>{html.escape(cell)}</th>'
        for cell, right in zip(table.head, numeric, strict=True)
    )
    rows = "".join(
        f'<tr><th scope="row">{html.escape(first)}</th>'
        + "".join(f"<td{_class(right)}>{html.escape(cell)}</td>" for cell, right in zip(rest, numeric[1:], strict=True))
        + "</tr>\n"
        for first, *rest in table.rows
    )
    named = f"<strong>{label}</strong>{html.escape(table.caption)}"
    caption = f'<caption id="{table.id}-caption"><span>{named}</span></caption>'
    note = f'<p class="note">{html.escape(table.note)}</p>' if table.note else ""
    short = " short" if len(table.rows) <= SHORT else ""
    return (
        f'<div class="table{short}" id="{table.id}"><div class="scroll" role="region" tabindex="0" '
        f'aria-labelledby="{table.id}-caption"><table>{caption}\n<thead><tr>{heads}</tr></thead>\n'
        f"<tbody>{rows}</tbody></table></div>{note}</div>\n"
    )


def _is_numeric(cell: str) -> bool:
    return _NUMBERS.fullmatch(cell.replace(MINUS, "-").replace(NOTHING, "-").replace("\N{INFINITY}", "-")) is not None


def _class(right: bool) -> str:  # noqa: FBT001 - one column's kind
    return " class=num" if right else ""


# Other forms


def to_markdown(page: ReportPage) -> str:
    """Return the page as Markdown; figures are named, not drawn."""
    lines = [f"# {_escaped(page.title)}", "", f"**{page.badge}**: {_escaped(page.badge_reason)}.", ""]
    lines += [f"- {_escaped(name)}: {_escaped(value)}" for name, value in page.facts]
    for section in page.sections:
        lines += ["", f"## {_escaped(section.title)}"]
        for block in section.blocks:
            lines += ["", *_markdown(block)]
    return "\n".join(lines) + "\n"


def _markdown(block: Block) -> Iterator[str]:
    match block:
        case str():
            yield _escaped(block)
        case ReportTable():
            yield f"*{_escaped(block.caption)}*"
            yield ""
            yield from markdown_table(block).splitlines()
            if block.note:
                yield from ("", _escaped(block.note))
        case DataSource():
            yield from (f"{_escaped(block.label)}:", "", "```", *block.text.splitlines(), "```")
        case Picture():
            yield f"![{_escaped(block.alt)}](figures/{block.id}.svg)"
        case Gallery():
            yield from (f"![{_escaped(each.alt)}](figures/{each.id}.svg)" for each in block.pictures)


def _escaped(text: str) -> str:
    return re.sub(r"([\\`*_<\[\]|])", r"\\\1", text)


def markdown_table(table: ReportTable) -> str:
    """Return a table in Markdown."""
    rows = [table.head, ("---",) * len(table.head), *table.rows]
    cells = [[cell if row is rows[1] else _escaped(cell) for cell in row] for row in rows]
    return "\n".join(f"| {' | '.join(row)} |" for row in cells)


_LATEX = {"\\": r"\textbackslash{}", MINUS: "$-$", NOTHING: "--", "<": "$<$", ">": "$>$", "\N{INFINITY}": r"$\infty$"}
_LATEX |= {each: "\\" + each for each in "&%$#_{}"} | {"~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}


def latex_table(table: ReportTable) -> str:
    """Return a table in LaTeX, with the rules of the package booktabs."""
    columns = "l" + "r" * (len(table.head) - 1)
    rows = [" & ".join(_latex(cell) for cell in row) + r" \\" for row in table.rows]
    head = " & ".join(_latex(cell) for cell in table.head) + r" \\"
    return "\n".join(
        [
            r"\begin{table}",
            rf"\caption{{{_latex(table.caption)}}}",
            rf"\label{{tab:{table.id}}}",
            rf"\begin{{tabular}}{{{columns}}}",
            *(r"\toprule", head, r"\midrule"),
            *rows,
            r"\bottomrule",
            r"\end{tabular}",
            *([rf"\\[2pt] \footnotesize {_latex(table.note)}"] if table.note else []),
            r"\end{table}",
        ]
    )


def _latex(text: str) -> str:
    return "".join(_LATEX.get(each, each) for each in text)


def csv_table(table: ReportTable) -> str:
    """Return a table as CSV, with plain minus signs and empty cells where there is nothing."""
    written = io.StringIO()
    writer = csv.writer(written, lineterminator="\r\n")
    writer.writerow(table.head)
    for row in table.rows:
        writer.writerow("" if cell == NOTHING else cell.replace(MINUS, "-") for cell in row)
    return written.getvalue()


def tables(page: ReportPage) -> Iterator[ReportTable]:
    """All tables of a page."""
    yield from (block for section in page.sections for block in section.blocks if isinstance(block, ReportTable))


def all_pictures(page: ReportPage) -> Iterator[Picture]:
    """All drawings of a page."""
    for section in page.sections:
        for block in section.blocks:
            if isinstance(block, Picture):
                yield block
            elif isinstance(block, Gallery):
                yield from block.pictures


# Drawings


def svg_of(figure: Figure, name: str) -> str:
    """Return a figure as SVG that scales with its place in a page.

    No two drawings share an id, as ``name`` begins each.
    """
    with mpl.rc_context(STYLE):
        drawn = io.StringIO()
        figure.savefig(drawn, format="svg", metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    picture = drawn.getvalue()
    picture = picture[picture.index("<svg") :]
    picture = re.sub(r"<metadata>.*?</metadata>\s*", "", picture, flags=re.DOTALL)
    picture = re.sub(r'(<svg[^>]*?) (?:width|height)="[^"]*"', r"\1", picture, count=1)
    picture = re.sub(r'(<svg[^>]*?) (?:width|height)="[^"]*"', r"\1", picture, count=1)
    picture = re.sub(r'\bid="', f'id="{name}-', picture)
    return re.sub(r'(href="|url\()#', rf"\1#{name}-", picture)


def boxes_svg(size: tuple[int, int], parts: Iterable[str]) -> str:
    """Return a drawing of boxes and lines of this width and height."""
    width, height = size
    limits = f"min-width:{round(0.85 * width)}px;max-width:{width}px"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" style="{limits}">'
    return f"{head}{''.join(parts)}</svg>"


def box(place: tuple[float, float, float], lines: Sequence[str], colour: str = "#444") -> tuple[str, float]:
    """Return a box at left, top and of a width, with its lines of text; and its height.

    The first line is bold.
    """
    left, top, width = place
    height = 14.0 + 17 * len(lines)
    texts = ""
    for at, line in enumerate(lines):
        weight = "" if at else ' font-weight="600"'
        y = top + 20 + 17 * at
        texts += f'<text x="{left + 10:g}" y="{y:g}" font-size="12.5"{weight} fill="#1a1a1a">{html.escape(line)}</text>'
    frame = (
        f'<rect x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" rx="4" fill="#fff" stroke="{colour}"/>'
    )
    return frame + texts, height


def arrow(start: tuple[float, float], end: tuple[float, float]) -> str:
    """Return a line from one point to another, with a head at its end; upright or level."""
    (x1, y1), (x2, y2) = start, end
    head = (
        f"{x2 - 4:g},{y2 - 6:g} {x2 + 4:g},{y2 - 6:g} {x2:g},{y2:g}"
        if x1 == x2
        else f"{x2 - 6:g},{y2 - 4:g} {x2 - 6:g},{y2 + 4:g} {x2:g},{y2:g}"
    )
    line = f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" stroke="#444"/>'
    return f'{line}<polygon points="{head}" fill="#444"/>'
