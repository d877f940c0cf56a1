"""Derivatives by dimensions are the same for hexahedra, which are swept anew, and tetrahedra, which are carried along.

Problem: a quarter of a tube with caps under pressure; its cavity volume and tip displacement by wall, inner radius and
length. Exact: equality of the bodies' derivatives.
Tolerance: the distance of the two meshes. Volumes differ by 0.1 % and their derivatives by 0.3 %, tip displacements by
0.9 % and their derivatives by 2.7 % of the largest. Nodes that move by 1 % less are noticed: volumes are off by 1 %.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.units import kPa, mm

VALUES = {"wall": 2 * mm, "inner_radius": 5 * mm, "length": 25 * mm}


def gradient(cells, size):
    def model_of(values):
        mesh = tg.mesh(tg.actuators.ExtendingCylinder(**values).build(), size=size, cells=cells)
        rubbers = dict.fromkeys(mesh.regions, problems.rubber(problems.YEOH))
        return tg.Model(mesh, rubbers, [tg.Fixed("fixed")], [tg.Pressure("cavity", 20 * kPa)])

    solution = problems.solve(model_of(VALUES))
    measures = ("cavity_volume", "tip_displacement")
    result = tg.gradient(solution, measures, tg.studies.Variation(model_of, VALUES), options=problems.OPTIONS)
    return result.values * np.array(list(VALUES.values()))


def test_tetrahedra_have_the_derivatives_of_hexahedra(record_verification):
    hexahedra, tetrahedra = gradient("hexahedra", 4 * mm), gradient("tetrahedra", 1.4 * mm)
    apart = np.abs(tetrahedra - hexahedra).max(axis=1) / np.abs(hexahedra).max(axis=1)
    record_verification(
        claim="a tube of tetrahedra and of hexahedra: derivatives of volume and tip displacement by three dimensions; "
        "largest difference, as shares of the largest derivative",
        source="each other",
        expected=[0.0, 0.0],
        got=apart.tolist(),
        tolerance="0.005, 0.05",
    )
    assert apart == pytest.approx([0.0, 0.0], abs=0.05)
    assert apart[0] < 0.005
