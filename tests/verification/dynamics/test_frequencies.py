"""V15: natural frequencies at rest, of a free body, and about a pressurized state.

Problems: (1) the clamped strip of V15; (2) a bar that nothing holds; (3) a thick sphere under pressure, whose breathing
mode has a closed form: with the pressure P(λ) of `exact.sphere_pressure` that holds the inner radius a = λ A, and the
kinetic energy 2 π ρ a³ (1 − a/b) ȧ² of the incompressible flow, ω² = P'(a) / (ρ a (1 − a/b)).
References: (1) converged elements; Euler and Bernoulli's beam has 4.8386 Hz; (2) six rigid motions at 0, and Euler and
Bernoulli's free bar as an upper bound of the first bending; (3) exact. Tolerance: (1) 0.3 % with 30 × 3 cells (0.4 %
with 20 × 2, 0.13 % with 40 × 4); (3) 0.5 %.
"""

import numpy as np
import pytest

import exact
import meshes
import problems
import turgor as tg
import vibrations
from refused import refused
from turgor.core.engine.mass import total_mass
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.procedures.volume_control import VolumeControl

MM = problems.MM
FREQUENCIES = (4.8345, 28.540, 73.76, 75.68)  # Hz


def test_clamped_strip(record_verification):
    modes = natural_frequencies(vibrations.strip((30, 3, 1)), count=4, options=problems.OPTIONS)
    record_verification(
        claim="clamped strip: natural frequencies [Hz]",
        source="V15, converged reference",
        expected=FREQUENCIES,
        got=modes.frequencies,
        tolerance="0.3 %",
    )
    assert modes.frequencies == pytest.approx(FREQUENCIES, rel=3e-3)
    assert modes.unstable == 0
    assert np.linalg.norm(modes.shapes, axis=2).max(axis=1) == pytest.approx(1.0)
    # a clamped beam's modal mass is a quarter of its own in every bending mode
    assert modes.modal_mass[0] == pytest.approx(total_mass(modes.model) / 4, rel=0.02)


@pytest.mark.parametrize(("bulk", "formulation"), [(np.inf, "mixed"), (1e7, "displacement")])
def test_free_bar(bulk, formulation, record_verification):
    mesh = meshes.box((100 * MM, 10 * MM, 10 * MM), (6, 1, 1), kind=HEXAHEDRON)
    rubber = problems.rubber(problems.NEO_HOOKE, bulk, 1070.0)
    model = tg.Model(mesh, {"body": rubber}, [], [], formulation)
    modes = natural_frequencies(model, count=7, options=problems.OPTIONS)
    beam = 4.730041**2 / (2 * np.pi) * np.sqrt(0.72e6 * (10 * MM) ** 2 / 12 / 1070) / (100 * MM) ** 2
    record_verification(
        claim=f"free bar, {formulation}: six rigid motions, then bending over the thin beam's frequency",
        source="V15, Euler-Bernoulli",
        expected=[0, 0, 0, 0, 0, 0, "0.95 to 1"],
        got=[*modes.frequencies[:6], modes.frequencies[6] / beam],
        tolerance="-",
    )
    assert (modes.frequencies[:6] == 0).all()
    assert 0.95 < modes.frequencies[6] / beam < 1.0
    assert total_mass(modes.model) == pytest.approx(1070 * 0.1 * 0.01**2, rel=1e-12)


def _breathing(model, state):
    """Frequency of the mode in which all points of the cavity move outward."""
    modes = natural_frequencies(model, state, count=12, options=problems.OPTIONS)
    nodes = model.mesh.face_nodes("cavity")
    outward = model.mesh.points[nodes] / np.linalg.norm(model.mesh.points[nodes], axis=1)[:, None]
    motion = modes.shapes[:, nodes]
    along = np.abs(np.einsum("kni,ni->kn", motion, outward).sum(axis=1)) / np.linalg.norm(motion, axis=2).sum(axis=1)
    assert along.max() > 0.99
    return float(modes.frequencies[along.argmax()])


@pytest.mark.parametrize("pressure", [0.0, 60e3, 110e3])
def test_sphere_under_pressure(pressure, record_verification):
    inner, outer, density = 10 * MM, 15 * MM, 1070.0
    mesh = meshes.sphere_octant(inner, outer, 2, 2, kind=HEXAHEDRON)
    rubber = problems.rubber(problems.NEO_HOOKE, density=density)
    model = tg.Model(mesh, {"body": rubber}, [], [tg.Pressure("cavity", pressure)])
    state = problems.solve(model).states[-1] if pressure else None
    stretch = 1.0
    if pressure:
        stretch = exact.sphere_stretch(problems.NEO_HOOKE, pressure, inner, outer, 1.6)

    def held(s):
        return exact.sphere_pressure(problems.NEO_HOOKE, s, inner, outer)

    step = 1e-4
    slope = (held(stretch + step) - held(stretch - step)) / (2 * step * inner)
    a = stretch * inner
    b = (outer**3 + a**3 - inner**3) ** (1 / 3)
    expected = np.sqrt(slope / (density * a * (1 - a / b))) / (2 * np.pi)
    result = _breathing(model, state)
    record_verification(
        claim=f"sphere under {pressure / 1e3:g} kPa: frequency of the breathing mode [Hz]",
        source="V15, closed form",
        expected=expected,
        got=result,
        tolerance="0.5 %",
    )
    assert result == pytest.approx(expected, rel=5e-3)


def test_pressure_that_a_volume_brings_about(record_verification):
    """A sphere filled to a volume vibrates as one that is put under the pressure that this takes."""
    mesh = meshes.sphere_octant(10 * MM, 15 * MM, 2, 1, kind=HEXAHEDRON)
    rubber = problems.rubber(problems.NEO_HOOKE, density=1070.0)
    filled = problems.solve(tg.Model(mesh, {"body": rubber}, [], []), VolumeControl(volume=2e-6)).states[-1]
    pressed = tg.Model(mesh, {"body": rubber}, [], [tg.Pressure("cavity", filled.pressures["cavity"])])
    state = problems.solve(pressed).states[-1]
    assert filled.pressures["cavity"] > 50e3
    assert state.displacement == pytest.approx(filled.displacement, abs=1e-5 * np.abs(state.displacement).max())
    result = natural_frequencies(filled.model, filled, count=3, options=problems.OPTIONS)
    expected = natural_frequencies(pressed, state, count=3, options=problems.OPTIONS)
    claim = "sphere filled to a volume against one under the pressure of that volume: lowest frequencies [Hz]"
    record_verification(claim, "V15, two procedures", expected.frequencies, result.frequencies, "1e-5")
    assert result.frequencies == pytest.approx(expected.frequencies, rel=1e-5)


def test_an_unstable_state_has_a_mode_that_grows(record_verification):
    """A strip that is pressed endwise beyond Euler's load and kept straight by the mesh's symmetry is unstable."""
    model = vibrations.strip((8, 1, 1), [tg.Traction("x1", (-20e3, 0, 0))])
    straight = problems.solve(model, tg.Static(first_step=0.2), throw=False).states[-1]
    modes = natural_frequencies(model, straight, count=4, options=problems.OPTIONS)
    claim = "strip pressed beyond Euler's load: unstable modes by the pivots, and by the frequencies"
    record_verification(claim, "V15, law of inertia", straight.unstable_modes, modes.unstable, "exact")
    assert modes.unstable == straight.unstable_modes == 2
    assert modes.frequencies[1] < 0 < modes.frequencies[2]
    assert "unstable" in modes.message
    lowest = natural_frequencies(model, straight, count=1, options=problems.OPTIONS)
    assert lowest.frequencies[0] == pytest.approx(modes.frequencies[0], rel=1e-6)


def test_what_has_no_modes_is_refused():
    mesh = meshes.box((1, 1, 1), (1, 1, 1))
    with refused("materials.body", "'rubber'", "density", "kg/m³"):
        natural_frequencies(problems.one_material(mesh, problems.NEO_HOOKE))
    with refused("count", 90, "1 to 8"):
        natural_frequencies(vibrations.strip((2, 1, 1)), count=90)
    with refused("pressure", "open surface"):
        natural_frequencies(vibrations.strip((2, 1, 1), [tg.Pressure("y0", 1e3)]))
