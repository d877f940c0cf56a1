"""Jobs that move: what they say is read, written into the lock file and read again; ``turgor modes``."""

from pathlib import Path

import numpy as np
import pytest

from refused import any_states, refused
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.model.history import over_time, share_at
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.results.files.response_csv import read_response
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.problems import JobError

HEAD = """
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa", density = "1000 kg/m³" }
base = { law = "neo_hooke", C10 = "50 kPa", density = "1000 kg/m³" }
"""
MOTION = """
[loads.cavity]
pressure = "1 kPa"
history_over_time = "sin(2*pi*t/0.08)"

[loads.gravity]
direction = "-z"
history = [[0, 0], [0.2, 1], [1, 1]]

[procedure]
type = "dynamic"
duration = "40 ms"
stiffness_damping = "2 ms"
mass_damping = "0.5 1/s"
accuracy = 0.01
"""


def read(tmp_path: Path, text: str, name: str = "job") -> object:
    (tmp_path / f"{name}.toml").write_text(HEAD + text, encoding="utf-8")
    return read_job(tmp_path / f"{name}.toml")


def test_a_table_is_no_duration(tmp_path: Path) -> None:
    with refused("procedure.duration", "'40 ms'", "'2 s'", error=JobError):
        read(tmp_path, MOTION.replace('duration = "40 ms"', 'duration = { duration = "40 ms" }'))


def test_a_motion_is_read_and_locked(tmp_path: Path) -> None:
    job = read(tmp_path, MOTION)
    assert job.procedure == Dynamic(duration=0.04, stiffness_damping=2e-3, mass_damping=0.5, accuracy=0.01)
    pressure, weight = job.loads
    assert pressure == Pressure("cavity", 1e3, over_time("sin(2*pi*t/0.08)", 0.04))
    assert share_at(pressure.history, 0.5) == pytest.approx(np.sin(np.pi / 2))
    assert weight == Gravity((0, 0, -1), history=((0, 0), (0.2, 1), (1, 1)))
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(tmp_path / "lock.toml")
    assert again.procedure == job.procedure
    assert again.loads == job.loads


@pytest.mark.parametrize(
    "path",
    ["[procedure]", '[[stages]]\nname = "move"\n[stages.procedure]'],
    ids=["procedure", "stage"],
)
def test_motion_without_density_is_refused_before_anything_is_solved(tmp_path: Path, path: str) -> None:
    light = HEAD.replace(', density = "1000 kg/m³"', "")
    (tmp_path / "job.toml").write_text(
        f'{light}[loads]\npressure = "1 kPa"\n{path}\ntype = "dynamic"\nduration = "40 ms"', encoding="utf-8"
    )
    with refused("materials.body", "materials.base", "motion", "'1100 kg/m³'", error=JobError):
        read_job(tmp_path / "job.toml")


def test_stabilization_is_read_and_locked(tmp_path: Path) -> None:
    job = read(
        tmp_path,
        '[loads]\npressure = "1 kPa"\n[procedure]\ntype = "stabilized"\nstabilization = 1e-3\nat = ["0.5 kPa"]',
    )
    assert job.procedure == Stabilized(stabilization=1e-3, at=(0.5,))
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(tmp_path / "lock.toml").procedure == job.procedure


@pytest.mark.parametrize(
    ("before", "after", "facts"),
    [
        ('"40 ms"', "0.04", ["procedure.duration:", "0.04", "'2 s'"]),
        ('"40 ms"', '"-1 s"', ["procedure.duration:", "-1 s", "0"]),
        ('"0.5 1/s"', '"0.5 s"', ["procedure.mass_damping:", "'0.5 s'", "a rate"]),
        ("accuracy = 0.01", "spectral_radius = 2.0", ["procedure.spectral_radius:", "2", "0 to 1"]),
        ("accuracy = 0.01", "velocity = 1.0", ["procedure.velocity:", "1.0", "three speeds"]),
        ('type = "dynamic"\nduration = "40 ms"', 'type = "static"', ["loads.cavity:", "history_over_time", "duration"]),
        ('"sin(2*pi*t/0.08)"', '"sin(2*pi*f)"', ["loads.cavity.history:", "'sin(2 * pi * f)'", "'f'", "pi, s"]),
        ('"sin(2*pi*t/0.08)"', "3", ["loads.cavity.history_over_time:", "3", "list", "expression"]),
        (
            't/0.08)"',
            't/0.08)"\nhistory = [[0, 0], [1, 1]]',
            ["loads.cavity:", "history and history_over_time", "both"],
        ),
        ('"-z"', '"z"', ["loads.gravity.direction:", "'z'", "'-z'"]),
        ('direction = "-z"', "", ["loads.gravity.direction:", "'direction'", "missing"]),
        ("[[0, 0], [0.2, 1], [1, 1]]", "[[0.5, 1], [1, 1]]", ["loads.gravity.history:", "load factor 0"]),
    ],
)
def test_each_mistake_is_one_clear_sentence(tmp_path: Path, before: str, after: str, facts: list[str]) -> None:
    assert before in MOTION
    with pytest.raises(JobError) as error:
        read(tmp_path, MOTION.replace(before, after))
    assert any_states(error.value.problems, facts), error.value.problems


def test_a_job_moves(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read(tmp_path, MOTION + "[output]\nmeasures = ['cavity_volume']\npictures = false\nreport = false\n")
    monkeypatch.chdir(tmp_path)
    assert main(["run", "job.toml", "--quiet"]) == DONE
    response = read_response(tmp_path / "job-results" / "response.csv")
    assert response.names[:3] == ("load_factor", "time", "pressure")
    time, pressure = response.column("time"), response.column("pressure")
    assert pressure == pytest.approx(1e3 * np.sin(2 * np.pi * time / 0.08), abs=1e-6)
    balance = [response.column(f"{name}_energy") for name in ("kinetic", "strain", "dissipated", "missing")]
    assert sum(balance) == pytest.approx(response.column("external_work"), abs=1e-12)
    listed = (tmp_path / "job-results" / "vtu" / "state.pvd").read_text(encoding="utf-8")
    assert "timestep is the time [s]" in listed
    assert f'timestep="{time[-1]:.12g}"' in listed


def test_modes_are_listed_and_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    read(tmp_path, '[loads]\npressure = "1 kPa"\n')
    monkeypatch.chdir(tmp_path)
    assert main(["modes", "job.toml", "--count", "2", "--loaded", "--output", "shapes"]) == DONE
    told = capsys.readouterr().out
    assert "Frequencies at load factor 1:" in told
    assert "symmetric about its mirror planes" in told
    assert len(told.splitlines()) == 6
    assert sorted(file.name for file in (tmp_path / "shapes").iterdir()) == [
        "mode.pvd",
        "mode_0000.vtu",
        "mode_0001.vtu",
    ]
    assert main(["modes", "job.toml", "--output", "shapes"]) == BAD_INPUT
    assert "--output is 'shapes', which exists" in capsys.readouterr().err
    assert main(["modes", "job.toml", "--count", "0"]) == BAD_INPUT


def test_a_velocity_and_a_constant_weight_are_read_and_written_back(tmp_path: Path) -> None:
    text = """
    [loads.gravity]
    direction = "-z"
    history = "constant"

    [procedure]
    type = "dynamic"
    duration = "40 ms"
    velocity = [0, 0, "200 mm/s"]
    """
    job = read(tmp_path, text)
    assert job.procedure.velocity == (0.0, 0.0, 0.2)
    assert job.loads[0].share(0.0) == 1.0
    assert job.loads[0].text() == "Gravity 9.80665 m/s² along (0, 0, -1), from the start."
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(tmp_path / "lock.toml")
    assert (again.procedure, again.loads) == (job.procedure, job.loads)
    with refused("procedure.velocity", "three speeds", error=JobError):
        read(tmp_path, text.replace('[0, 0, "200 mm/s"]', '"200 mm/s"'))
    with refused("procedure.velocity", "kPa", error=JobError):
        read(tmp_path, text.replace("mm/s", "kPa"))
    with refused("procedure", "velocty", "'velocity'", error=JobError):
        read(tmp_path, text.replace("velocity", "velocty"))
    with refused("loads.gravity.history", "'constnt'", "'constant'", error=JobError):
        read(tmp_path, text.replace("constant", "constnt"))


def test_the_pouch_with_weight_of_the_guide_on_films_is_read(tmp_path: Path) -> None:
    guide = (Path(__file__).parents[3] / "docs" / "howto" / "films.md").read_text(encoding="utf-8")
    pouch, weight = (part.split("```toml\n")[1].split("```")[0] for part in guide.split("## Weight and motion"))
    (tmp_path / "pouch.toml").write_text(pouch.split("[materials]")[0] + weight, encoding="utf-8")
    assert Gravity((1, 0, 0)) in read_job(tmp_path / "pouch.toml").loads
