"""Write the tables of docs/materials.md between their marks, and the pictures of all rubbers.

Call it as ``python docs/materials_page.py``, after a change of the library.
"""

import re
from pathlib import Path

from PIL import Image

import turgor as tg

DOCS = Path(__file__).parent
PAGE = DOCS / "materials.md"
PICTURES = DOCS / "images" / "materials"

#: Rubbers in one picture: four rows of three.
PANELS = 12


def panels() -> str:
    """Draw all rubbers, softest first, and return the lines that show the pictures."""
    rubbers = [row for row in tg.laws.material_rows() if row.kind == "rubber" and row.modulus and row.modulus < 1e9]
    names = [row.name for row in sorted(rubbers, key=lambda row: row.modulus or 0.0)]
    PICTURES.mkdir(parents=True, exist_ok=True)
    lines = []
    for number, first in enumerate(range(0, len(names), PANELS), start=1):
        part = names[first : first + PANELS]
        file = PICTURES / f"rubbers-{number}.png"
        tg.pictures.material_panels(part).savefig(file, dpi=110)
        with Image.open(file) as picture:
            small = picture.convert("RGB").quantize(64)
        small.save(file, optimize=True)
        lines.append(f"![Stress over stretch of {part[0]} to {part[-1]}](images/materials/{file.name})\n")
    return "\n".join(lines)


def main() -> None:
    """Replace what stands between ``<!-- NAME -->`` and ``<!-- end -->``."""
    parts = {**tg.laws.library_tables(), "curves": panels()}
    page = PAGE.read_text(encoding="utf-8")
    for name, text in parts.items():
        mark = f"<!-- {name} -->"
        page, count = re.subn(
            rf"{mark}\n.*?<!-- end -->", lambda _, new=f"{mark}\n{text}<!-- end -->": new, page, flags=re.DOTALL
        )
        assert count == 1, name
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
