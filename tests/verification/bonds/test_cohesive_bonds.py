"""Bonds that open: traction by opening, energy, unloading, and a double cantilever beam.

Problems: (1) a stiff bond is no bond: two blocks as if they were one, sheared and pulled; (2) two hard blocks pulled
and sheared apart, traction and energy by the bilinear law in closed form; (3) both at once, energy by Benzeggagh and
Kenane and by the power law; (4) unloaded and loaded again: along the secant; (5) a double cantilever beam against beam
theory with the fracture energy.
Tolerance: (1) 1e-6; (2) to (4) 2e-3 and 1e-6, since the blocks are 1e4 times as stiff as the bond, and the energy that
was spent does not depend on them; (5) 2 %, the thickness of the arms over the length of the flaw squared, the zone of
damage, and elements of 0.5 mm; on twice as long elements the load rises and falls by 4 %.
"""

import numpy as np
import pytest

import turgor as tg
from bond_cases import BOND, OPENING, SIDE, beam_loads, cube, double_cantilever, pulled, tractions
from turgor.core.engine.bonds.bond_results import BondResult, bond_results

PEEL_END = 2 * BOND["energy_peel"] / BOND["peel_strength"]
SHEAR_END = 2 * BOND["energy_shear"] / BOND["shear_strength"]


def test_a_stiff_bond_is_no_bond(record_verification):
    soft, stiff = (tg.Material(name=n, law=tg.laws.NeoHooke(C10=c)) for n, c in (("soft", 50e3), ("stiff", 150e3)))
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), peel_strength=1e6, energy_peel=1e4, stiffness=1e14)
    load = tg.Traction("z1", (5e3, 0.0, 20e3))
    tips = []
    for bonds in ((), glue):
        model = tg.Model(cube((2, 2, 2)), {"low": soft, "high": stiff}, "z0", load, bonds=bonds)
        state = tg.solve(model, progress=False).states[-1]
        tips.append(state.displacement[state.model.mesh.face_nodes("z1")].mean(axis=0))
    off = np.abs(tips[1] - tips[0]).max() / np.abs(tips[0]).max()
    record_verification("displacement with a stiff bond over that without", "one body", 1.0, 1.0 + off, "1e-6")
    assert off < 1e-6


def glue_in(state) -> BondResult:
    return bond_results(state.model, state.displacement, state.memory)["glue"]


def closed_form(opening, strength, end):
    """Traction of the bilinear law with the stiffness of the bond in peel, (n,)."""
    first = strength / (BOND["stiffness"] * (strength / BOND["peel_strength"]) ** 2)
    rising, falling = strength * opening / first, strength * (end - opening) / (end - first)
    return np.where(opening < first, rising, np.maximum(falling, 0.0))


@pytest.mark.parametrize(("axis", "strength", "end"), [(2, 20e3, PEEL_END), (0, 30e3, SHEAR_END)])
def test_peel_and_shear_follow_the_bilinear_law(axis, strength, end, record_verification):
    move = np.zeros(3)
    move[axis] = 1.2 * end
    solution = tg.solve(pulled(tuple(move)), progress=False)
    expected = closed_form(np.array([s.load_factor for s in solution.states]) * 1.2 * end, strength, end)
    assert tractions(solution)[:, axis] == pytest.approx(expected, abs=2e-3 * strength)
    spent = tg.measure(solution, "glue_peel_energy")["glue_peel_energy"][-1] / SIDE**2
    energy, mode = BOND["energy_shear" if axis == 0 else "energy_peel"], "shear" if axis == 0 else "peel"
    record_verification(f"energy of a bond in {mode} [J/m²]", "exact", energy, spent, "1e-6")
    assert spent == pytest.approx(energy, rel=1e-6)


@pytest.mark.parametrize("rule", ["benzeggagh-kenane", "power"])
def test_both_at_once_spend_the_mixed_energy(rule, record_verification):
    model = pulled((1.2 * SHEAR_END, 0.0, 1.2 * SHEAR_END), mixed_mode=rule, exponent=2.0)
    at = tg.solve(model, progress=False).states[-1]
    share = (BOND["shear_strength"] / BOND["peel_strength"]) ** 2  # of the stiffness in shear and in peel
    share /= 1 + share
    peel, shear = BOND["energy_peel"], BOND["energy_shear"]
    bk, power = peel + (shear - peel) * share**2, (((1 - share) / peel) ** 2 + (share / shear) ** 2) ** -0.5
    energy = bk if rule == "benzeggagh-kenane" else power
    spent = glue_in(at).energy.mean()
    record_verification(f"energy of a bond in peel and shear, {rule} [J/m²]", "exact", energy, spent, "2e-3")
    assert spent == pytest.approx(energy, rel=2e-3)


def test_unloading_goes_along_the_secant():
    model = pulled((0.0, 0.0, 0.5 * PEEL_END), history=((0, 0), (0.4, 1), (0.6, 0.2), (1, 1)))
    solution = tg.solve(model, tg.Static(at=(0.4, 0.5, 0.6, 0.8)), progress=False)
    by_load = {round(s.load_factor, 6): t for s, t in zip(solution.states, tractions(solution)[:, 2], strict=True)}
    top = by_load[0.4]
    assert top == pytest.approx(closed_form(np.array(0.5 * PEEL_END), 20e3, PEEL_END), rel=2e-3)
    assert by_load[0.5] == pytest.approx(0.6 * top, rel=2e-3)
    assert by_load[0.6] == pytest.approx(0.2 * top, rel=2e-3)
    assert by_load[0.8] == pytest.approx(0.6 * top, rel=2e-3)
    assert by_load[1.0] == pytest.approx(top, rel=2e-3)
    first = BOND["peel_strength"] / BOND["stiffness"]
    spent = BOND["energy_peel"] * (0.5 * PEEL_END - first) / (PEEL_END - first)  # between curve and secant
    assert glue_in(solution.states[-1]).energy.mean() == pytest.approx(spent, rel=2e-3)


def test_closed_sides_press_after_opening():
    model = pulled((0.0, 0.0, 1.2 * PEEL_END), history=((0, 0), (0.5, 1), (1, -1e-3)))
    solution = tg.solve(model, tg.Static(at=(0.5,)), progress=False)
    assert (
        bond_results(solution.states[-1].model, solution.states[-1].displacement, solution.states[-1].memory)[
            "glue"
        ].damage.min()
        == 1.0
    )
    pressed = tractions(solution)[-1, 2]
    assert pressed == pytest.approx(-1.2e-3 * PEEL_END * BOND["stiffness"], rel=2e-3)  # as stiff as before


def test_a_double_cantilever_beam_peels_at_the_load_of_beam_theory(record_verification):
    worst = {}
    for cells in (30, 60):
        solution = tg.solve(double_cantilever(cells), progress=False)
        assert solution.converged
        up = solution.model.mesh.face_nodes("up")
        opening = np.array([state.load_factor for state in solution.states]) * OPENING
        load = np.array([state.nodal_force[up, 2].sum() for state in solution.states])
        stays, peels = beam_loads(opening[1:])
        assert load[1] == pytest.approx(stays[0], rel=0.02)
        running = np.array([glue_in(s).opened.any() for s in solution.states[1:]])
        off = np.abs(load[1:] / peels - 1)[running & (peels < stays)]
        assert len(off) > 2
        worst[cells] = float(off.max())
    record_verification("load of a peeling double cantilever beam over beam theory", "exact", 1.0, 1 + worst[60], "2 %")
    assert worst[60] < 0.02
    assert worst[60] < worst[30] < 0.05
