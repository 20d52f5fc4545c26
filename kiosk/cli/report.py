"""The command that analyses an exported data set, under a plan, into one page."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.cli.calibrate import analysis
from kiosk.cli.options import json_option
from kiosk.export.layouts import new_folder, write_text
from kiosk.files import check_writable, write_file

PAGE = Path("report.html")


@click.command()
@click.argument("export", type=click.Path(path_type=Path), required=False)
@click.option(
    "--plan",
    type=click.Path(path_type=Path, dir_okay=False),
    help="The plan; by default the one that was frozen with the data, or else the template.",
)
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    help=f"An HTML file, or a new folder for everything; by default {PAGE} unless --json is given.",
)
@click.option(
    "--exclude",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Declared exclusions: a CSV file with the columns participant_id and reason.",
)
@click.option("--paper", is_flag=True, help="Work the paper's own numbers out again; needs no EXPORT.")
@json_option
def report_command(
    export: Path | None, plan: Path | None, out: Path | None, exclude: Path | None, *, paper: bool, as_json: bool
) -> None:
    """Analyse an exported data set: who took part, every test, figures, and tables for a paper.

    See docs/report.md.
    """
    if export is None and not paper:
        raise UserInputError("a report needs the folder of an exported data set, or --paper")
    if export is None and (plan is not None or exclude is not None):
        raise UserInputError("--plan and --exclude are about a data set; name its folder")
    if out is None and not as_json:
        out = PAGE
    if out is not None and _is_page(out):
        check_writable(out)
    found = _analysed(export, plan, exclude) if export is not None else None
    document: dict[str, Any] = analysis("report").report_json(found) if found is not None else {}
    if paper:
        document["paper"] = analysis("paper").paper_json()
    if out is not None:
        pages = analysis("report_page")
        page = pages.report_page(found, with_paper=paper) if found is not None else pages.paper_page()
        _write(out, page, document)
    if as_json:
        click.echo(json.dumps(document))
        return
    click.echo(_in_words(document))
    click.echo(f"Written: {out}")


def _analysed(export: Path, plan: Path | None, exclude: Path | None) -> Any:
    declared = analysis("sample").read_exclusions(exclude) if exclude is not None else {}
    return analysis("report").make_report(analysis("data").load_study(export), plan, declared)


def _is_page(out: Path) -> bool:
    return out.suffix.lower() in {".html", ".htm"}


def _write(out: Path, page: Any, document: dict[str, Any]) -> None:
    """Write the page into its file, or the page, its parts and all numbers into a new folder."""
    module = analysis("page")
    if _is_page(out):
        write_file(out, module.to_html(page))
        return
    with new_folder(out) as folder:
        write_text(folder / "report.html", module.to_html(page))
        write_text(folder / "report.md", module.to_markdown(page))
        write_text(folder / "results.json", json.dumps(document, indent=1) + "\n")
        for table in module.tables(page):
            write_text(folder / "tables" / f"{table.id}.csv", module.csv_table(table))
            write_text(folder / "tables" / f"{table.id}.tex", module.latex_table(table) + "\n")
        for picture in module.all_pictures(page):
            write_text(folder / "figures" / f"{picture.id}.svg", picture.svg)


def _in_words(document: dict[str, Any]) -> str:
    if "status" not in document:
        rows = document["paper"]
        return "\n".join(f"{row['measure']:<28}t({row['df']}) = {row['t']:.2f}, p = {row['p']:.3f}" for row in rows)
    lines = [f"{document['status']}: {document['reason']}."]
    lines += [f"  {name}: {n} analysed" for name, n in document["analysed"].items()]
    for each in document["hypotheses"]:
        p = "" if each["corrected"] is None else f"corrected p = {each['corrected']:.4f}, "
        lines.append(f"{each['id']:<20}{p}{each['verdict']}")
    return "\n".join(lines)
