"""V07, V20: the force of a winding and the tension of its threads are those of the exact solution.

Problem: the tubes of V07 (hoops that do not give way, exact pressures and stretches) and V20 (one helix of Kevlar
threads at 30° from the circumference, 2 mm apart, 30 kPa, closed free ends), wound smeared and thread by thread.
Exact: the winding presses on the rubber with q (`hoops.CONTACT`), so that it carries q B for each current length of the
tube; hoops a distance s apart at rest then hold T = q B s λz. The stretch of the helix follows from the widening,
extension and twist that minimize the energy, as in V20.
Tolerance: winding force 0.2 %; tensions of threads 10 %. The raw tensions of single trusses scatter by far more, as the
tests show: along a thread at an angle, and from hoop to hoop.
"""

import numpy as np
import pytest
from hoops import CONTACT, INNER, OUTER, PRESSURE, STIFF_HOOPS, STRETCH, model_of

import meshes
import problems
import slices
import turgor as tg
from fiber_tube import FiberTube
from turgor.core.engine.fibers.tension import piece_tension
from turgor.core.engine.fibers.thread_rest import ThreadRest
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.meshing.generate import mesh as make_mesh
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.results.fields.fibers import FiberResult, fiber_results
from turgor.core.results.measures.measures import find_measure
from turgor.units import deg, kPa, mm

SPACING = 2 * mm
WITHIN = 0.1


def points_of_the_table(count):
    exact = zip(PRESSURE["neo-Hookean"], STRETCH, CONTACT, strict=True)
    return [(p * problems.MPA, stretch, q * problems.MPA) for p, stretch, q in exact][:count]


def raw(result: FiberResult):
    """Tension of each piece by itself."""
    return piece_tension(result.fibers, result.stretch, ThreadRest())


def test_winding_force_of_hoops_is_contact_pressure_times_radius(record_verification):
    table = points_of_the_table(7)
    states = slices.states_at(model_of("neo-Hookean", "hoops"), [(p, s) for p, s, _ in table])
    got = [find_measure("winding_force_per_length")(state) for state in states]
    exact = [q * OUTER for _, _, q in table]
    record_verification(
        claim="extender, neo-Hookean, smeared hoops: winding force for each current length [N/m]",
        source="V07, q B, exact", expected=exact, got=got, tolerance="0.2 %",
    )  # fmt: skip
    assert got == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_tension_of_hoops(form, record_verification):
    """Sides of 3 mm and hoops 2 mm apart: one or two hoops cross a side, and raw tensions differ twofold."""
    body = meshes.tube_sector(INNER, OUTER, 12 * mm, (2, 4, 4), kind=HEXAHEDRON)
    material = tg.Material(name="thread", law=Hooke(E=STIFF_HOOPS * SPACING / (np.pi * (0.1 * mm) ** 2 / 4), nu=0.3))
    winding = Winding(angle_from_circumference=0.0, spacing=SPACING, axis=(0.0, 0.0, 1.0))
    hoops = Fibers(face="outside", material=material, diameter=0.1 * mm, winding=winding, form=form)
    table = points_of_the_table(4)
    model = slices.wound(body, problems.NEO_HOOKE, [hoops])
    states = slices.states_at(model, [(p, s) for p, s, _ in table])
    results = [fiber_results(state)[0] for state in states]
    exact = np.array([q * OUTER * SPACING * s for _, s, q in table])
    ends = [[float(each.tension.min()), float(each.tension.max())] for each in results]
    record_verification(
        claim=f"extender, neo-Hookean, {form} hoops: largest tension of a thread [N]",
        source="V07, q B s λz, exact", expected=exact, got=[high for _, high in ends], tolerance="10 %",
    )  # fmt: skip
    assert np.array(ends) == pytest.approx(np.stack([exact, exact], axis=1), rel=WITHIN)
    force = find_measure("winding_force_per_length")(states[-1])
    assert force == pytest.approx(table[-1][2] * OUTER, rel=0.02)
    if form == "discrete":
        assert raw(results[-1]).max() > 1.3 * exact[-1]


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_tension_of_a_helix(form, record_verification):
    part = FiberReinforcedCylinder(length=50 * mm, symmetric=False)
    body = make_mesh(part.build(), size=5 * mm, cells="hexahedra")
    kevlar = tg.Material(name="kevlar", law=Hooke(E=31067e6, nu=0.36))
    winding = Winding(angle_from_circumference=30 * deg, spacing=SPACING)
    helix = Fibers(face="outside", material=kevlar, diameter=0.1778 * mm, winding=winding, form=form)
    model = tg.Model(
        body, {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 30 * kPa)],
        reinforcements=[helix],
    )  # fmt: skip
    result = fiber_results(problems.solve(model, tg.Static(tolerance=1e-7)).states[-1])[0]
    exact_tube = FiberTube(
        inner=INNER, outer=OUTER, shear_modulus=0.24e6,
        families=[(helix.stretching_stiffness / SPACING, 30 * deg)],
    )  # fmt: skip
    stretch = float(exact_tube.fiber_stretches(*exact_tube.free(30 * kPa))[0])
    exact = helix.stretching_stiffness * (stretch - 1)
    middle = np.abs(result.positions[:, 0] / result.positions[:, 0].max() - 0.5) < 0.1
    got = [float(result.tension[middle].min()), float(result.tension[middle].max()), result.maximum_tension]
    record_verification(
        claim=f"one helix, 30°, 30 kPa, {form}: least and largest tension in the middle fifth, largest of all [N]",
        source="V20, exact", expected=[exact] * 3, got=got, tolerance="10 %",
    )  # fmt: skip
    assert got == pytest.approx([exact] * 3, rel=WITHIN)
    if form == "discrete":
        assert raw(result).max() > 2 * exact
