"""V16: a wall that faces only its own image in a mirror plane is stopped there automatically.

Problem: half of a fork: a leg of 10 × 3 × 20 mm, 1 mm from the mirror plane y = 0, on a foot that reaches the plane;
pressed towards the plane from outside. Nothing is said about contact.
Exact: the leg does not pass the plane, and no finding says that walls met. Source: the whole fork, of which both legs
would meet there. Tolerance: 0.05 mm.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from meshes import Block
from problems import MM
from turgor.core.meshing.quality.mirror_gap import faces_its_image
from turgor.core.model.contact import Contact

FOOT = {"y0": "symmetry_y", "z0": "fixed"}


def _part(low, size, lean=0.0):
    """Where a lattice lies: from ``low`` on, of a size, leaning away from the plane towards its top [mm]."""

    def place(p):
        p = np.asarray(p, dtype=float)
        return (np.array(low) + p * size + np.stack([0 * p[..., 2], lean * p[..., 2], 0 * p[..., 2]], axis=-1)) * MM

    return place


def _fork(gap=1.0):
    """Half of a fork whose leg stands ``gap`` [mm] from the plane."""
    leg = Block((2, 1, 4), _part((0, gap, 0), (10, 3, 20)), {"y1": "pressed", "z0": "fixed"})
    return meshes.glued([leg, Block((2, 1, 1), _part((0, 0, 0), (10, gap, 5)), FOOT)])


def _funnel():
    """Half of a groove whose wall runs into the plane."""
    foot = Block((2, 1, 1), _part((0, 0, -5), (10, 3, 5)), FOOT)
    return meshes.glued([foot, Block((2, 1, 4), _part((0, 0, 0), (10, 3, 20), lean=4), {"y1": "pressed"})])


def test_contact_is_on_by_itself():
    assert faces_its_image(_fork())
    assert Contact().for_mesh(_fork()) is not None
    assert Contact(self_contact=False).for_mesh(_fork()) is None


@pytest.mark.parametrize("gap", [4.0, 8.0])
def test_far_away_it_stays_off(gap):
    assert not faces_its_image(_fork(gap))
    assert Contact().for_mesh(_fork(gap)) is None


def test_a_wall_that_runs_into_the_plane_is_left_alone():
    assert not faces_its_image(_funnel())


def test_a_whole_body_has_no_image():
    assert not faces_its_image(meshes.box((10 * MM, 3 * MM, 20 * MM), (2, 1, 4)))


def test_a_leg_stops_at_its_image(record_verification):
    mesh = _fork()
    loads = [tg.Pressure("pressed", 12e3)]
    rubber = {name: problems.rubber(problems.NEO_HOOKE) for name in mesh.regions}
    model = tg.Model(mesh, rubber, [tg.Fixed("fixed"), tg.supports.Symmetry("symmetry_y")], loads)
    solution = tg.solve(model)
    lowest = [float((mesh.points + state.displacement)[:, 1].min()) for state in solution.states]
    record_verification(
        claim="leg of a half fork pressed towards the mirror plane: how far it passes the plane [mm]",
        source="V16, the whole fork",
        expected=0.0,
        got=-min(lowest) / MM,
        tolerance="0.05 mm",
    )
    assert solution.states[-1].touches["self"].area > 0
    assert min(lowest) > -0.05 * MM
    assert not [each for each in solution.findings if each.code == "B02"]
