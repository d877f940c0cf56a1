"""Loading and unloading, specimens, offset and drift of a measurement, and two runs side by side."""

import json

import numpy as np
import pytest

from refused import refused
from turgor.accuracy.laboratory.chosen_rows import ChosenRows
from turgor.accuracy.laboratory.compare import compare
from turgor.accuracy.laboratory.compliance import without_compliance
from turgor.accuracy.laboratory.read_experiment import specimen_column
from turgor.accuracy.laboratory.rest import remove_drift, rest_of
from turgor.cli.app import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.materials.experiments.machine import Machine
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

SLOPE = 1e-5  # rad/Pa


def response(pressure, angle, text="a test", **more):
    columns = [Column("pressure", "kPa", pressure), Column("bending_angle", "deg", angle)]
    columns += [Column(name, unit, values) for name, (unit, values) in more.items()]
    return Response(columns=tuple(columns), source=Source(text=text))


def cycle(offset=0.0, drift=0.0, loop=0.0, rows=51):
    """A triangle of the pressure up to 20 kPa over 20 s; the angle lags in unloading."""
    up = np.linspace(0.0, 20e3, rows)
    pressure = np.concatenate([[0.0] * 5, up, up[::-1], [0.0] * 5])
    time = np.linspace(0.0, 20.0, len(pressure))
    angle = SLOPE * pressure + offset + drift * time / time[-1]
    falls = np.arange(len(pressure)) >= 5 + rows
    angle[falls] += loop * np.sin(np.pi * pressure[falls] / 20e3)
    return response(pressure, angle, time=("s", time))


def line(top=20e3, *, cycled=False):
    pressure = np.linspace(0.0, top, 21)
    pressure = np.concatenate([pressure, pressure[-2::-1]]) if cycled else pressure
    return response(pressure, SLOPE * pressure, "a run")


def test_offset_and_drift_are_estimated_and_taken_away():
    measured = cycle(offset=0.02, drift=0.01)
    result = compare(line(), measured)
    assert result.offset == pytest.approx(0.02, abs=1e-3)
    assert result.drift == pytest.approx(0.01, abs=1e-3)
    assert any("At 0 kPa, the lowest pressure" in note and "+1.16 deg" in note for note in result.notes)
    assert any("drifts" in note for note in result.notes)
    steady = remove_drift(measured, "bending_angle", "pressure")
    assert rest_of(steady, "pressure", "bending_angle").drift == pytest.approx(0.0, abs=1e-3)
    assert compare(line(), steady).rms == pytest.approx(0.02, rel=0.02)
    assert not any("the lowest" in note or "drifts" in note for note in compare(line(), cycle()).notes)


def pull(sign=1.0, **more):
    """An actuator of 0.5 N/mm, pulled by a rig that gives way by 0.04 mm/N."""
    way = sign * np.linspace(0.0, 20e-3, 21)
    force = sign * 500.0 * np.abs(way)
    columns = [Column("tip_displacement_x", "mm", way + 0.04e-3 * force), Column("reaction", "N", force)]
    columns += [Column(name, unit, values) for name, (unit, values) in more.items()]
    return Response(columns=tuple(columns), source=Source(text="a pull"))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_the_rig_gives_way_is_taken_away(sign):
    rig = Machine(compliance="0.04 mm/N")
    bare = without_compliance(pull(sign), rig)
    assert bare["reaction"] == pytest.approx(500.0 * bare.column("tip_displacement_x"), abs=1e-9)
    # a force against the motion, as a support reports it
    columns = (pull(sign).columns[0], Column("reaction", "N", -pull(sign)["reaction"]))
    against = without_compliance(Response(columns=columns, source=Source(text="a pull")), rig)
    assert against["tip_displacement_x"] == pytest.approx(bare["tip_displacement_x"])


def test_a_rig_that_gives_way_needs_one_displacement_and_one_force():
    rig = Machine(compliance="0.04 mm/N")
    two = pull(gap=("mm", np.zeros(21)))
    with refused("one displacement", "gap"):
        without_compliance(two, rig)
    assert np.ptp(without_compliance(two, rig, ("tip_displacement_x",))["tip_displacement_x"]) == pytest.approx(0.02)
    with refused("one force", "has none"):
        without_compliance(response([0, 1e3], [0, 1], way=("mm", [0, 1e-3])), rig)
    with refused("4 mm/N", "40 mm", "tip_displacement_x"):
        without_compliance(pull(), Machine(compliance="4 mm/N"))


def test_a_record_that_does_not_come_back_has_no_drift():
    half = response(np.linspace(0, 20e3, 30), np.linspace(0, 0.2, 30))
    assert np.isnan(compare(line(), half).drift)
    with refused("drift", "bending_angle", "pressure"):
        remove_drift(half, "bending_angle", "pressure")
    loaded = response(np.linspace(20e3, 5e3, 30), np.linspace(0.2, 0.05, 30))
    assert rest_of(loaded, "pressure", "bending_angle") is None and np.isnan(compare(line(), loaded).offset)


def test_loading_and_unloading_are_apart():
    result = compare(line(), cycle(loop=0.03))
    assert result.loop.loading < 1e-6
    assert result.loop.unloading == pytest.approx(0.03 / 2**0.5, rel=0.05)
    assert result.loop.width == pytest.approx(0.03 * 2 / np.pi, rel=0.05)
    assert any("Loading differs by" in note for note in result.notes)
    assert compare(line(), response(np.linspace(0, 20e3, 9), np.linspace(0, 0.2, 9))).loop is None


def test_a_computed_cycle_is_compared_branch_with_branch():
    """A computed loop of the same width: unloading is compared with unloading, and nothing differs."""
    pressure, loop = line(cycled=True)["pressure"], 0.03
    falls = np.arange(41) > 20
    angle = SLOPE * pressure + np.where(falls, loop * np.sin(np.pi * pressure / 20e3), 0.0)
    computed = response(pressure, angle, "a run")
    result = compare(computed, cycle(loop=loop))
    assert result.rms < 2e-4
    assert not any("turns at" in note for note in result.notes)
    assert compare(line(), cycle(loop=loop)).rms > 50 * result.rms


def test_a_path_past_a_limit_point_is_no_unloading():
    snapped = response([0.0, 10e3, 20e3, 15e3, 17e3], [0.0, 0.1, 0.2, 0.5, 0.6], "a run")
    result = compare(snapped, cycle())
    assert result.rms < 1e-6
    assert any("turns at 20 kPa" in note for note in result.notes)


def write(file, measured, names=("",)):
    head = "specimen,Time (s),Pressure (kPa),Bending angle (deg)"
    rows = [head]
    for number, name in enumerate(names):
        columns = (measured["time_s"], measured["pressure_kPa"], measured["bending_angle_deg"] * (1 + 0.1 * number))
        rows += [f"{name},{t:.4f},{p:.4f},{a:.6f}" for t, p, a in zip(*columns, strict=True)]
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return file


@pytest.fixture
def call(tmp_path, capsys):
    line().to_csv(tmp_path / "run.csv")

    def run(experiment, *arguments):
        code = main(["compare", str(tmp_path / "run.csv"), str(experiment), *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run


def test_branches_of_a_record_over_time(call, tmp_path):
    file = write(tmp_path / "rig.csv", cycle(loop=0.03), ["a"])
    rms = {}
    for option in ("--loading", "--unloading", ""):
        code, said, _ = call(file, *filter(None, [option]), "--json")
        assert code == DONE
        rms[option] = json.loads(said)["result"]["rms"]
    assert rms["--loading"] < 1e-5 < rms[""] < rms["--unloading"]


def test_offset_and_drift_are_removed_on_request(call, tmp_path):
    file = write(tmp_path / "rig.csv", cycle(offset=0.02, drift=0.01), ["a"])
    code, said, _ = call(file, "--remove", "offset,drift", "--json")
    result = json.loads(said)["result"]
    assert code == DONE and result["rms"] < 1e-3
    assert any("is removed" in note for note in result["notes"])


def test_specimens_are_averaged_and_compared_one_by_one(call, tmp_path):
    file = write(tmp_path / "rig.csv", cycle(), ["a", "b", "c"])
    code, said, _ = call(file, "--by", "specimen", "--loading")
    assert code == DONE
    for name in "abc":
        assert f"\n{name}: bending angle differs by" in said
    mean, spread = ChosenRows(by="specimen", branch="loading").read(file, None, None)
    assert set(spread) == {"a", "b", "c"}
    assert mean["bending_angle"][-1] == pytest.approx(1.1 * SLOPE * 20e3, rel=1e-3)
    assert mean["bending_angle_spread"][-1] == pytest.approx(0.1 * SLOPE * 20e3, rel=1e-3)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--loading", "--unloading"], "leave both out"),
        (["--remove", "drfit"], "did you mean 'drift'"),
        (["--by", "specimen"], "goes up and down"),
        (["--by", "speciman", "--loading"], "did you mean 'specimen'"),
    ],
)
def test_mistakes_are_answered(call, tmp_path, arguments, sentence):
    code, _, told = call(write(tmp_path / "rig.csv", cycle(), ["a", "b"]), *arguments)
    assert code == BAD_INPUT and sentence in told


def test_two_runs_name_what_differs(tmp_path, capsys):
    for name, constant, factor in (("soft", "0.1 MPa", 1.0), ("stiff", "0.2 MPa", 0.5)):
        folder = tmp_path / name
        folder.mkdir()
        columns = (Column("load_factor", "", [0, 0.5, 1]), Column("pressure", "kPa", [0, 10e3, 20e3]))
        more = (Column("bending_angle", "deg", [0, 0.1 * factor, 0.2 * factor]),)
        more += (Column("cavity_volume", "mL", [1e-6, 2e-6, 3e-6]), Column("reaction", "N", [0, factor * 1e-9, 2e-9]))
        more += (Column("tip_displacement", "mm", [1e-3, 1e-3, 1e-3]),)
        Response(columns=columns + more, source=Source(text=name)).to_csv(folder / "response.csv")
        lock = f'name = "{name}"\n[materials.body]\nC10 = "{constant}"\nsource.text = "{name}"\n'
        (folder / "job.lock.toml").write_text(lock, encoding="utf-8")
    assert main(["compare", str(tmp_path / "soft"), str(tmp_path / "stiff")]) == DONE
    said = capsys.readouterr().out
    assert "materials.body.C10: 0.1 MPa against 0.2 MPa" in said and "source" not in said
    (row,) = [each.split() for each in said.splitlines() if each.startswith("bending_angle")]
    assert row[2:4] == ["11.46", "5.73"]
    assert "cavity_volume [mL]" in said and "of the other run's range" in said
    assert "reaction" not in said  # round-off in both
    (still,) = [each.split() for each in said.splitlines() if each.startswith("tip_displacement")]
    assert still[2:4] == ["1", "1"] and "inf" not in said
    tables = [str(tmp_path / name / "response.csv") for name in ("soft", "stiff")]
    assert main(["compare", *tables]) == DONE
    assert "materials.body.C10: 0.1 MPa against 0.2 MPa" in capsys.readouterr().out
    (tmp_path / "stiff" / "job.lock.toml").unlink()
    assert main(["compare", *tables]) == DONE
    said = capsys.readouterr().out
    assert "same values" not in said and f"no lock file of {tables[1]}" in said
    (tmp_path / "stiff" / "response.csv").unlink()
    assert main(["compare", tables[0], str(tmp_path / "stiff")]) != DONE
    assert "holds no response.csv" in capsys.readouterr().err


def test_a_rig_that_gives_way_on_the_command_line(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pull().to_csv(tmp_path / "rig.csv")
    way = np.linspace(0.0, 20e-3, 5)
    columns = Column("tip_displacement_x", "mm", way), Column("reaction", "N", 500.0 * way)
    Response(columns=columns, source=Source(text="a run")).to_csv(tmp_path / "run.csv")
    steel = "\n".join(f"{0.04 * force:g},{force}" for force in range(0, 24, 2))
    (tmp_path / "steel.csv").write_text(f"Extension (mm),Force (N)\n{steel}\n", encoding="utf-8")
    pair = ["compare", "run.csv", "rig.csv", "--x", "tip_displacement_x", "--y", "reaction"]
    differences = []
    for stated in ((), ("--compliance", "0.04 mm/N"), ("--compliance", "steel.csv")):
        assert main([*pair, *stated, "--json"]) == DONE
        differences.append(json.loads(capsys.readouterr().out)["result"]["rms"])
    assert differences[0] > 0.05 and max(differences[1:]) < 1e-9
    assert main([*pair, "--compliance", "iron.csv"]) == BAD_INPUT
    assert "iron.csv" in capsys.readouterr().err


def test_specimens_one_below_the_other_are_no_loading_and_unloading(tmp_path):
    rows = [f"{name},{pressure},{pressure}" for name in ("A1", "B2") for pressure in range(5)]
    file = tmp_path / "rig.csv"
    file.write_text("specimen,pressure_kPa,angle_deg\n" + "\n".join(rows) + "\n", encoding="utf-8")
    with refused("2 specimens", "'specimen'"):
        ChosenRows().read(file, None, None)
    assert len(ChosenRows(by="specimen").read(file, None, None)[1]) == 2
    counter = [f"{n},{n},{n}" for n in range(8)]
    file.write_text("sample,pressure_kPa,angle_deg\n" + "\n".join(counter) + "\n", encoding="utf-8")
    assert specimen_column(file) == ("", 0)
