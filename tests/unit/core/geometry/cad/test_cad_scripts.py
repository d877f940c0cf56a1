"""Parts that scripts draw and tables list: their dimensions are checked, and errors say where they arose."""

from pathlib import Path

import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.parametric import drawn
from turgor.core.geometry.cad.parametric.drawn import checksum, dimensions_of, files_of, part_file
from turgor.foundation.store.cached_values import Cache
from turgor.units import mm

DRAW = """
from typing import Annotated

from netgen.occ import Box, Pnt


def build(side: Annotated[float, "mm", (1, 40)] = 10, height=20, count: int = 1, lid: bool = True, kind="a", shift=-1):
    print("drawing")
    return Box(Pnt(shift, 0, 0), Pnt(side + shift, side, height))
"""


@pytest.fixture
def script(tmp_path):
    path = tmp_path / "block.py"
    path.write_text(DRAW)
    return path


def part(path, **given):
    return tg.cad.CadFile(file=path, **given)


def test_dimensions_reach_the_function_in_millimeters_or_in_the_unit_of_the_part(script):
    """A block of 8 x 8 x 15 mm; a height of 1 in is 1 where the part is in inches."""
    geometry = part(script, dimensions={"side": "0.8 cm", "height": "15 mm"}).build()
    assert geometry.solid_volume / mm**3 == pytest.approx(8 * 8 * 15)
    given = drawn.check_dimensions(script, "build", {"side": "8 mm", "height": "25.4 mm"}, "in")
    assert given == {"side": 8.0, "height": 1.0}


@pytest.mark.parametrize(
    ("stated", "facts"),
    [
        ({"side": "50 mm"}, ("side", "50 mm", "1 mm to 40 mm")),
        ({"side": 8.0}, ("side", "unit", "8.0 mm")),
        ({"side": "8 deg"}, ("side", "angle", "length")),
        ({"height": "15 mmm"}, ("height", "15 mmm", "'mm'")),
        ({"height": "-15 mm"}, ("height", "-15 mm", "positive")),
        ({"height": "tall"}, ("height", "tall")),
        ({"height": True}, ("height", "true")),
        ({"count": 1.5}, ("count", 1.5, "whole number")),
        ({"lid": 1}, ("lid", "true")),
        ({"kind": 3}, ("kind", "text")),
        ({"heigth": "15 mm"}, ("heigth", "'height'", "block.py", "side", "count")),
    ],
)
def test_dimensions_are_checked_before_the_script_runs(script, stated, facts):
    with refused(*facts):
        part(script, dimensions=stated)


def test_a_default_that_is_negative_allows_negative_lengths(script):
    assert drawn.check_dimensions(script, "build", {"shift": "-3 mm"}) == {"shift": -3.0}


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("def build(side=1:\n    pass\n", ("line 1", "Python")),
        ("def biuld():\n    pass\n", ("'build'", "'biuld'")),
        ("side = 1\n", ("'build'", "has none")),
        ("def build(side, /):\n    pass\n", ("'build'",)),
        ('def build(side: Annotated[float, "mmm"]):\n    pass\n', ("line 1", "side", "'mmm'", "'mm'")),
        ('def build(side: Annotated[float, "mm", (3, 1)]):\n    pass\n', ("side", "(3, 1)")),
        ("def build(side):\n    pass\n", ("needs side", "[actuator.dimensions]")),
    ],
)
def test_scripts_without_such_a_function_are_refused_unrun(tmp_path, text, facts):
    path = tmp_path / "wrong.py"
    path.write_text(text)
    with refused("wrong.py", *facts):
        part(path)


@pytest.mark.parametrize(
    ("body", "facts"),
    [
        ("raise ValueError('too thin')", ("line 2", "build", "ValueError: too thin")),
        ("pass", ("nothing", "build123d")),
        ("return 3", ("int", "build123d")),
        ("return 'no.step'", ("no.step",)),
        ("import sys; sys.exit(3)", ("line 2", "SystemExit")),
        ("import os; os.abort()", ("died", "SIGABRT")),
        ("import buildd123", ("line 2", "buildd123", "Install")),
    ],
)
def test_what_goes_wrong_in_a_script_is_told_with_line_and_dimensions(tmp_path, body, facts):
    path = tmp_path / "wrong.py"
    path.write_text(f"def build(side=1):\n    {body}\n")
    with refused("wrong.py", "side = 2 mm", *facts), part_file(path, stated={"side": "2 mm"}):
        pass


def test_a_part_is_drawn_once_for_a_text_and_its_dimensions(script, monkeypatch):
    calls = []
    run = drawn.in_child
    monkeypatch.setattr(drawn, "in_child", lambda *given: calls.append(given) or run(*given))
    monkeypatch.setattr(drawn, "PARTS", Cache("parts", 1e6))
    with part_file(script, stated={"side": "7 mm"}) as first:
        text = first.read_bytes()
    with part_file(script, stated={"side": "0.7 cm"}) as again:
        assert again.read_bytes() == text
    assert len(calls) == 1
    script.write_text(DRAW + "\n# another text\n")
    with part_file(script, stated={"side": "7 mm"}):
        assert len(calls) == 2


def test_a_script_that_reads_a_file_of_its_folder_is_run_each_time(tmp_path, monkeypatch):
    """The hash of its text does not say what it draws."""
    path, calls = tmp_path / "reader.py", []
    (tmp_path / "block.step").write_text("ISO-10303-21;")
    path.write_text("def build():\n    return 'block.step'\n")
    run = drawn.in_child
    monkeypatch.setattr(drawn, "in_child", lambda *given: calls.append(given) or run(*given))
    for _ in range(2):
        with part_file(path) as file:
            assert file.name == "reader.step"
    assert len(calls) == 2


def test_the_checksum_counts_modules_of_the_folder(script):
    before = checksum(script)
    module = script.parent / "profile_of_block.py"
    module.write_text("import os\nSIDE = 1\n")
    assert checksum(script) == before
    script.write_text("import profile_of_block\n" + DRAW)
    with_module = checksum(script)
    module.write_text("import os\nSIDE = 2\n")
    assert len({before, with_module, checksum(script)}) == 3
    assert files_of(script) == {script, module}
    with refused("sha256", with_module[:12]):
        part(script, sha256=with_module)


def test_a_drawn_part_has_no_dimensions(tmp_path):
    step = tmp_path / "block.step"
    step.write_text("ISO-10303-21;")
    with refused("dimensions", "side", "block.step", ".py", ".csv"):
        part(step, dimensions={"side": "1 mm"})


def test_a_table_of_files_gives_the_part_with_the_dimensions(tmp_path):
    for name in ("thin", "thick"):
        (tmp_path / f"{name}.step").write_text(f"ISO-10303-21; {name}")
    table = tmp_path / "fingers.csv"
    table.write_text("wall (mm),kind,file\n1.5,round,thin.step\n2,round,thick.step\n")
    assert [(each.name, each.unit, each.kind) for each in dimensions_of(table)] == [
        ("wall", "mm", "number"),
        ("kind", "", "text"),
    ]
    with part_file(table, stated={"wall": "0.2 cm", "kind": "round"}) as file:
        assert file == tmp_path / "thick.step"
    with (
        refused("fingers.csv", "wall = 1.7 mm", "wall = 1.5 mm"),
        part_file(table, stated={"wall": "1.7 mm", "kind": "round"}),
    ):
        pass
    table.write_text("wall (mm),kind,file\n1.5,1,thin.step\n2,b,thick.step\n")
    with part_file(table, stated={"wall": "1.5 mm", "kind": "1"}) as file:
        assert file == tmp_path / "thin.step"
    before = checksum(table)
    (tmp_path / "thin.step").write_text("ISO-10303-21; thinner")
    assert checksum(table) != before
    with refused("fingers.csv", "kind"):
        part(table, dimensions={"wall": "2 mm"})


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("wall (mm),path\n1,a.step\n", ("'file'", "wall, path")),
        ("wall (mm),file\n", ("header",)),
        ("wall (mm),file\n1,fingr.step\n", ("fingr.step", "'finger.step'")),
        ("wall (mm),file\n1,finger.toml\n", ("finger.toml", ".step")),
        ("wall (kPa),file\n1,finger.step\n", ("wall (kPa)",)),
        ("wall (mm),file\nthin,finger.step\n", ("wall", "'thin'", "mm")),
        ("wall (mm),file\n1,2,finger.step\n", ("3 cells", 2)),
        ("wall (mm);file\n1,5;finger.step\n", ("semicolons", "commas")),
        ("wall (mm),file,wall (mm)\n1,finger.step,2\n", ("columns 'wall'",)),
        ("wall (mm),file\nnan,finger.step\n", ("wall", "'nan'", "mm")),
        ("", ("empty",)),
    ],
)
def test_tables_that_are_none_are_refused(tmp_path, text, facts):
    (tmp_path / "finger.step").write_text("ISO-10303-21;")
    table = Path(tmp_path / "fingers.csv")
    table.write_text(text)
    with refused("fingers.csv", *facts):
        part(table, dimensions={"wall": "1 mm"})
