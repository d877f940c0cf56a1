"""V18: a thick sphere filled with a known amount of gas.

Problem: the neo-Hookean sphere of V04 (inner radius 10 mm, outer 15 mm, C10 = 0.12 MPa) full of air at 0.101325 MPa,
the pressure around. More air of the same temperature is pumped in, up to five times the amount; or none, and the
pressure around falls to a fifth; or the pump is so fast that no heat is exchanged.
Exact: (P + p) λ³ⁿ = p₀ (m/m₀)ⁿ with the pressure P of `exact.sphere_pressure` at the inner stretch λ, and the
pressure p around, which is p₀ at rest; n is 1 at constant temperature and 1.4 without heat.
Source: the ideal gas law. `TABLE` holds values that were computed independently; the exact equation must reproduce
them.
Tolerance: stretch and pressure 0.2 %.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import contact_meshes
import exact
import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.solvers.procedures.gas_mass import GasMass

INNER, OUTER, AIR = 10 * problems.MM, 15 * problems.MM, 0.101325 * problems.MPA
TABLE = ((1.25, 1.025465, 0.0161279), (1.5, 1.050187, 0.0298972), (2, 1.097652, 0.0519079), (3, 1.186, 0.08089),
         (5, 1.343228, 0.107719))  # fmt: skip


def exact_stretch(ratio, outside=AIR, exponent=1.0):
    """Inner stretch at a mass ratio, a pressure around [Pa] and an exponent."""

    def error(x):
        pressure = exact.sphere_pressure(problems.NEO_HOOKE, x, INNER, OUTER)
        return (pressure + outside) * x ** (3 * exponent) / (AIR * ratio**exponent) - 1

    return float(brentq(error, 1.001, 3.0, xtol=1e-13))


def fill(**asked):
    """The path of the sphere under some amount of gas."""
    mesh = meshes.sphere_octant(INNER, OUTER, 2, 3)
    model = problems.one_material(mesh, problems.NEO_HOOKE)
    return problems.solve(model, GasMass(ambient=AIR, tolerance=1e-8, **asked))


def answers(state):
    """Inner stretch and gauge pressure [MPa]."""
    stretch = problems.mean_radius(state, "cavity", (0, 1, 2)) / INNER
    return stretch, state.pressures["cavity"] / problems.MPA


def test_mass_of_gas(record_verification):
    at = tuple((ratio - 1) / 4 for ratio, *_ in TABLE[:-1])
    solution = fill(mass_ratio=5.0, at=at)
    results = [answers(problems.state_at(solution, factor)) for factor in (*at, 1.0)]
    for name, column in (("inner stretch", 0), ("gauge pressure [MPa]", 1)):
        record_verification(
            claim=f"thick sphere with 1.25 to 5 times the air: {name}",
            source="V18, exact",
            expected=[row[column + 1] for row in TABLE],
            got=[row[column] for row in results],
            tolerance="0.2 %",
        )
    for (ratio, stretch, pressure), got in zip(TABLE, results, strict=True):
        assert exact_stretch(ratio) == pytest.approx(stretch, abs=1e-6)
        assert got == pytest.approx((stretch, pressure), rel=2e-3)
    ratios = tg.measure(solution, tg.cavity_volume, mesh_error=False).column("gas_mass_ratio")
    assert ratios[0] == 1.0
    assert ratios[-1] == 5.0


@pytest.mark.parametrize(
    ("what", "asked", "given"),
    [
        ("no air added, a fifth of the pressure around", {"outside": 0.2 * AIR}, {"ratio": 1.0, "outside": 0.2 * AIR}),
        ("three times the air, no heat", {"mass_ratio": 3.0, "exponent": 1.4}, {"ratio": 3.0, "exponent": 1.4}),
    ],
)
def test_other_ways_to_fill_it(what, asked, given, record_verification):
    stretch, pressure = answers(fill(**asked).states[-1])
    expected = exact_stretch(**given)
    exact_pressure = exact.sphere_pressure(problems.NEO_HOOKE, expected, INNER, OUTER) / problems.MPA
    record_verification(
        claim=f"thick sphere, {what}: inner stretch, gauge pressure [MPa]",
        source="V18, exact",
        expected=[expected, exact_pressure],
        got=[stretch, pressure],
        tolerance="0.2 %",
    )
    assert expected > 1.1
    assert (stretch, pressure) == pytest.approx((expected, exact_pressure), rel=2e-3)


def test_much_gas_passes_the_limit_point(record_verification):
    """The amount of gas holds the sphere where a pressure could not: the volume may grow as the pressure falls."""
    solution = fill(mass_ratio=40.0)
    (limit,) = solution.limit_points
    stretch, pressure = answers(solution.states[-1])
    expected = exact_stretch(40.0)
    record_verification(
        claim="thick sphere with 40 times the air: inner stretch past the limit point; limit pressure [MPa]",
        source="V04, V18, exact",
        expected=[expected, 0.11844454],
        got=[stretch, limit.pressure / problems.MPA],
        tolerance="0.2 %, 0.02 %",
    )
    assert expected > 2.5
    assert stretch == pytest.approx(expected, rel=2e-3)
    assert limit.pressure == pytest.approx(0.11844454 * problems.MPA, rel=2e-4)
    assert pressure < 0.9 * limit.pressure / problems.MPA
    assert np.all([state.unstable_modes == 0 for state in solution.states])


def test_filled_then_sealed_then_the_pressure_around_falls(record_verification):
    """Filled to 40 kPa by half of the path, then sealed, then taken to half of the pressure around."""
    solution = fill(pressure=0.04 * problems.MPA, seal=0.5, outside=0.5 * AIR)
    at_seal = problems.state_at(solution, 0.5)
    sealed, last = answers(at_seal), answers(solution.states[-1])
    pressed = exact.sphere_stretch(problems.NEO_HOOKE, 0.04 * problems.MPA, INNER, OUTER, 1.6)

    def error(x):
        pressure = exact.sphere_pressure(problems.NEO_HOOKE, x, INNER, OUTER)
        return (pressure + 0.5 * AIR) * x**3 - (0.04 * problems.MPA + AIR) * pressed**3

    expected = float(brentq(error, 1.001, 3.0, xtol=1e-13))
    record_verification(
        claim="thick sphere sealed at 40 kPa, then half of the pressure around: inner stretch when sealed, in the end",
        source="V18, exact",
        expected=[pressed, expected],
        got=[sealed[0], last[0]],
        tolerance="0.2 %",
    )
    assert at_seal.pressures["cavity"] == pytest.approx(0.04 * problems.MPA, rel=1e-7)
    assert sealed[0] == pytest.approx(pressed, rel=2e-3)
    assert expected > 1.05 * pressed
    assert last[0] == pytest.approx(expected, rel=2e-3)
    assert all(state.driven["gas_mass_ratio"] == 1.0 for state in solution.states)


def test_a_kink_is_no_limit_point():
    """Filled, sealed, then pressed from around: the gauge pressure is largest at the seal, where nothing turns."""
    solution = fill(pressure=0.04 * problems.MPA, seal=0.5, outside=1.3 * AIR)
    pressures = [state.pressures["cavity"] for state in solution.states]
    assert max(pressures) == pytest.approx(0.04 * problems.MPA, rel=1e-7)
    assert pressures[-1] < 0.7 * max(pressures)
    assert solution.limit_points == ()


def test_no_room_for_gas():
    """A flat wall between mirror planes bounds no volume, so that a ratio of amounts of gas has no meaning."""
    held = [tg.Fixed("y0", "y"), tg.Fixed("y1", "y"), tg.Fixed("rim")]
    model = problems.one_material(contact_meshes.gap_cell(), problems.NEO_HOOKE, supports=held)
    with refused("procedure.mass_ratio", "no cavity"):
        problems.solve(model, GasMass(mass_ratio=2.0))
