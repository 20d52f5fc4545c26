"""What mkdocs does not do by itself for the site: the list of pages, and links that leave the site."""

import posixpath
import re
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
            {title: [{name: page} for name, page in re.findall(r"^- \[(.+?)\]\(([^)]+\.md)\)", text, flags=re.M)]}
            for title, text in zip(sections[1::2], sections[2::2], strict=True)
        ),
    ]


def on_page_markdown(markdown: str, page: Any, **_others: Any) -> str:
    """Turn links to files of the checkout into their text, as the site goes without the checkout."""
    return inside_only(markdown, page.file.src_uri)


def inside_only(markdown: str, place: str) -> str:
    """Return a page, which stands at a place below the pages, without the links that leave the pages."""

    def kept(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(place), link[2]))
        return link[1] if target.startswith("..") else link[0]

    return re.sub(r"(?<!!)\[([^\]]+)\]\(([^):#]+)(?:#[^)]*)?\)", kept, markdown)
