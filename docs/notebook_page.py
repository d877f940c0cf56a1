"""Write docs/first-finger.md: the notebook of the examples with what each cell shows, and its pictures.

Run it after a change of the notebook or of how values are displayed: ``python docs/notebook_page.py``, about a minute.
It needs the packages of the extra ``dev``.
"""

import re
from base64 import b64decode
from io import BytesIO
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient
from PIL import Image

DOCS = Path(__file__).parent
NOTEBOOK = DOCS.parent / "examples" / "notebook_first_finger.ipynb"
PICTURES = DOCS / "images" / "notebook"
PAGE = DOCS / "first-finger.md"

#: A picture within the page that a value shows.
EMBEDDED = re.compile(r'<img alt="([^"]*)"[^>]*src="data:image/png;base64,([^"]*)"[^>]*>')

INTRODUCTION = """This page is a [notebook](https://jupyter.org) with the outputs of its cells. The file is
`examples/notebook_first_finger.ipynb`.
"""


def picture(alt: str, encoded: str) -> str:
    """Write a picture in few colors, and return the line of the page that shows it."""
    path = PICTURES / f"{len(list(PICTURES.glob('*.png'))) + 1:02}.png"
    image = Image.open(BytesIO(b64decode(encoded))).convert("RGB").quantize(64, dither=Image.Dither.NONE)
    image.save(path, optimize=True)
    return f"![{alt}]({path.relative_to(DOCS).as_posix()})"


def shown(output: Any) -> list[str]:
    """Return the blocks of the page for one output of a cell."""
    if output.output_type == "stream":
        return [f"```text\n{output.text.strip()}\n```"]
    if "image/png" in output.data:
        return [picture(output.data["text/plain"].strip("<>"), output.data["image/png"])]
    html = output.data.get("text/html")
    if html is None:
        return [f"```text\n{output.data['text/plain']}\n```"]
    pictures = [picture(alt, encoded) for alt, encoded in EMBEDDED.findall(html)]
    text = re.sub(r"\n\s*\n", "\n", EMBEDDED.sub("", html)).strip()
    return [*pictures, text] if text else pictures


def blocks(cell: Any) -> list[str]:
    """Return the blocks of the page for one cell."""
    if cell.cell_type == "markdown":
        return [cell.source]
    return [f"```python\n{cell.source}\n```", *(block for output in cell.outputs for block in shown(output))]


def main() -> None:
    """Run the notebook; write the page and its pictures."""
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(notebook, timeout=300).execute()
    PICTURES.mkdir(exist_ok=True)
    for old in PICTURES.glob("*.png"):
        old.unlink()
    title, *others = [block for cell in notebook.cells for block in blocks(cell)]
    PAGE.write_text("\n\n".join([title, INTRODUCTION.strip(), *others]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
