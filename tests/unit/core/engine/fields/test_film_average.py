"""Values at points of films, carried to the nodes: linear fields come back."""

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine.cells.reference import reference_cell
from turgor.core.engine.fields import film_average
from turgor.units import MPa, mm

FILM = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=20 * MPa, nu=0.3)), 1 * mm)


def test_a_linear_field_comes_back_at_the_nodes():
    corners = ((0.0, 0.0, 0.0), (30 * mm, 0.0, 0.0), (30 * mm, 20 * mm, 0.0), (0.0, 20 * mm, 0.0))
    mesh = tg.mesh(tg.bodies.Film(patches=(tg.bodies.Patch(corners=corners, faces=("film",)),)), size=10 * mm)
    points = np.einsum("qn,fni->fqi", reference_cell(9, 3).N, mesh.points[mesh.face("film")])
    nodal = film_average(tg.Model(mesh, {"film": FILM}, [], []), points)
    assert nodal == pytest.approx(mesh.points, abs=1e-12)
    assert nodal[:, 0].max() == pytest.approx(30 * mm)  # means of sides end at 25 mm
