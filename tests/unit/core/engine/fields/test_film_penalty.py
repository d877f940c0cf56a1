"""Films without a solid: the penalty at their edges keeps bending positive, and is no larger than it must be."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.faces import plate_edges
from turgor.core.engine.faces.plate_terms import HingeTerm, PlateTerm
from turgor.core.engine.faces.plates import least_penalties
from turgor.core.engine.faces.settings import PLATE
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.core.geometry.parts.facets import facet
from turgor.units import MPa, mm

SHEET = tg.Shell(tg.Material(name="sheet", law=tg.laws.Hooke(E=20 * MPa, nu=0.45)), 1 * mm)
#: A Kresling tube has such triangles: blunt ones.
BLUNT = ((0.0, 0.0, 0.0), (20 * mm, 0.0, 0.0), (27.3 * mm, 21.3 * mm, 0.0))
SQUARE = [tg.bodies.Patch(corners=((0, 0, 0), (0.02, 0, 0), (0.02, 0.02, 0), (0, 0.02, 0)), faces=("film",))]


def _bending(patches):
    """Smallest and largest eigenvalue of the bending of a flat film, over deflections of its nodes."""
    mesh = tg.mesh(tg.bodies.Film(patches=tuple(patches)), size=10 * mm)
    system = System(tg.Model(mesh, {"film": SHEET}, [], []))
    x, terms = system.points, [t for t in system.terms.all if isinstance(t, PlateTerm | HingeTerm)]
    rows = []
    for node in range(len(x)):
        ends = []
        for way in (1e-4, -1e-4):
            moved, out = x.copy(), np.zeros_like(x)
            moved[node, 2] += way
            for term in terms:
                term.add_forces(out, Configuration(moved))
            ends.append(out[:, 2])
        rows.append((ends[0] - ends[1]) / 2e-4)
    values = np.linalg.eigvalsh(np.array(rows) + np.array(rows).T)
    return values[0], values[-1]


@pytest.mark.parametrize("patches", [facet(BLUNT, ("film",)), SQUARE], ids=["triangle", "square"])
def test_no_bending_costs_less_than_nothing(patches):
    least, most = _bending(patches)
    assert least > -1e-6 * most


def test_half_of_the_penalty_would_make_bending_negative(monkeypatch):
    few = replace(PLATE, margin=0.5 * PLATE.margin, least_penalty=0.0)
    monkeypatch.setattr(plate_edges, "PLATE", few)
    least, most = _bending(facet(BLUNT, ("film",)))
    assert least < -1e-3 * most


def test_the_penalty_of_edges_is_in_proportion_to_what_each_needs():
    """Two edges whose moments see different bending need what each needs alone, and both together when they share."""
    bending = np.diag([0.0, 0, 0, 1, 1])
    one, other = np.diag([0.0, 0, 0, 2, 0]), np.diag([0.0, 0, 0, 0, 6])
    assert least_penalties(bending[None], np.array([[one, other]])) == pytest.approx(np.array([[1.0, 3.0]]))
    assert least_penalties(bending[None], np.array([[one, 3 * one]])) == pytest.approx(np.array([[2.0, 6.0]]))
