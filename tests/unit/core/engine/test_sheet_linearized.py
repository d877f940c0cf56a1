"""A sheet that wrinkles is linearized about stress and strain of the last update, not about where it is."""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.faces.membrane_term import MembraneTerm
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration

SHEET = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e9, nu=0.3)), 5e-4, compression=0.0)


def _sheet():
    """The sheet on a side of a block, and how far its nodes move: as the first order of a turn."""
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    system = System(tg.Model(mesh, {"body": problems.rubber(problems.YEOH), "y1": SHEET}, [tg.Fixed("x0")], []))
    (term,) = (each for each in system.terms.all if isinstance(each, MembraneTerm))
    spin = 0.015 * np.array([[0.0, -1.0, 0.4], [1.0, 0.0, -0.7], [-0.4, 0.7, 0.0]])
    return system.points, term, system.points @ spin.T


def test_no_correction_where_stress_and_strain_are_those_of_the_position():
    points, term, move = _sheet()
    still, at = np.zeros_like(points), Configuration(points + move)
    there = term.stresses(at.position, still)
    forces = term.correction(at, there)
    internal = np.zeros_like(points)
    term.add_forces(internal, at)
    assert np.abs(forces).max() < 1e-9 * np.abs(internal).max()
    assert term.stresses(at.position, still) == pytest.approx(term.continued(at.position, still, there))


def test_a_turned_sheet_is_not_stretched_by_what_is_of_second_order():
    """The strain after a turn by 0.015 rad would bear a stress; stress and strain linear in the turn bear none."""
    points, term, move = _sheet()
    still = np.zeros_like(points)
    kept = term.continued(points, move, term.stresses(points, still))
    exact = term.stresses(points + move, still)
    assert np.abs(kept).max() < 1e-3 * np.abs(exact).max()
    twice = term.continued(points, 2 * move, term.stresses(points, still))
    assert twice == pytest.approx(2 * kept, abs=1e-12)
    # the correction takes the stress of second order off the right side, but for the share in compression
    taken, internal, at = term.correction(Configuration(points + move), kept), np.zeros_like(points), points + move
    term.add_forces(internal, Configuration(at))
    assert np.abs(internal + taken).max() < 0.05 * np.abs(internal).max()
