"""``turgor track`` reads a path and writes pressures."""

import json

import numpy as np
import pytest
from reduced_cases import reduced
from typer.testing import CliRunner

import turgor as tg
from refused import refused
from turgor.cli.start.commands import command_line


def run(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(command_line(arguments[0]), list(arguments))
    return done.exit_code, done.output


def test_track_writes_pressures_and_a_picture(tmp_path):
    file, path = reduced().save(tmp_path / "finger"), tmp_path / "path.csv"
    pressures = np.linspace(1e3, 9e3, 5)
    tips = 1e3 * np.array([reduced().solve(float(pressure)).tip for pressure in pressures])
    rows = [f"{place},{x:.9g},{z:.9g}" for place, (x, _, z) in enumerate(tips)]
    path.write_text("\n".join(["time_s,tip_x_mm,tip_z_mm", *rows]), encoding="utf-8")
    out = str(tmp_path / "out")
    code, text = run("track", str(file), str(path), "--limit", "pressure=0..8 kPa", "--output", out, "--json")
    assert code == 0, text
    result = json.loads(text)["result"]
    assert result["inputs"]["loads.pressure"] == pytest.approx([1e3, 3e3, 5e3, 7e3, 8e3], abs=2.0)
    assert result["active"][-1] == ["loads.pressure high"]
    table = tg.files.read_response(tmp_path / "out" / "track.csv")
    assert table["pressure"] == pytest.approx(result["inputs"]["loads.pressure"])
    assert (tmp_path / "out" / "track.png").stat().st_size > 10_000
    assert "<h1>path</h1>" in (tmp_path / "out" / "track.html").read_text(encoding="utf-8")
    for option, facts in {
        "--limit=presure=0..8 kPa": ("presure", "loads.pressure"),
        "--limit=pressure=0..8 mm": ("--limit pressure", "mm"),
        "--limit=pressure=8 kPa": ("--limit", "NAME=FROM..TO"),
        "--rate=pressure": ("--rate", "NAME=RATE"),
        "--limit=pressure=0..80 kPa": ("80 kPa", "12 kPa"),
    }.items():
        code, text = run("track", str(file), str(path), option)
        assert code == 1
        for fact in facts:
            assert fact in text


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("time_s,tip_q_mm\n0,1", ("tip_q", "tip_x")),
        ("time_s,tip_x\n0,1", ("tip_x", "tip_x_mm")),
        ("time_s,tip_x_kPa\n0,1", ("tip_x", "kPa", "tip_x_mm")),
        ("time_s\n0", ("time", "tip_x")),
        ("tip_x_mm,bending_angle_deg\n0,1", ("tip_x", "bending_angle")),
        ("tip_x_mm,force_N\n0,1", ("tip_x", "force")),
        ("force_kPa\n0\n1", ("force", "kPa", "force_N")),
    ],
)
def test_a_file_that_states_no_path_is_refused(text, facts, tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(text, encoding="utf-8")
    with refused(*facts):
        tg.control.read_path(file)


@pytest.mark.parametrize(("column", "obstacle"), [("force_N", None), ("force_top_plate_mN", "top_plate")])
def test_a_column_of_forces_names_the_obstacle(column, obstacle, tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(f"time_s,{column}\n0,1\n1,2", encoding="utf-8")
    wanted = tg.control.read_path(file)
    assert wanted.output == tg.control.ContactForce(obstacle)
    assert wanted.rows[:, 0] == pytest.approx(np.array([1.0, 2.0]) * (1.0 if obstacle is None else 1e-3))
