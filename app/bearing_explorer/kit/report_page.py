"""Frame of a report: an HTML page that needs no other file, and its head."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from urllib.parse import urlsplit

from bearing_explorer.kit.widgets.facts import html_text
from bearingcore.model.sweeps import program_version

_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


@dataclass(frozen=True)
class About:
    """Facts in the head of a report.

    `title`, `machine` and `remarks` are free text, and may be empty.
    """

    bearing: str
    link: str
    date: datetime
    title: str = ""
    machine: str = ""
    remarks: str = ""


def mark_of(figure_id: str) -> str:
    """Return the placeholder of a figure in the page."""
    return f"<!--figure {figure_id}-->"


def heading(about: About, title: str) -> list[str]:
    """Return the head of a report as HTML: title, machine, remarks, day, version and link."""
    when = about.date.strftime("%d %B %Y, %H:%M UTC")
    link = _link(about.link)
    return [
        f"<header><h1>{html_text(title)}</h1>",
        f"<p>Machine: {html_text(about.machine)}</p>" if about.machine.strip() else "",
        *(f"<p>{html_text(line)}</p>" for line in about.remarks.splitlines() if line.strip()),
        f"<p>{html_text(when)}, Bearing explorer "
        f"{html_text(program_version())}{f', {link}' if link else ''}</p></header>",
    ]


def document(about: About, title: str, body: Iterable[str], style_sheet: str) -> str:
    """Return a whole HTML page that fetches and runs nothing."""
    return (
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>"
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
        "<meta name='viewport' content='width=device-width, initial-scale=1'>"
        f"<title>{html_text(title)}, {html_text(about.date.strftime('%Y-%m-%d'))}</title>"
        f"<style>{style_sheet}</style></head><body>\n" + "\n".join(body) + "\n</body></html>\n"
    )


def _link(address: str) -> str:
    """Return a link to an address; empty if that is no web address."""
    try:
        parts = urlsplit(address)
    except ValueError:
        return ""
    if parts.scheme not in ("http", "https") or not parts.netloc:
        return ""
    return f"<a href='{html_text(address)}'>open this scene</a>"
