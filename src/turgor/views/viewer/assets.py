"""Assets: scripts, style and markup of the viewer, as texts; this file loads nothing else of turgor."""

from functools import cache
from importlib.resources import files

#: Scripts of the viewer in the order in which they stand in a page.
SCRIPTS = (
    "1_unpack.js", "2_skin.js", "3_stage.js", "4_body.js", "5_section.js", "6_chart.js", "7_linked.js", "8_overlay.js",
    "8_parts.js", "9_viewer.js",
)  # fmt: skip


#: Where the values stand in the markup.
PLACE = "{{ values | safe }}"


def viewer_markup_of(values: str) -> str:
    """Return the element of the viewer with its data as JSON."""
    return _text("page/viewer.html").replace(PLACE, values)


def viewer_frame() -> str:
    """Return the element of the viewer without data, for a page that mounts it itself."""
    return _text("page/viewer.html").replace(f'<script type="application/json">{PLACE}</script>\n', "")


def viewer_style() -> str:
    """Return the style of the viewer."""
    return _text("page/viewer.css")


@cache
def viewer_scripts() -> str:
    """Return the scripts of the viewer and of the library that it draws with, as one text."""
    own = "".join(_text(f"page/{name}") for name in SCRIPTS)
    return f'{_text("vendor/three.min.js")}\n(() => {{\n"use strict";\n{own}}})();\n'


def _text(name: str) -> str:
    return files("turgor.views.viewer").joinpath(name).read_text(encoding="utf-8")
