"""The code of the how-to pages on volume, gas, weight, limit points and frequencies runs, and does what they say."""

import re
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.units import kPa, mL, mm

GUIDES = Path(__file__).parents[2] / "docs" / "howto"
HEAD = """
[actuator]
type = "rectangular_bender"
[mesh]
size = "6 mm"
[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
base = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
"""


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", (GUIDES / f"{page}.md").read_text(encoding="utf-8"), re.DOTALL)


def names(*loads, symmetric=True):
    """What the pages take for granted: a quarter of a short tube of rubber or the whole of it, and its model."""
    tube = tg.actuators.ExtendingCylinder(length=20 * mm, symmetric=symmetric)
    mesh = tg.mesh(tube.build(), size=8 * mm, cells="hexahedra")
    rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
    model = tg.Model(mesh, materials={"body": rubber}, supports=[tg.Fixed("fixed")], loads=loads)
    return {"tg": tg, "mL": mL, "kPa": kPa, "mesh": mesh, "rubber": rubber, "model": model}


def after_each_block(page, known):
    """Run the blocks of a page one after the other; after each, give all names that there are."""
    for block in blocks(page, "python"):
        exec(block, known)
        yield known


def job_of(tmp_path, text):
    (tmp_path / "job.toml").write_text(text, encoding="utf-8")
    return tg.jobs.read_job(tmp_path / "job.toml")


def test_volume_and_gas():
    steps = after_each_block("volume-and-gas", names())
    injected = next(steps)["response"]
    assert injected.column("injected_volume")[-1] == pytest.approx(1 * mL)
    assert injected.column("pressure")[-1] > 1 * kPa
    thinner = next(steps)["response"]
    assert thinner.column("pressure").max() > 20 * kPa
    sealed = next(steps)["solution"]
    volume = tg.measure(sealed, tg.cavity_volume).column("cavity_volume")
    assert volume[-1] == pytest.approx(volume[0] + 0.5 * mL, rel=1e-6)
    assert next(steps, None) is None


def test_weight_first():
    steps = after_each_block("gravity", names(symmetric=False))
    both = next(steps)["solution"].states[-1]
    last = next(steps)
    assert last["hanging"].load_factor == 1.0
    assert np.abs(last["hanging"].displacement).max() < np.abs(both.displacement).max()
    size = np.abs(both.displacement).max()
    assert last["solution"].states[-1].displacement == pytest.approx(both.displacement, abs=1e-4 * size)


def test_rigs(tmp_path):
    result = next(after_each_block("rigs", names()))
    response = result["response"]
    assert response.column("plate_displacement_x")[-1] < -0.2 * mm
    assert response.column("reaction")[-1] == pytest.approx(
        (0.1 + tg.measures.total_mass(result["model"])) * 9.80665, rel=1e-6
    )
    (tmp_path / "job.toml").write_text(HEAD + blocks("rigs", "toml")[0].replace('"-x"', '"-z"'), encoding="utf-8")
    assert tg.jobs.read_job(tmp_path / "job.toml").points["plate"].point.mass == pytest.approx(0.1)


def test_limit_points(capsys):
    steps = after_each_block("limit-points", names(tg.Pressure("cavity", 90 * kPa)))
    stopped = next(steps)
    assert stopped["solution"].status is tg.Status.LIMIT_POINT
    followed = next(steps)["solution"]
    (limit,) = followed.limit_points
    assert 0.9 < stopped["pressure"] / limit.pressure < 1
    assert followed.status is tg.Status.FOLLOWED
    assert capsys.readouterr().out.startswith("maximum")


def test_frequencies(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    steps = after_each_block("frequencies", names(tg.Pressure("cavity", 20 * kPa)))
    result = next(steps)
    assert result["at_rest"].unstable == 0
    assert len(result["pressurized"].frequencies) == 4
    assert "Frequencies at load factor 1" in capsys.readouterr().out
    assert list((tmp_path / "modes").iterdir())
    assert next(steps)["half_way"].frequencies[0] > 0


def test_motion():
    steps = after_each_block("dynamics", names(tg.Pressure("cavity", 20 * kPa)))
    moved = next(steps)
    assert moved["response"].column("time")[-1] == pytest.approx(0.5)
    rest = tg.solve(moved["model"]).states[-1].displacement
    assert moved["solution"].states[-1].displacement == pytest.approx(rest, abs=0.02 * np.abs(rest).max())
    assert next(steps)["solution"].states[-1].displacement == pytest.approx(rest, abs=1e-4 * np.abs(rest).max())


def test_plots_from_python(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    known = names(tg.Pressure("cavity", 2 * kPa))
    known["solution"] = tg.solve(known["model"], tg.Static(max_step=0.5))
    for _ in after_each_block("plot-from-python", known):
        pass
    assert "° at 2 kPa" in capsys.readouterr().out
    written = {file.name for file in tmp_path.iterdir()}
    assert {"response.png", "volume.png", "compared.png", "finger.png", "halfway.png", "mesh.png"} <= written
    assert {"state_0.png", "report.html", "fields", "last.vtu"} <= written
    assert (tmp_path / "fields" / "state.pvd").is_file()


def test_report_and_viewer(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    model = names(tg.Pressure("cavity", 2 * kPa))["model"]
    tg.solve(model, tg.Static(max_step=0.5), folder=tmp_path / "finger-results")
    for _ in after_each_block("report", {}):
        pass
    for file in ("finger.html", "viewer.html"):
        assert 'class="viewer"' in (tmp_path / file).read_text(encoding="utf-8")


def test_relaxation_and_softening():
    result = next(after_each_block("viscoelasticity", {}))
    stress = result["test"].nominal_stress
    assert result["lost"] > 0
    assert stress[50] > 1.1 * stress[650]  # on the way up to half of the stretch, at 5 s and at 65 s


def test_jobs_on_volume_and_gas(tmp_path):
    whole, more, sealed = blocks("volume-and-gas", "toml")
    job = job_of(tmp_path, whole)
    assert (job.procedure, job.loads) == (tg.VolumeControl(volume=32 * mL), ())
    head, _ = whole.split("[procedure]")
    assert job_of(tmp_path, head + more).procedure == tg.GasMass(mass_ratio=3.0, exponent=1.4)
    assert job_of(tmp_path, head + sealed).procedure == tg.GasMass(pressure=20 * kPa, outside=50 * kPa)


def test_jobs_on_limit_points(tmp_path):
    head, _ = blocks("volume-and-gas", "toml")[0].split("[procedure]")
    remeshed, auto, volume, arc = blocks("limit-points", "toml")
    load = '[loads]\npressure = "60 kPa"\n\n'
    assert job_of(tmp_path, head + load + auto).procedure == tg.Auto(past=3.0)
    assert job_of(tmp_path, head + load + arc).procedure == tg.ArcLength(max_stretch=4.0, at=(40 / 60,))
    assert job_of(tmp_path, head + volume).procedure == tg.VolumeControl(volume=32 * mL)
    assert job_of(tmp_path, head + remeshed).procedure == tg.VolumeControl(volume=10 * mL, remesh=True)


def test_jobs_with_weight(tmp_path):
    weight, first, constant, hung, spun = blocks("gravity", "toml")
    assert job_of(tmp_path, HEAD + weight).loads == (tg.Gravity((0, 0, -1)),)
    both = job_of(tmp_path, HEAD + first).loads
    assert [load.at(0.2) if isinstance(load, tg.Pressure) else load.share(0.2) for load in both] == [0.0, 1.0]
    (there,) = job_of(tmp_path, HEAD + constant).loads
    assert there.share(0.0) == there.share(1.0) == 1.0
    (turning,) = job_of(tmp_path, HEAD + spun).loads
    assert turning.speed == pytest.approx(100 * np.pi)
    (pull,) = job_of(tmp_path, HEAD + hung).loads
    assert (pull.face, pull.vector) == ("tip", pytest.approx((0, 0, -0.05 * 9.80665)))


def test_surrogates(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "page"}  # functions of a study belong to a module
    for _ in after_each_block("surrogate", known):
        pass
    exact = known["ball"](**known["design"])
    stretch = np.interp(40 * kPa, exact["pressure"], exact["inner_stretch"])
    assert known["said"]["inner_stretch"] == pytest.approx(stretch, abs=1e-3)
    pressure = np.interp(1.05, exact["inner_stretch"], exact["pressure"])
    assert known["back"].values["pressure"] == pytest.approx(pressure, rel=0.02)
    assert known["again"].predict({**known["design"], "pressure": 40 * kPa}).values == known["said"].values
    assert (tmp_path / "held-out.png").is_file()
    assert "of the range: reached." in capsys.readouterr().out


def test_sensitivities(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "page"}  # functions of a study belong to a module
    for _ in after_each_block("sensitivity", known):
        pass
    assert known["indices"][0].ranking == known["table"].ranking == ("C10", "wall")
    assert (tmp_path / "indices.png").is_file()
    assert "C10 × wall" in capsys.readouterr().out


def test_optimizations(capsys):
    known = {"__name__": "page"}  # functions of a study belong to a module
    for _ in after_each_block("optimize", known):
        pass
    assert known["found"].reads()[0].value == pytest.approx(10 * mL, rel=0.011)
    assert known["longer"].reads()[0].value == pytest.approx(0.6 * mm, rel=0.011)
    assert "tip_displacement_x_slope_wall" in known["longer"].best_row.response
    assert "All targets are met, after 5 runs." in capsys.readouterr().out


def test_decks(tmp_path, monkeypatch):
    (tmp_path / "examples").mkdir()
    deck = GUIDES.parents[1] / "examples" / "rubber_block.inp"
    (tmp_path / "examples" / deck.name).write_bytes(deck.read_bytes())
    monkeypatch.chdir(tmp_path)
    steps = after_each_block("decks", {})
    job = next(steps)["job"]
    assert job.procedure.at == (pytest.approx(1 / 3),)
    assert next(steps, None) is None
