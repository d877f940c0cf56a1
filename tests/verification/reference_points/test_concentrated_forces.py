"""Forces at points and along edges have the resultant that they state, also on a half with its mirror image.

Problem: a bar of 40 x 10 x 10 mm of tetrahedra and of hexahedra with 20 and 27 nodes. A force acts within a side of the
surface, another one on its mirror plane, and a force per length along an edge.
Exact: the sum of the nodal forces is the force, their moment that of a force at the point; the line carries its force
per length times its length, with the center of the edge. Tolerance: 1e-12, round-off.
"""

import numpy as np
import pytest
from turgor.loads import Force, LineForce, PointForce

import problems
import rig
import turgor as tg
from refused import refused
from turgor.core.engine.faces.concentrated import line_force, point_force
from turgor.core.meshing.cells import HEXAHEDRON, HEXAHEDRON_20, TETRAHEDRON

FORCE = (0.3, -0.2, 0.5)


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON, HEXAHEDRON_20], ids=["tet", "hex", "hex 20"])
def test_a_force_acts_at_its_point(kind, record_verification):
    mesh, at = rig.bar(kind), (13e-3, 1.7e-3, rig.SIDE)
    forces = point_force(mesh, at, FORCE)
    moment = np.cross(mesh.points, forces).sum(axis=0)
    record_verification(
        f"sum of the nodal forces of a point force, {kind.nodes} nodes [N]", "statics", FORCE,
        forces.sum(axis=0).tolist(), "1e-12",
    )  # fmt: skip
    assert forces.sum(axis=0) == pytest.approx(FORCE, abs=1e-12)
    assert moment == pytest.approx(np.cross(at, FORCE), abs=1e-12)
    assert (np.abs(forces).sum(axis=1) > 1e-12).sum() <= mesh.cell_type.side.nodes


@pytest.mark.parametrize("kind", [TETRAHEDRON, HEXAHEDRON, HEXAHEDRON_20], ids=["tet", "hex", "hex 20"])
def test_a_line_carries_its_length(kind):
    mesh = rig.bar(kind)
    forces = line_force(mesh, ("x1", "z1"), (0.0, 2.0, -3.0))
    assert forces.sum(axis=0) == pytest.approx(np.array([0.0, 2.0, -3.0]) * rig.SIDE, abs=1e-14)
    middle = np.array([rig.LENGTH, 0.0, rig.SIDE])
    assert np.cross(mesh.points - middle, forces).sum(axis=0) == pytest.approx(0.0, abs=1e-14)


def test_half_a_bar_carries_half_of_them():
    half, whole = rig.bar(HEXAHEDRON, half=True), rig.bar(HEXAHEDRON)
    on_plane = PointForce((13e-3, 0.0, rig.SIDE), (0.3, 0.0, 0.5))
    assert 2 * point_force(half, on_plane.at, on_plane.vector).sum(axis=0) == pytest.approx(on_plane.vector, abs=1e-12)
    aside = PointForce((13e-3, -1.7e-3, rig.SIDE), FORCE)  # on the side of the mirror image
    assert point_force(half, aside.at, aside.vector).sum(axis=0) == pytest.approx([0.3, 0.2, 0.5], abs=1e-12)
    line = LineForce(("x1", "z1"), (0.0, 0.0, -3.0))
    of_half, of_whole = (line_force(mesh, line.faces, line.vector).sum(axis=0) for mesh in (half, whole))
    assert 2 * of_half == pytest.approx(of_whole, abs=1e-14)
    with refused("(13, 0, 10) mm", "normal to y"):
        point_force(half, (13e-3, 0.0, rig.SIDE), FORCE)
    with refused("'x1' and 'z1'", "normal to y"):
        line_force(half, ("x1", "z1"), (0.0, 1.0, 0.0))


def test_they_bend_a_bar_as_a_force_on_its_end():
    bars = [
        tg.Model(rig.bar(HEXAHEDRON), {"body": problems.rubber(problems.NEO_HOOKE)}, [tg.Fixed("x0")], [load])
        for load in (
            Force("x1", (0.0, 0.0, -0.02)),
            LineForce(("x1", "z1"), (0.0, 0.0, -2.0)),
            PointForce((rig.LENGTH, 0.0, rig.SIDE), (0.0, 0.0, -0.02)),
        )
    ]
    ends = [
        problems.current(problems.solve(model).states[-1])[model.mesh.face_nodes("x1")].mean(axis=0) for model in bars
    ]
    sag = rig.SIDE / 2 - ends[0][2]
    assert sag > 0.5e-3
    assert [rig.SIDE / 2 - end[2] for end in ends] == pytest.approx([sag] * 3, rel=0.02)


def test_what_is_beside_the_surface_is_refused():
    with refused("(20, 0, 12) mm", "2 mm", "0.4 mm"):
        point_force(rig.bar(), (20e-3, 0.0, 12e-3), FORCE)
    with refused("'x0' and 'x1'", "edge"):
        line_force(rig.bar(), ("x0", "x1"), FORCE)
    with refused("('x1', 'x1')", "two faces"):
        LineForce(("x1", "x1"), FORCE)
    with refused("'z2'", "x0, x1"):
        rig.rig(tg.Fixed("x1"), loads=[LineForce(("x1", "z2"), FORCE)])
