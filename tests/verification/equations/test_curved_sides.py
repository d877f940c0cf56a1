"""V24: curved sides make the radius of a pressurized tube and sphere converge fast, straight ones slowly.

Problem: the tube of V05 (0.05 MPa) and the sphere of V04 (0.10 MPa), neo-Hookean, with quadratic cells whose
mid-side nodes lie on the circle, or half way between the vertices. Value: inner stretch, from the volume of the
cavity, which a few nodes on the circle cannot flatter.
Exact: `exact.tube_stretch`, `exact.sphere_stretch`.
Tolerance: the error falls at least eightfold per halving of the cells with curved sides, and only about fourfold
(between 3 and 6) with straight ones, whose geometry is wrong by a share of h². At equal cells the straight error is at
least ten times the curved one.
"""

import numpy as np
import pytest

import exact
import meshes
import problems
import turgor as tg
from turgor.core.engine.faces.surfaces import enclosed_volume

MM, MPA = problems.MM, problems.MPA


def _tube(count, straight):
    mesh = meshes.tube_sector(5 * MM, 7 * MM, 1 * MM, (count, 2 * count, 1), straight=straight)
    state = _inflate(mesh, 0.05 * MPA, problems.PLANE_STRAIN)
    area = 4 * _enclosed(state) / (1 * MM) / MM**2
    return np.sqrt(area / np.pi) / 5 - exact.tube_stretch(problems.NEO_HOOKE, 0.05 * MPA, 5, 7)


def _sphere(count, straight):
    mesh = meshes.sphere_octant(10 * MM, 15 * MM, count, count, straight=straight)
    volume = 8 * _enclosed(_inflate(mesh, 0.10 * MPA, ())) / MM**3
    return (3 * volume / (4 * np.pi)) ** (1 / 3) / 10 - exact.sphere_stretch(
        problems.NEO_HOOKE, 0.10 * MPA, 10, 15, 1.6
    )


def _enclosed(state):
    return -enclosed_volume(problems.current(state), state.model.mesh.face("cavity"))


def _inflate(mesh, pressure, supports):
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[tg.Pressure("cavity", pressure)])
    return problems.solve(model, tg.Static(first_step=0.25, tolerance=1e-10)).states[-1]


@pytest.mark.parametrize("body", [_tube, _sphere], ids=["tube", "sphere"])
def test_error_with_curved_and_straight_sides(body, record_verification):
    curved = [abs(body(count, straight=False)) for count in (1, 2, 4)]
    straight = [abs(body(count, straight=True)) for count in (1, 2, 4)]
    ratios = [[errors[k] / errors[k + 1] for k in range(2)] for errors in (curved, straight)]
    record_verification(
        claim=f"{body.__name__[1:]}: error of the inner stretch falls per halving, curved sides",
        source="V24, cubic or better",
        expected="at least 8",
        got=ratios[0],
        tolerance="8",
    )
    record_verification(
        claim=f"{body.__name__[1:]}: error of the inner stretch falls per halving, straight sides",
        source="V24, geometry error of h²",
        expected=4.0,
        got=ratios[1],
        tolerance="3 to 6",
    )
    assert min(ratios[0]) >= 8
    assert 3 < min(ratios[1]) <= max(ratios[1]) < 6
    assert all(bad > 10 * good for bad, good in zip(straight, curved, strict=True))
