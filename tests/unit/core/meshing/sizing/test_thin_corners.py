"""Corners about which thin walls bend are found from the geometry and get smaller cells; other corners do not."""

from dataclasses import replace

import numpy as np
import pytest
from run_example import at_the_end

from turgor.core.geometry.thin_corners import find_thin_corners
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.local_sizes import local_sizes
from turgor.core.solvers.procedures.static import Static
from turgor.job.read import read_job
from turgor.job.reference.starters import example_job
from turgor.namespaces import actuators
from turgor.units import mm

SECTORS = actuators.OmnidirectionalActuator(chamber_shape="ring_sector", length=30 * mm, symmetric=True)

#: Family, and corners of each cavity.
FOUND = {
    "long box": (actuators.RectangularBender(), {"cavity": 8}),
    "half circle": (actuators.SemicircularBender(), {"cavity": 1}),
    "circles": (actuators.OmnidirectionalActuator(), {}),
    "half circles in a thick wall": (
        actuators.OmnidirectionalActuator(chamber_shape="semicircular_flat_inward", chamber_size=6 * mm),
        {},
    ),
    "tube": (actuators.ExtendingCylinder(), {}),
    "chambers": (actuators.FastPneuNet(), {}),
}


@pytest.mark.parametrize("name", FOUND)
def test_corners_are_found_where_thin_walls_bend(name: str) -> None:
    family, wanted = FOUND[name]
    assert {result.name: len(result.lines) for result in find_thin_corners(family.build())} == wanted


def test_the_long_corner_of_a_ring_sector_lies_where_arch_and_web_meet() -> None:
    results = {each.name: each for each in find_thin_corners(SECTORS.build())}
    radius = np.hypot(results["cavity_1"].lines[..., 1], results["cavity_1"].lines[..., 2])
    along = np.ptp(results["cavity_1"].lines[..., 0], axis=1) > 1 * mm
    outer = along & (radius[:, 0] > 10 * mm)
    assert outer.sum() == 1
    assert radius[outer] == pytest.approx(10.5 * mm)  # 12.5 mm less the wall of 2 mm


def test_cells_at_corners_are_small_and_the_shape_forgets_it() -> None:
    part = SECTORS.build()
    corner = local_sizes(part, 4 * mm, {}).lines
    made = mesh(part, size=4 * mm)
    for start, end in corner:
        along = end - start
        share = (made.points[: made.vertex_count] - start) @ along / (along @ along)
        off = np.linalg.norm(made.points[: made.vertex_count] - start - share[:, None] * along, axis=1)
        steps = np.diff(np.sort(share[(off < 1e-6 * mm)])) * np.linalg.norm(along)
        assert steps.max() < 0.5 * 4 * mm
    plain = {"cavity_1": 4 * mm, "cavity_2": 4 * mm}
    coarse = mesh(part, size=4 * mm, face_sizes=plain)
    assert len(coarse.cells) < 0.7 * len(made.cells)
    assert np.array_equal(mesh(part, size=4 * mm).points, made.points)


def test_sizes_scale_with_the_mesh_and_given_ones_come_first() -> None:
    part = SECTORS.build()
    coarse, fine = local_sizes(part, 4 * mm, {}), local_sizes(part, 2 * mm, {})
    assert coarse.line_size == pytest.approx(2 * fine.line_size)
    assert coarse.faces.keys() == fine.faces.keys()
    given = local_sizes(part, 4 * mm, {"cavity_1": 3 * mm, "tip": 2 * mm})
    assert np.unique(np.round(list(given.faces.values()), 9)) == pytest.approx([2 * mm, 2.8 * mm, 3 * mm])
    assert (len(coarse.lines), len(given.lines)) == (4, 2)  # two of each cavity


def test_walls_of_bellows_are_folded_where_they_meet_in_sharp_edges() -> None:
    sharp = actuators.BellowsOfRevolution(folds=2, fold_shape="straight", quarter=True)
    (found,) = find_thin_corners(sharp.build())
    assert (len(found.lines), len(found.folded)) == (0, 2 * 2)  # two cones a fold, half of the length
    assert find_thin_corners(replace(sharp, fold_shape="rounded").build()) == ()


def test_a_bellows_of_tetrahedra_extends_as_its_meridian_does() -> None:
    job = read_job(example_job("bellows_of_revolution"))
    job = replace(job, actuator=replace(job.actuator, folds=1), procedure=Static(first_step=0.5, max_step=0.5))
    job = replace(job, mesh=MeshSettings(size=3 * mm))
    # 2.2407 and 2.2441 mm with 7,299 and 17,157 unknowns of the meridian; 2.146 mm without smaller cells at the folds
    assert at_the_end(job)["tip_displacement_x"] == pytest.approx(2.2441 * mm, rel=0.03)
