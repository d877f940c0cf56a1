"""The notebook of the examples runs as it is written, and shows pictures and tables of every value."""

import re
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

NOTEBOOK = Path(__file__).parents[2] / "examples" / "notebook_first_finger.ipynb"


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Outputs of the code cells after a run: for each cell by its last line the texts by their kind."""
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=240, resources={"metadata": {"path": str(tmp_path_factory.mktemp("notebook"))}}
    )
    client.execute()
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    return {cell.source.splitlines()[-1]: [output.get("data", output) for output in cell.outputs] for cell in cells}


def test_the_committed_notebook_has_no_outputs():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.outputs for cell in code] == [[]] * len(code)
    assert {cell.execution_count for cell in code} == {None}


@pytest.mark.parametrize("value", ["geometry", "silicone", "mesh", "model", "solution", "response"])
def test_values_show_a_page_and_a_short_line(shown, value):
    data = shown[value][-1]  # the solve shows its progress before
    assert len(data["text/plain"]) < 500
    assert ("data:image/png;base64" in data["text/html"]) == (value != "model")
    assert len(data["text/html"]) < 300_000


def test_the_last_pages_say_what_came_out(shown):
    assert "solved to the end" in shown["solution"][-1]["text/html"]
    assert "bending angle [°]" in shown["response"][-1]["text/html"]


def test_units_of_the_columns(shown):
    (line,) = [texts for last, texts in shown.items() if last.startswith("print(f")]
    said = re.fullmatch(r"(.+) and (.+) deg at 8 kPa\n", line[0]["text"])
    assert said is not None
    assert said[1] == said[2]
    assert 2 < float(said[1]) < 30  # on a coarse mesh


def test_plots_and_pictures_are_shown(shown):
    for line in ('response.plot("cavity_volume", x="pressure")',
                 'tg.picture(solution, state=1, title="the first step", width=600)'):  # fmt: skip
        assert shown[line][-1]["image/png"]
