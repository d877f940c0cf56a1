"""Where sheets wrinkle, a step starts from a parabola at most, and from stress and strain along a line."""

from dataclasses import replace

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.system import System
from turgor.core.solvers.constraints.loads import load_control
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.predictor import Extrapolation, predicted
from turgor.units import GPa, mm


def start(compression: float, unknowns_power: int):
    """Unknown and stress of a sheet at the start of a step to 5, from points at 0 to 4 where both grow with a power."""
    silk = tg.Membrane(
        tg.Material(name="silk", law=tg.laws.Hooke(E=4 * GPa, nu=0.3)), 0.5 * mm, compression=compression
    )
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    system = System(tg.Model(mesh, {"body": problems.rubber(problems.YEOH), "y1": silk}, [tg.Fixed("x0")], []))
    rest = system.stresses(system.evaluate(np.zeros(system.size), 0.0))
    points = []
    for number in range(5):
        terms = [np.full_like(each, float(number**unknowns_power)) for each in rest.terms]
        unknowns = np.where(system.prescribed, 0.0, 1e-6 * number**unknowns_power)
        points.append(Point(float(number), unknowns, np.empty(0), replace(rest, terms=terms), None, None, None, None))
    orders = Extrapolation(lambda _, at: -float(np.abs(at.unknowns).max()), -np.inf, False, False)
    tangent = Tangent(system, "rslab", 1)
    result = predicted(load_control(system), tangent, points, 5.0, orders)
    return result.unknowns.max() / 1e-6, result.stresses.terms[0].flat[0]


def test_a_sheet_that_bears_compression_follows_the_highest_order():
    assert start(1.0, 4) == pytest.approx((625, 625))


def test_a_sheet_that_wrinkles_follows_a_parabola_and_its_stress_a_line():
    parabola = 16 - 3 * 81 + 3 * 256  # of 2⁴, 3⁴ and 4⁴
    assert start(0.0, 4) == pytest.approx((parabola, 2 * 256 - 81))
