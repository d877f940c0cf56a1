"""Shells, threads, obstacles, stages and motion in decks that turgor writes: CalculiX and turgor on the same cells.

Cells are ten-node tetrahedra with displacements only, at Poisson's ratios of 0.4 to 0.45. Tolerances, as shares of the
largest displacement: 1e-3 where both have the same equations (stages, threads), 2e-3 for shells, of which CalculiX
makes thin solids, and for the steps of a motion, 1e-2 for contact, whose penalty and integration points differ.
"""

import numpy as np
import pytest
from calculix import displacements, needs_calculix, run_ccx

import meshes
import turgor as tg
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.model.supports import Displacement, Shift
from turgor.core.solvers.procedures.stages import Stage
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05 * MPa), bulk_modulus=0.6 * MPa, density=1000.0)
APART = Contact(self_contact=False)


def difference(model, folder, procedure=None):
    """Largest difference at the end of each step, as a share of the largest displacement there."""
    way = procedure or tg.Static()
    tg.files.write_inp(model, folder / "part.inp", procedure=way)
    run_ccx(folder / "part.inp")
    solution = tg.solve(model, way, options=tg.EngineOptions(threads=1))
    states = solution.states
    ends = [s for s, after in zip(states, [*states[1:], None], strict=True) if after is None or after.stage != s.stage]
    results = displacements(folder / "part.inp", len(model.mesh.points) + 2000)
    for (_, theirs), state in zip(results, ends, strict=True):
        theirs = theirs[: len(model.mesh.points)]
        yield np.linalg.norm(state.displacement - theirs, axis=1).max() / np.linalg.norm(theirs, axis=1).max()


def block(counts=(2, 2, 1), size=(10 * mm, 10 * mm, 5 * mm)):
    return meshes.box(size, counts, kind=TETRAHEDRON)


@needs_calculix
def test_shell(tmp_path):
    paper = tg.Material(name="paper", law=tg.laws.Hooke(E=50 * MPa, nu=0.3))
    part = block((4, 1, 1), (16 * mm, 4 * mm, 2 * mm))
    materials = {"body": RUBBER, "z0": tg.Shell(paper, 0.1 * mm)}
    model = tg.Model(
        part, materials, ["x0"], [tg.Pressure("z1", 0.2 * kPa)], formulation="displacement", contact=APART
    )  # fmt: skip
    assert max(difference(model, tmp_path)) < 2e-3


@needs_calculix
@pytest.mark.parametrize("compression", [0.0, 1.0])
def test_threads(tmp_path, compression):
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=200 * MPa, nu=0.3))
    winding = Winding(angle_from_axis=np.pi / 4, spacing=2 * mm, axis=(0, 0, 1), hand="both")
    fibers = Fibers(
        face=("x0", "x1", "y0", "y1"), material=thread, diameter=0.2 * mm, winding=winding, form="discrete",
        compression=compression,
    )  # fmt: skip
    model = tg.Model(
        block((2, 2, 2), (5 * mm, 5 * mm, 8 * mm)), {"body": RUBBER}, ["z0"], [tg.Pressure("z1", -10 * kPa)],
        formulation="displacement", reinforcements=[fibers], contact=APART,
    )  # fmt: skip
    assert max(difference(model, tmp_path)) < 1e-3


@needs_calculix
def test_embedded_threads(tmp_path):
    """Tilted rods from cell to cell, tied to the nodes around them by equations."""
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=200 * MPa, nu=0.3))
    through = [
        [(1.1 * mm, 0.7 * mm, 0.5 * mm), (3.7 * mm, 4.1 * mm, 7.3 * mm)],
        [(4 * mm, 1 * mm, 1 * mm), (1 * mm, 2 * mm, 7 * mm)],
    ]
    fibers = Fibers(
        material=thread, diameter=0.5 * mm, winding=tg.bodies.EmbeddedThreads(through=through), form="discrete",
        compression=1.0,
    )  # fmt: skip
    with_rods, without = (
        tg.Model(
            block((2, 2, 2), (5 * mm, 5 * mm, 8 * mm)), {"body": RUBBER}, ["z0"], [tg.Pressure("z1", -10 * kPa)],
            formulation="displacement", reinforcements=each, contact=APART,
        )
        for each in ([fibers], [])
    )  # fmt: skip
    far, near = (tg.solve(each).states[-1].displacement for each in (without, with_rods))
    assert np.abs(far - near).max() > 0.2 * np.abs(far).max()
    assert max(difference(with_rods, tmp_path)) < 1e-3


@needs_calculix
def test_stages_under_a_plate(tmp_path):
    plate = Obstacle(name="plate", shape=Plane(point=(0, 0, 5.1 * mm), normal=(0, 0, -1)))
    model = tg.Model(
        block(), {"body": RUBBER}, ["z0"], [], formulation="displacement", contact=Contact(False, [plate])
    )  # fmt: skip
    way = tg.Stages([
        Stage("press", moves={"plate": (0, 0, -0.4 * mm)}),
        Stage("push", loads=[tg.Pressure("x0", 2 * kPa)]),
        Stage("release", moves={"plate": (0, 0, 0)}, loads=[tg.Pressure("x0", 1 * kPa)]),
    ])  # fmt: skip
    apart = list(difference(model, tmp_path, way))
    assert len(apart) == 3 and max(apart) < 1e-2 and apart[-1] < 1e-3  # the plate has left


@needs_calculix
def test_moved_face_and_weight_in_stages(tmp_path):
    model = tg.Model(
        block(), {"body": RUBBER}, [tg.Fixed("z0"), tg.Fixed("z1", "z")], [], formulation="displacement", contact=APART
    )  # fmt: skip
    way = tg.Stages([
        Stage("press", loads=[tg.Pressure("x0", 2 * kPa)]),
        Stage("pull", displacements=[Displacement("z1", Shift((0, 0, 0.5 * mm)), "z")]),
        Stage("weigh", loads=[tg.Gravity((1, 0, 0))]),
        Stage("release", loads=[tg.Pressure("x0", 0.0)]),
    ])  # fmt: skip
    apart = list(difference(model, tmp_path, way))
    assert len(apart) == 4 and max(apart) < 1e-3


@needs_calculix
def test_motion(tmp_path):
    model = tg.Model(
        block((3, 1, 1), (16 * mm, 4 * mm, 2 * mm)), {"body": RUBBER}, ["x0"], [tg.Pressure("z1", 20.0)],
        formulation="displacement", contact=APART,
    )  # fmt: skip
    way = tg.Dynamic(duration=0.05, first_step=1e-3, max_step=2e-3, accuracy=1e-2)
    assert max(difference(model, tmp_path, way)) < 2e-3
