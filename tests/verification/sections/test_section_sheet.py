"""V22: a half-round section on a sheet does what a slice of finite elements does.

Problem: the default semicircular bender of Elastosil M4601 on 0.1 mm of paper, as a membrane and as a shell, at 50 kPa.
A slice between two sections that stay plane and parallel is solved with 27-node hexahedra, the sheet by the terms of
the engine on their sides. The section is solved with its curvature fixed at zero. Both have the same cells.
Reference: the slice. A prismatic actuator that stays straight has no other solution.
Tolerance: 1e-6, what the solvers leave.
"""

from dataclasses import replace

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.core.meshing.surface import cell_sides
from turgor.units import kPa, mm

PRESSURE = 50 * kPa


def slice_model(section):
    """The slice of a section between its mirror plane across x and a section that stays plane."""
    mesh = section.model.mesh
    mesh = replace(mesh, points=mesh.points - [mesh.points[:, 0].min(), 0.0, 0.0])
    sides, end = cell_sides(mesh.cells), mesh.points[:, 0].max()
    at = {name: (np.abs(mesh.points[sides, 0] - x) < 1e-9).all(axis=1) for name, x in (("low", 0.0), ("high", end))}
    pin = np.full((1, 9), np.linalg.norm(mesh.points, axis=1).argmin())
    faces = {**mesh.faces, "symmetry_x": sides[at["low"]], "end": sides[at["high"]], "pin": pin}
    supports = [tg.supports.PlaneSection("end"), tg.Fixed("pin", "z")]
    return tg.Model(replace(mesh, faces=faces), section.model.materials, supports, [tg.Pressure("cavity", PRESSURE)])


@pytest.mark.parametrize("bending", [False, True], ids=["membrane", "shell"])
def test_half_round_on_paper(bending, record_verification):
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    paper = tg.from_library("paper", record="hooke-polygerinos-2020")
    sheet = (tg.Shell if bending else tg.Membrane)(paper, thickness=0.1 * mm)
    materials = {"body": rubber, "base": rubber, "strain_limiting_layer": sheet}
    section = tg.Section(tg.actuators.SemicircularBender(), materials)
    model = slice_model(section)
    state = problems.solve(model, tg.Static(tolerance=1e-8)).states[-1]
    long = np.ptp(model.mesh.points[:, 0])
    volume = tg.measures.cavity_volume(state) / model.mesh.symmetry_factor * 2 / long
    got = section.solve(PRESSURE, prescribed={"curvature_y": 0.0}).response
    stretch = 1 + state.displacement[model.mesh.face_nodes("end"), 0].max() / long
    expected, result = [stretch, volume / mm**2], [got["stretch"][0], got["cavity_volume_per_length"][0] / mm**2]
    kind = "shell" if bending else "membrane"
    record_verification(
        claim=f"half round on paper ({kind}), kept straight at 50 kPa: stretch, volume of the cavity [mm³/mm]",
        source="a slice of hexahedra",
        expected=expected,
        got=result,
        tolerance="1e-6",
    )
    assert result == pytest.approx(expected, rel=1e-6)
