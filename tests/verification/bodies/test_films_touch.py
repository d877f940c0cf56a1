"""Films that touch each other: two sides of a pouch, and two pouches.

Pouch without air: a pouch of two flat films that lie on each other from the start. With less pressure inside than
outside they press on each other with the difference, everywhere. Exact. Tolerance: 1e-3 of the pressure; nothing moves
by more than the penalty allows.

Lens: two arcs of a film between two seams of which one may slide. Emptied, the arcs lie flat on each other: they
enclose nothing, and press on each other with the pressure, whichever side of the film is said to look into the cavity.
Exact: no volume is left, and each arc has its length at rest, R times its angle. Tolerance: 1e-3 of each.

Two tubes: halves of two strips without stretch at the distance 2 H, inflated towards each other. By symmetry they meet
in the middle as on a plate (`test_films_alone`): each has the length b + π H, lies on the other over b, and pushes with
p b w. Tolerance: 1 % of the force.
"""

from dataclasses import replace

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.system import System
from turgor.units import MPa, kPa, mm

LENGTH, WIDTH, RISE = 50 * mm, 5 * mm, 4 * mm
FILM = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=588 * MPa, nu=0.4)), 0.1 * mm, compression=0.0)


def _patch(corners, edges, name, upper=True, arcs=(None,) * 4):
    """A film with its cavity below it; corners in turn, clockwise from above. ``upper=False``: above it."""
    if not upper:
        corners, edges, arcs = corners[:1] + corners[:0:-1], edges[::-1], arcs[::-1]
    return tg.bodies.Patch(corners=tuple(corners), faces=("cavity", name), edges=tuple(edges), arcs=tuple(arcs))


def _flat(cells):
    """A quarter of a square pouch, its two films on each other."""
    a = LENGTH
    corners, edges = ((0, 0, 0), (0, a, 0), (a, a, 0), (a, 0, 0)), ("symmetry_x", "rim", "rim", "symmetry_y")
    patches = [_patch(corners, edges, name, name == "upper") for name in ("upper", "lower")]
    return tg.mesh(tg.bodies.Film(patches=tuple(patches)), size=a / cells)


def test_a_flat_pouch_without_air(record_verification):
    mesh, pressure = _flat(2), 5 * kPa
    model = tg.Model(mesh, {"cavity": FILM}, [tg.Fixed("rim", "z")], [tg.Pressure("cavity", -pressure)])
    state = problems.solve(model).states[-1]
    touch = state.touches["self"]
    got = [float(touch.pressure.max()) / kPa, touch.area / mm**2]
    record_verification(
        claim="flat pouch of two films, emptied: largest contact pressure [kPa], area of both films [mm²]",
        source="exact",
        expected=[5, 5000],
        got=got,
        tolerance="1e-3",
    )
    assert got == pytest.approx([5, 5000], rel=1e-3)
    assert np.abs(state.displacement).max() < 0.01 * LENGTH / 2 / 2  # half of the penetration allowed


def _lens(cells, within):
    radius = (LENGTH**2 / 4 + RISE**2) / (2 * RISE)
    patches = []
    for name, sign in (("upper", 1), ("lower", -1)):
        corners = ((0, 0, 0), (0, WIDTH, 0), (LENGTH, WIDTH, 0), (LENGTH, 0, 0))
        arcs = [None if y is None else (LENGTH / 2, y, sign * (RISE - radius)) for y in (None, WIDTH, None, 0.0)]
        patches.append(_patch(corners, ("left", "side", "right", "symmetry_y"), name, (sign > 0) == within, arcs))
    return tg.mesh(tg.bodies.Film(patches=tuple(patches)), size=LENGTH / cells)


def _lens_model(pressure, cells=8, within=True):
    supports = [tg.Fixed("side", "y"), tg.Fixed("left", "xz"), tg.Fixed("right", "z")]
    return tg.Model(_lens(cells, within), {"cavity": FILM}, supports, [tg.Pressure("cavity", pressure)])


@pytest.mark.parametrize("within", [True, False], ids=["cavity within", "cavity outside"])
def test_an_emptied_lens_lies_flat(within, record_verification):
    model = _lens_model(-2 * kPa if within else 2 * kPa, within=within)
    state = problems.solve(model).states[-1]
    rest = cavity_volume(model.mesh, "cavity", np.zeros_like(model.mesh.points))
    left = cavity_volume(model.mesh, "cavity", state.displacement)
    touch = state.touches["self"]
    radius = (LENGTH**2 / 4 + RISE**2) / (2 * RISE)
    expected = [0, 2, 2 * radius * np.arcsin(LENGTH / 2 / radius) / LENGTH]
    got = [left / rest, float(touch.pressure.max()) / kPa, touch.area / (2 * LENGTH * WIDTH)]
    record_verification(
        claim=f"lens of film, cavity {'within' if within else 'outside'}, emptied: volume left over that at rest, "
        "largest contact pressure [kPa], area over length times width",
        source="exact",
        expected=expected,
        got=got,
        tolerance="1e-3",
    )
    assert got == pytest.approx(expected, abs=1e-3)


def _strips(height, cells):
    """Two strips at twice a height from each other, fixed at one end."""
    patches = []
    for name, z in (("lower", 0.0), ("upper", 2 * height)):
        corners = ((0, 0, z), (0, WIDTH, z), (LENGTH, WIDTH, z), (LENGTH, 0, z))
        patches.append(_patch(corners, ("left", "side", "right", "symmetry_y"), name, name == "lower"))
    return tg.mesh(tg.bodies.Film(patches=tuple(patches)), size=LENGTH / cells)


def test_two_tubes_press_on_each_other(record_verification):
    pressure, height = 2 * kPa, 8 * mm
    mesh = _strips(height, 12)
    supports = [tg.Fixed("side", "y"), tg.Fixed("left", "xz"), tg.Fixed("right", "z")]
    model = tg.Model(mesh, {"cavity": FILM}, supports, [tg.Pressure("cavity", pressure)])
    state = problems.solve(model).states[-1]
    expected = pressure * (LENGTH - np.pi * height) * WIDTH
    got = float(state.touches["self"].force[mesh.face_nodes("upper"), 2].sum())
    record_verification(
        claim="two tubes of film that press on each other: force [N]",
        source="exact for a film without stretch",
        expected=expected,
        got=got,
        tolerance="1 %",
    )
    assert got == pytest.approx(expected, rel=0.01)
    assert state.touches["self"].force.sum(axis=0) == pytest.approx(0, abs=1e-9 * expected)


def test_the_tangent_is_the_derivative_of_the_forces(record_verification):
    """At a state with noise, two strips pressed 10 µm into each other; tolerance: 1e-5 of the largest entry."""
    height = 0.5 * mm
    mesh = _strips(height, 4)
    films, rng = {"cavity": FILM}, np.random.default_rng(5)
    both = [
        System(tg.Model(mesh, films, [tg.Fixed("side", "y")], [], contact=tg.Contact(own))) for own in (True, False)
    ]
    u = rng.normal(0, 2e-6, mesh.points.shape)
    u[mesh.face_nodes("upper"), 2] -= 2 * height + 10e-6
    x, free = (u / both[0].length).ravel(), np.flatnonzero(~both[0].prescribed)
    assert both[0].evaluate(x, 1.0).contacts.touch
    along = np.zeros(len(x))
    along[free] = rng.normal(0, 1, len(free))
    h = 1e-7
    exact, got = np.zeros(len(x)), np.zeros(len(x))
    for system, sign in zip(both, (1, -1), strict=True):
        exact += sign * (system.residual(x + h * along, 1.0) - system.residual(x - h * along, 1.0)) / (2 * h)
        got += sign * (system.tangent(x, 1.0) @ along)
    error = float(np.abs(got - exact)[free].max() / np.abs(exact[free]).max())
    record_verification(
        claim="tangent of contact of two films along a random direction against differences, over its largest entry",
        source="differences",
        expected=0.0,
        got=error,
        tolerance="1e-5",
    )
    assert error < 1e-5


def test_a_lens_opens_again(record_verification):
    """Emptied and then inflated, it is what it is when it is inflated at once: nothing sticks, nothing has crossed."""
    model = _lens_model(2 * kPa, cells=6)
    volumes = []
    for history in (((0, 0), (0.5, -1), (1, 1)), ((0, 0), (1, 1))):
        loaded = replace(model, loads=[tg.Pressure("cavity", 2 * kPa, history)])
        state = problems.solve(loaded, tg.Static(max_step=0.5)).states[-1]
        volumes.append(cavity_volume(model.mesh, "cavity", state.displacement) * 1e9)
    record_verification(
        claim="lens of film, emptied and then inflated: volume [mm³]",
        source="the same, inflated at once",
        expected=volumes[1],
        got=volumes[0],
        tolerance="1e-4",
    )
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-4)
    assert volumes[1] > 3000
