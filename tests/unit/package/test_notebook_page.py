"""The page of the notebook has its cells, and pictures that exist."""

import json
import re
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_the_page_of_the_notebook_has_the_cells_of_the_notebook():
    page = (ROOT / "docs" / "first-finger.md").read_text("utf-8")
    cells = json.loads((ROOT / "examples" / "notebook_first_finger.ipynb").read_text("utf-8"))["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    assert [block.strip() for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL)] == code
    assert [cell for cell in cells if cell["cell_type"] == "markdown" and "".join(cell["source"]) not in page] == []
    pictures = re.findall(r"!\[.*\]\((images/notebook/.*)\)", page)
    assert len(pictures) > 5
    assert {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs/images/notebook").iterdir()} == {
        *pictures
    }
