"""Row of pouches in series, as in a textile muscle: contraction under a weight, and force against dV/dL.

Exact for a film that does not stretch and is much wider than long (Niiyama et al. 2015, Soft Robotics 2, 59): each
pouch bulges to two arcs of the half angle θ and is l sin θ / θ long; a row of n pouches gets shorter by
n l (1 − sin θ / θ) and pulls with p l w cos θ / θ, however many they are. The row of the family, with its sides free to
rise, as if it were endless across. With 8 sides along a pouch the contraction is 0.5 % too small, with 16 as well: the
film is up to 0.05 % longer, which keeps the solver regular. Tolerance: 1 % of the contraction, twice that error.

Work: while the weight grows from state to state, the pressure does the work p ΔV on it. Its mean over a step is
−p ΔV / Δx by the trapezoidal rule. It is 0.7 to 1.4 % too small in ten steps, the more the weight stretches the film,
whose energy is not in the balance. Tolerance: 2 %.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.units import GPa, kPa, mm

LENGTH, WIDTH, SEAM, PRESSURE = 20 * mm, 4 * mm, 2 * mm, 10 * kPa


def _row(count, cells):
    """A row of the family between mirror planes across: its sides are a face of their own and may rise."""
    part = tg.actuators.Pouch(length=LENGTH, width=WIDTH, seam=SEAM, count=count)
    free = [replace(patch, edges=("", "side", "", patch.edges[3])) for patch in part.build().shape.patches]
    return tg.mesh(tg.bodies.Film(patches=tuple(free)), size=LENGTH / cells)


def _pulled(mesh, force, loaded=((0, 0), (1, 1)), pressed=((0, 0), (1, 1)), step=0.2):
    film = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=4 * GPa, nu=0.3)), 50e-6, compression=0.0)
    loads = [tg.Pressure("cavity", PRESSURE, pressed), tg.loads.Force("tip", (force, 0, 0), history=loaded)]
    return problems.solve(
        tg.Model(mesh, {"film": film, "seams": film}, ["fixed", tg.Fixed("side", "y")], loads), tg.Static(max_step=step)
    )


def _force(theta):
    return PRESSURE * LENGTH * WIDTH * np.cos(theta) / theta


def _tip(state):
    return float(state.displacement[state.model.mesh.face_nodes("tip"), 0].mean())


@pytest.mark.parametrize(("count", "cells"), [(1, 8), (3, 8), pytest.param(3, 16, marks=pytest.mark.slow)])
def test_contraction_of_a_row_under_a_weight(count, cells, record_verification):
    theta = 1.0
    state = _pulled(_row(count, cells), _force(theta)).states[-1]
    got, expected = -_tip(state), count * LENGTH * (1 - np.sin(theta) / theta)
    record_verification(
        claim=f"row of {count} pouches, {cells} sides along each, under a weight: contraction [mm]",
        source="Niiyama et al. 2015, exact",
        expected=expected / mm,
        got=got / mm,
        tolerance="1 %",
    )
    assert got == pytest.approx(expected, rel=0.01)


def test_force_is_pressure_times_the_change_of_volume(record_verification):
    most = _force(0.5)
    solution = _pulled(_row(2, 8), most, ((0, 0), (0.5, 0.2), (1, 1)), ((0, 0), (0.5, 1), (1, 1)), 0.05)
    states = [state for state in solution.states if state.load_factor >= 0.5]
    assert len(states) >= 10
    for a, b in pairwise(states):
        forces = [most * (0.2 + 0.8 * (state.load_factor - 0.5) / 0.5) for state in (a, b)]
        volumes = [cavity_volume(state.model.mesh, "cavity", state.displacement) for state in (a, b)]
        got = PRESSURE * (volumes[0] - volumes[1]) / (_tip(b) - _tip(a))
        assert got == pytest.approx(np.mean(forces), rel=0.02)
    record_verification(
        claim="row of two pouches: force of −p dV/dL over the last step [N]",
        source="work, exact for a film without stretch",
        expected=float(np.mean(forces)),
        got=float(got),
        tolerance="2 %",
    )
