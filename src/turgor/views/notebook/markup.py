"""Markup: small pieces of HTML for notebooks, with inline styles, so that they look alike in every program."""

from base64 import b64encode
from collections.abc import Sequence
from html import escape

from turgor.views.report.describe import Rows

#: Styles of the pieces. The text has the colors of the notebook, which may be dark.
_CARD = "font-size:13px;line-height:1.45;max-width:980px"
_TABLE = "border-collapse:collapse;margin:6px 0;font-size:13px"
_CELL = "text-align:left;vertical-align:top;padding:2px 14px 2px 0"
_NAME = "font-weight:600;white-space:nowrap"
_NUMBER = "text-align:right;padding:2px 0 2px 14px;white-space:nowrap;font-variant-numeric:tabular-nums"
_HEAD = "border-bottom:1px solid #8a93a0;font-weight:600;vertical-align:bottom"
_SCROLL = "overflow-x:auto"


def card(title: str, *parts: str, line: str = "") -> str:
    """Put pieces below a title, with a line about them.

    Parameters
    ----------
    title : str
        Heading of the card.
    *parts : str
        HTML; empty pieces are left out.
    line : str
        Text below the title.

    Returns
    -------
    str

    Examples
    --------
    >>> card("Mesh", line="12 cells")
    '<div style="font-size:13px;line-height:1.45;max-width:980px"><b>Mesh</b><div>12 cells</div></div>'
    """
    below = f"<div>{escape(line)}</div>" if line else ""
    return f'<div style="{_CARD}"><b>{escape(title)}</b>{below}{"".join(parts)}</div>'


def facts(rows: Rows) -> str:
    """Return a table of names and values, without rows whose value is empty."""
    cells = [
        f'<th style="{_CELL};{_NAME}">{escape(name)}</th><td style="{_CELL}">{_lines(value)}</td>'
        for name, value in rows
        if value
    ]
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    return f'<table style="{_TABLE}"><tbody>{body}</tbody></table>'


def numbers(head: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> str:
    """Return a table of numbers below the names of its columns, with a note below the table."""
    heads = "".join(f'<th style="{_NUMBER};{_HEAD};white-space:normal">{escape(name)}</th>' for name in head)
    lines = ["".join(f'<td style="{_NUMBER}">{escape(text)}</td>' for text in row) for row in rows]
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    table = f'<table style="{_TABLE}"><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>'
    return f'<div style="{_SCROLL}">{table}</div>' + (f"<div>{escape(note)}</div>" if note else "")


def image(png: bytes, what: str) -> str:
    """Return a PNG picture inside the page.

    Parameters
    ----------
    png : bytes
    what : str
        What the picture shows, for readers who cannot see it.
    """
    source = f"data:image/png;base64,{b64encode(png).decode()}"
    return f'<img alt="{escape(what)}" style="display:block;max-width:100%;height:auto;margin:6px 0" src="{source}">'


def _lines(value: str) -> str:
    return "<br>".join(map(escape, value.split("\n")))
