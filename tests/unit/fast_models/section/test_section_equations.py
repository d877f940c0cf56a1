"""Equations of a section: gradients and tangents of all its parts, its conditions, its symmetric halves."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from turgor.fast_models.section.equations import Equations, Question, Unknowns
from turgor.fast_models.section.kinematics import skew
from turgor.fast_models.section.outlines.loops import Loop
from turgor.fast_models.section.path import follow
from turgor.fast_models.section.shapes.slices import slice_of_geometry
from turgor.units import deg, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.MooneyRivlin(C10=0.10e6, C01=0.02e6))
SOFT = tg.Material(name="soft", law=tg.laws.Ogden(mu=(20e3,), alpha=(3.0,)), bulk_modulus=1e6)
PAPER = tg.Material(name="paper", law=tg.laws.Hooke(E=50e6, nu=0.3))
SQUARE = tg.sections.rectangle((-4 * mm, 4 * mm), (0, 6 * mm))
AIR = tg.sections.rectangle((-2 * mm, 2 * mm), (2 * mm, 4 * mm))
SKETCH = tg.sections.Sketch(
    areas={"body": SQUARE, "base": tg.sections.rectangle((-4 * mm, 4 * mm), (0, 1 * mm)), "cavity": AIR},
    lines={"paper": ("z", 1 * mm), "top": ("z", 6 * mm)},
)
THREADS = tg.Fibers(
    face=("outside", "top"), material=PAPER, diameter=0.2 * mm, compression=0.5,
    winding=tg.Winding(angle_from_axis=70 * deg, spacing=1 * mm),
)  # fmt: skip
PARTS = {
    "two rubbers": {},
    "membrane": {"paper": tg.Membrane(PAPER, 0.1 * mm)},
    "wrinkling sheet": {"top": tg.Membrane(PAPER, 0.1 * mm, compression=0.1)},
    "shell": {"paper": tg.Shell(PAPER, 0.3 * mm)},
}


FREE = np.full(4, np.nan)
PRESSED = Question(pressures=np.array([0.3]), volumes=np.array([np.nan]), strains=FREE, forces=np.zeros(4))


def equations(more=None, fibers=(), supports=(), closed=True):
    mesh = slice_of_geometry(SKETCH.geometry, 4 * mm)
    model = tg.Model(mesh, {"body": RUBBER, "base": SOFT, **(more or {})}, supports, [], reinforcements=fibers)
    return Equations(model, closed)


def somewhere(made):
    """A state near rest, all of whose unknowns differ from zero."""
    rest, random = made.rest, np.random.default_rng(1)
    return Unknowns(
        y=rest.y * [1.0, 1.1, 1.05] + 0.02 * random.normal(size=rest.y.shape),
        strains=np.array([1.08, 0.05, 0.08, -0.06]),
        p=0.1 * random.normal(size=rest.p.shape),
        multipliers=random.normal(size=rest.multipliers.shape),
        pressures=np.array([0.3]),
    )


def moved(made, at, direction, step):
    """A state a step away along a direction of all unknowns."""
    numbers = made.numbers
    change = step * direction
    first, mean, last = numbers.first_strain, numbers.first_mean, numbers.first_multiplier
    y = at.y + np.einsum("nij,ni->nj", numbers.axes, change[:first].reshape(-1, 3))
    return Unknowns(
        y=y,
        strains=at.strains + change[first:mean],
        p=at.p + change[mean:last],
        multipliers=at.multipliers + change[last:],
        pressures=at.pressures,
    )


def product(made, found, direction):
    """Tangent times a direction, by the blocks of core and border."""
    core, border = made.numbers.core, made.numbers.border
    inner, outer = direction[core >= 0], direction[border >= 0]
    out = np.zeros(len(core))
    out[core >= 0] = made._pattern.product(found.data, inner) + found.right @ outer
    out[border >= 0] = found.below @ inner + found.corner @ outer
    return out


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("part", PARTS)
def test_tangent_is_the_derivative_of_the_residual(part, closed):
    fibers = [THREADS] if part == "two rubbers" else []
    made = equations(PARTS[part], fibers, closed=closed)
    at, question = somewhere(made), PRESSED
    direction = np.random.default_rng(2).normal(size=len(made.numbers.core))
    kept = (made.numbers.core >= 0) | (made.numbers.border >= 0)
    direction[~kept] = 0.0
    step = 1e-6
    results = [made.linearized(moved(made, at, direction, sign * step), question).residual for sign in (1, -1)]
    expected = (results[0] - results[1]) / (2 * step)
    got = product(made, made.linearized(at, question), direction)
    # the tangent alone holds a relative compressibility of 1e-9 where the mean stress is undetermined
    assert np.abs(got - expected)[kept].max() < 1e-6 * np.abs(expected[kept]).max()


def test_radial_nodes_turn_their_directions():
    disc = tg.sections.Sketch(areas={"body": tg.sections.disc(6 * mm), "cavity": tg.sections.disc(4 * mm)})
    mesh = slice_of_geometry(disc.geometry, 4 * mm)
    made = Equations(tg.Model(mesh, {"body": RUBBER}, [tg.supports.Radial("outside")], []), True)
    at, question = somewhere(made), PRESSED
    kept = (made.numbers.core >= 0) | (made.numbers.border >= 0)
    direction = np.where(kept, np.random.default_rng(3).normal(size=len(kept)), 0.0)
    results = [made.linearized(moved(made, at, direction, sign * 1e-6), question).residual for sign in (1, -1)]
    got = product(made, made.linearized(at, question), direction)
    assert got[kept] == pytest.approx((results[0] - results[1])[kept] / 2e-6, abs=1e-6 * np.abs(got).max())
    radius = np.linalg.norm(follow(made, [question]).points[0].unknowns.y[:, 1:], axis=1)
    assert radius.max() * made.plane.length == pytest.approx(6 * mm, rel=1e-4)


def test_volume_is_the_flow_through_any_cap():
    """The flux of w = λ e₁ + κ × y through a cone from any apex to the loop, by quadrature over its triangles."""
    random = np.random.default_rng(4)
    y, strains = random.normal(size=(4, 3)), np.array([1.1, 0.4, -0.3, 0.7])
    loop = Loop(edges=np.array([[0, 2, 1], [2, 0, 3]]))
    for apex in (np.zeros(3), np.array([0.7, -0.4, 1.2])):
        flow = 0.0
        share, weight = np.polynomial.legendre.leggauss(12)
        share, weight = (share + 1) / 2, weight / 2
        for a, b, m in y[loop.edges]:
            for t, wt in zip(share, weight, strict=True):
                curve = a * (1 - t) * (1 - 2 * t) + b * t * (2 * t - 1) + m * 4 * t * (1 - t)
                slope = a * (4 * t - 3) + b * (4 * t - 1) + m * (4 - 8 * t)
                for r, wr in zip(share, weight, strict=True):
                    place = apex + r * (curve - apex)
                    flow += (
                        wt
                        * wr
                        * (strains[0] * np.eye(3)[0] + np.cross(strains[1:], place))
                        @ np.cross(curve - apex, r * slope)
                    )
        assert loop.volume(y, strains) == pytest.approx(flow, rel=1e-10)


def test_skew_is_the_cross_product():
    a, b = np.random.default_rng(5).normal(size=(2, 3))
    assert skew(a) @ b == pytest.approx(np.cross(a, b))


def test_section_does_not_depend_on_where_it_is_drawn_or_how_it_is_turned():
    """A turned section bends about a turned axis by the same amount."""
    outer, inner = tg.sections.disc(6 * mm), tg.sections.disc(3 * mm, (0.0, 1.5 * mm))
    results = []
    for angle, shift in ((0.0, 0.0), (0.6, 5 * mm)):
        areas = {"body": outer.turned(angle).moved(shift, -shift), "cavity": inner.turned(angle).moved(shift, -shift)}
        section = tg.Section(tg.sections.Sketch(areas=areas), {"body": RUBBER}, size=1.5 * mm)
        results.append(section.solve(30 * kPa).response)
    straight, turned = results
    assert abs(straight["curvature_z"][0]) < 1e-6 * straight["curvature"][0]
    assert turned["curvature"] == pytest.approx(straight["curvature"], rel=2e-3)
    direction = np.arctan2(turned["curvature_z"][0], turned["curvature_y"][0])
    assert direction == pytest.approx(0.6, abs=1e-3)


def test_half_and_whole_section_agree():
    """Up to the error of their meshes, which are not mirror images of each other."""
    whole, half = (tg.actuators.RectangularBender(symmetric=symmetric) for symmetric in (False, True))
    parts = {"body": RUBBER, "base": SOFT, "strain_limiting_layer": tg.Membrane(PAPER, 0.2 * mm)}
    a, b = (tg.Section(each, parts, size=2 * mm).solve([5 * kPa, 10 * kPa]) for each in (whole, half))
    for name in ("curvature_y", "stretch", "cavity_volume_per_length", "outside_ballooning"):
        assert a.response[name] == pytest.approx(b.response[name], rel=3e-3)
    assert a.response["twist"] == pytest.approx(0.0, abs=1e-9)
    both = [0, 2]
    K, L = (each.stiffness().matrix[np.ix_(both, both)] for each in (a, b))
    assert pytest.approx(L, rel=3e-3) == K


@pytest.mark.parametrize("closed", [True, False])
def test_held_volumes_have_their_derivatives(closed):
    made = equations(closed=closed)
    at = somewhere(made)
    held = Question(pressures=np.zeros(1), volumes=np.array([0.7]), strains=FREE, forces=np.zeros(4))
    result = made.linearized(at, held)
    kept = (made.numbers.core >= 0) | (made.numbers.border >= 0)
    direction = np.where(kept, np.random.default_rng(5).normal(size=len(kept)), 0.0)
    sizes = [made.volumes(moved(made, at, direction, sign * 1e-6))[0] for sign in (1, -1)]
    assert result.gradients[0] @ direction == pytest.approx((sizes[0] - sizes[1]) / 2e-6, rel=1e-7)
    assert result.missed[0] == 0.7 - made.volumes(at)[0]
    pressed = [
        made.linearized(replace(at, pressures=at.pressures + sign * 1e-4), held).residual[kept] for sign in (1, -1)
    ]
    assert result.pushed[kept, 0] == pytest.approx((pressed[0] - pressed[1]) / 2e-4, abs=1e-9)
