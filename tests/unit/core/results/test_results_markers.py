"""Markers: they move with the surface, turn with it where they stand beside it, and are mirrored with the part."""

from dataclasses import replace

import numpy as np
import pytest

import meshes
import turgor as tg
from refused import refused
from turgor.core.engine.faces import attached
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.results.measures.markers import _attached, check_markers, marker
from turgor.units import kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6))


@pytest.fixture(scope="module", params=["tetrahedra", "hexahedra"])
def rest(request):
    """A half finger at rest, as a state."""
    part = tg.FastPneuNet(chambers=1, length=10 * mm, symmetric=True).build()
    mesh = tg.mesh(part, size=3 * mm, cells=request.param)
    model = tg.Model(mesh, {"body": RUBBER, "base": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1.0 * kPa)])
    return tg.solve(model, tg.Static(first_step=1.0)).states[0]


def moved(state, motion):
    """The state with every point moved by a function of its position."""
    points = state.model.mesh.points
    return replace(state, displacement=motion(points) - points)


def at(name, point, state):
    return np.array([each(state) for each in marker(name, point)])


def test_the_surface_is_sampled_once_for_all_markers(rest, monkeypatch):
    """Thousands of markers took minutes, each of which looked at the whole surface."""
    sampled = []
    monkeypatch.setattr(attached, "_places", lambda count, places=attached._places: sampled.append(1) or places(count))
    attached._surface.cache_clear()
    mesh = rest.model.mesh
    check_markers(mesh, {f"m{n}": tuple(mesh.points[n]) for n in range(20)})
    assert len(sampled) == 1


def turned(axis, angle):
    cross = np.cross(np.eye(3), np.asarray(axis) / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@pytest.mark.parametrize("place", [(10, 3, 2), (10, 2.345, 1.77), (0, 10, 0)])
def test_a_marker_on_the_surface_moves_with_it(rest, place):
    point = np.array(place) * mm
    stretch = np.eye(3) + 0.1 * np.arange(9).reshape(3, 3) / 9
    assert at("dot", point, rest) == pytest.approx(point, abs=1e-12)
    got = at("dot", point, moved(rest, lambda x: x @ stretch.T + [1e-3, 0, 2e-3]))
    assert got == pytest.approx(stretch @ point + [1e-3, 0, 2e-3], abs=1e-12)


def test_a_marker_beside_the_surface_turns_with_it(rest):
    point = np.array([11.5, 2, 3]) * mm
    rotation = turned((1, 2, 3), 1.2)
    got = at("ball", point, moved(rest, lambda x: x @ rotation.T + [0, 1e-3, 0]))
    assert got == pytest.approx(rotation @ point + [0, 1e-3, 0], abs=1e-12)


def test_the_mirror_image_of_a_marker(rest):
    """What moves towards y on the modeled half moves against it on the other one."""
    pulled = moved(rest, lambda x: x * [1.1, 1.2, 1.0])
    there, here = (at("dot", np.array([10, sign * 3, 2]) * mm, pulled) for sign in (-1, 1))
    assert there == pytest.approx(here * [1, -1, 1], abs=1e-15)
    assert there[1] == pytest.approx(-3.6 * mm)


def test_markers_are_columns(rest):
    solution = tg.solve(rest.model, tg.Static(first_step=1.0))
    response = tg.measure(solution, *tg.measures.marker("tip", (10 * mm, 0, 5 * mm)), mesh_error=False)
    assert response.names[-3:] == ("tip_x", "tip_y", "tip_z")
    assert response["tip_x"][0] == pytest.approx(10 * mm)
    assert response["tip_x"][-1] != response["tip_x"][0]
    assert response["tip_y"][-1] == pytest.approx(0, abs=1e-9)


def test_sides_of_eight_nodes_bend_as_their_shape_functions_say():
    whole = meshes.box((1.0, 1.0, 1.0), (1, 1, 1), kind=HEXAHEDRON)
    cells, faces = whole.cells[:, :20], {name: sides[:, :8] for name, sides in whole.faces.items()}
    used, number = np.unique(cells), np.zeros(len(whole.points), dtype=np.int64)
    number[used] = np.arange(len(used))
    mesh = tg.Mesh(
        points=whole.points[used],
        cells=number[cells],
        regions=whole.regions,
        faces={name: number[sides] for name, sides in faces.items()},
    )
    fixed = _attached(mesh, "dot", (0.3, 0.4, 1.0), ())
    assert fixed.position(mesh.points) == pytest.approx((0.3, 0.4, 1.0))
    bent = mesh.points + mesh.points[:, :1] ** 2 * [0, 0, 0.1]  # eight nodes follow a square exactly
    assert fixed.position(bent) == pytest.approx((0.3, 0.4, 1.009))


@pytest.mark.parametrize(
    ("name", "point", "facts"),
    [
        ("dot", (1.0, 2.0), ("'dot'", "(1.0, 2.0)", "three coordinates")),
        ("dot", (np.nan, 0, 0), ("'dot'", "(nan, 0, 0)", "three coordinates")),
        ("my dot", (0, 0, 0), ("'my dot_x'", "underscores")),
    ],
)
def test_what_is_no_marker(name, point, facts):
    with refused(*facts):
        marker(name, point)


def test_a_marker_far_away_is_a_mistake_of_units(rest):
    with refused("dot_x", "'dot'", "(1e+04, 0, 0) mm", "9990 mm", "(10, 0, 0) mm", "3.75 mm"):
        at("dot", (10.0, 0.0, 0.0), rest)
