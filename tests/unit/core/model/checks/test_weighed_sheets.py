"""Weight and inertia of sheets: what they add to a body, where a density is needed, what says that it is missing."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from solver_cases import RUBBER, bar

import turgor as tg
from refused import refused
from turgor.core.engine.faces.dead_loads import ScaledNodalForces
from turgor.core.engine.mass import even_mass, mass_data, total_mass
from turgor.core.engine.system import System
from turgor.core.engine.term import Setting
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.job.read import JobError, read_job
from turgor.systems.robots.chains.chain_shape import bodies_of
from turgor.units import GPa, kPa, mm

HEAVY = tg.Material(name="film", law=tg.laws.Hooke(E=4 * GPa, nu=0.3), density=1400.0)
LIGHT = replace(HEAVY, density=None)
PER_AREA = 0.14  # kg/m²
FACE = 0.5e-4  # m², of `top`
CELLS = 2 * 1e-6 / 6


def covered(sheet=HEAVY, loads=(), rubber=1000.0):
    """Two tetrahedra with a sheet of 0.1 mm on one side."""
    made = tg.Membrane(sheet, 0.1 * mm)
    return tg.Model(bar(), {"body": replace(RUBBER, density=rubber), "top": made}, [tg.Fixed("fixed")], loads)


def nodal(model):
    system = System(model)
    return ScaledNodalForces(
        Setting(model, system.points, system.prescribed, system.dV, system.length, system.stress_scale)
    )


def area():
    return 0.5 * np.linalg.norm(np.cross(*np.diff(bar().points[bar().face("top")[0, :3]], axis=0)))


def test_a_sheet_on_a_body_adds_its_mass_and_weight():
    model, alone = covered(), 1000.0 * CELLS
    whole = alone + PER_AREA * area()
    assert total_mass(model) == pytest.approx(whole)
    assert total_mass(covered(LIGHT)) == pytest.approx(alone)
    system, forces = System(model), nodal(model)
    newton = system.stress_scale * system.length**2
    assert forces.of_weight((0, 0, -2.0)).sum(axis=0) * newton == pytest.approx([0, 0, -2 * whole])
    by_place = forces.per_mass(lambda points: points * (0, 0, 3.0)).sum(axis=0)[2] * newton
    middle = bar().points[bar().face("top")[0, :3], 2].mean()
    without = nodal(covered(LIGHT)).per_mass(lambda points: points * (0, 0, 3.0)).sum(axis=0)[2] * newton
    assert by_place - without == pytest.approx(3 * PER_AREA * area() * middle)


def test_the_mass_matrix_moves_a_sheet_along():
    moved = []
    for sheet in (HEAVY, LIGHT):
        model = tg.Model(bar(), covered(sheet).materials, [tg.Fixed("fixed", "y")], [])
        system = System(model)
        along = np.where(np.arange(system.size) % 3 == 2, 1.0, 0.0) * system.moving
        mass = system.layout.base.product(mass_data(system), along) @ along
        moved.append(mass * system.stress_scale * system.length)
    assert moved[0] - moved[1] == pytest.approx(PER_AREA * area())


def test_a_chain_of_links_weighs_the_sheet_too():
    links = bodies_of(covered(), 1, at_base=True)
    assert links.masses.sum() == pytest.approx(total_mass(covered()))


@pytest.mark.parametrize(
    ("loads", "procedure", "said"),
    [
        ([tg.Gravity((0, 0, -1))], tg.Static(), True),
        ([tg.Traction("top", (0, 0, 1 * kPa))], tg.Static(), False),
        ([tg.Traction("top", (0, 0, 1 * kPa))], tg.Stabilized(), False),
        ([tg.Traction("top", (0, 0, 1 * kPa))], tg.Dynamic(duration=1.0), True),
    ],
)
def test_a_sheet_without_density_is_named_where_it_matters(loads, procedure, said):
    codes = [each.code for each in early_findings(covered(LIGHT, loads), procedure)]
    assert ("L14" in codes) is said
    assert "L14" not in [each.code for each in early_findings(covered(HEAVY, loads), procedure)]


def film_model(material, loads=(), supports=("left",)):
    corners = ((0, 0, 0), (0, 10 * mm, 0), (10 * mm, 10 * mm, 0), (10 * mm, 0, 0))
    patch = tg.bodies.Patch(corners=corners, faces=("film",), edges=("left", "", "right", ""))
    mesh = tg.mesh(tg.bodies.Film(patches=(patch,)), size=5 * mm)
    return tg.Model(mesh, {"film": tg.Membrane(material, 0.1 * mm)}, supports, loads)


def test_a_film_alone_needs_a_density_where_it_matters():
    gravity, pull = [tg.Gravity((0, 0, -1))], [tg.loads.Force("right", (1.0, 0, 0))]
    with refused("materials.film", "density", "gravity"):
        film_model(LIGHT, gravity)
    for meet in (lambda model: tg.solve(model, tg.Dynamic(duration=1.0)), tg.natural_frequencies):
        with refused("materials.film", "density", "motion"):
            meet(film_model(LIGHT))
    assert total_mass(film_model(HEAVY)) == pytest.approx(PER_AREA * 1e-4)
    with refused("stiffness_damping", "films", "mass_damping"):
        tg.solve(film_model(HEAVY, pull), tg.Dynamic(duration=1e-3, stiffness_damping=1e-3))


JOB = """\
[actuator]
type = "pouch"

[materials]
film = { law = "hooke", E = "4 GPa", nu = 0.35, thickness = "50 µm", compression = 0, density = "1390 kg/m³" }
seams = { law = "hooke", E = "4 GPa", nu = 0.35, thickness = "0.3 mm" }

[loads]
gravity = "+x"
"""


def test_a_job_of_films_with_weight(tmp_path: Path):
    path = tmp_path / "job.toml"
    path.write_text(JOB, encoding="utf-8")
    with pytest.raises(JobError) as error:
        read_job(path)
    assert len(error.value.problems) == 1
    assert all(word in str(error.value.problems[0]) for word in ("materials.seams", "density", "gravity"))
    path.write_text(JOB.replace('"0.3 mm" }', '"0.3 mm", density = "1390 kg/m³" }'), encoding="utf-8")
    assert read_job(path).materials["seams"].material.density == 1390


def test_weight_in_an_inp_file_is_that_of_heavy_sheets_too(tmp_path: Path):
    for sheet, heavy in ((HEAVY, True), (LIGHT, False)):
        tg.files.write_inp(covered(sheet, [tg.Gravity((0, 0, -1))]), tmp_path / "body.inp", program="abaqus")
        lines = (tmp_path / "body.inp").read_text(encoding="utf-8").splitlines()
        assert ("membrane_top," in lines) is heavy


def test_an_even_mass_is_that_of_the_area_of_films():
    system = System(film_model(HEAVY, supports=[]))
    along = np.where(np.arange(system.size) % 3 == 1, 1.0, 0.0)
    assert system.layout.base.product(even_mass(system), along) @ along * system.length**2 == pytest.approx(1e-4)
