"""Decks that turgor writes with sheets, stages, moved faces and obstacles: read again, they are the same models.

Problems: a strip with paper that bends, or with a film that wrinkles; a block that is pressed, pulled, weighed and
released in stages; a block on which a plate with friction presses and drags.
Exact: the state of the model that was written. Tolerances: digits of the deck, and 1e-6 where the steps differ: four
stages are one path when they come back.
"""

import numpy as np
import pytest
from scipy.spatial import cKDTree

import meshes
import problems
import turgor as tg
from contact_cases import block
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.model.supports import Displacement, Shift
from turgor.core.solvers.procedures.stages import Stage
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=problems.NEO_HOOKE, bulk_modulus=2 * MPa, density=1000.0)
PAPER = tg.Material(name="paper", law=tg.laws.Hooke(E=50 * MPa, nu=0.3))
APART = Contact(self_contact=False)


def strip(sheet):
    part = meshes.box((20 * mm, 4 * mm, 2 * mm), (3, 1, 1))
    return tg.Model(part, {"body": RUBBER, "z0": sheet}, ["x0"], [tg.Pressure("z1", 0.1 * kPa)], contact=APART)


def pressed_block():
    part, up = block(counts=(1, 1, 1), kind=TETRAHEDRON), Shift((0, 0, 0.5 * mm))
    model = tg.Model(part, {"body": RUBBER}, [tg.Fixed("z0"), tg.Fixed("z1", "z")], [], contact=APART)
    return model, tg.Stages([
        Stage("press", loads=[tg.Pressure("x0", 2 * kPa)]),
        Stage("pull", loads=[tg.Gravity((1, 0, 0))], displacements=[Displacement("z1", up, "z")]),
        Stage("release", loads=[tg.Pressure("x0", 0.0)]),
    ])  # fmt: skip


def dragged_block():
    way = ((0, (0, 0, 0)), (0.5, (0, 0, -0.4 * mm)), (1, (0.1 * mm, 0, -0.4 * mm)))
    plate = Obstacle(
        name="plate", shape=Plane(point=(0, 0, 5.1 * mm), normal=(0, 0, -1)), path=way, friction=0.3, stiffness=1e10
    )
    part, contact = block(counts=(2, 2, 1), kind=TETRAHEDRON), Contact(self_contact=False, obstacles=[plate])
    return tg.Model(part, {"body": RUBBER}, ["z0"], [], contact=contact)


CASES = {
    "a strip with a shell": (lambda: (strip(tg.Shell(PAPER, 0.1 * mm)), tg.Static()), "calculix", 1e-9),
    "a strip with a film that wrinkles": (
        lambda: (strip(tg.Membrane(PAPER, 0.1 * mm, compression=0)), tg.Static()), "abaqus", 1e-9,
    ),
    "a block in stages": (pressed_block, "calculix", 1e-6),
    "a block under a plate": (lambda: (dragged_block(), tg.Static()), "abaqus", 1e-9),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_it_is_the_same_state(tmp_path, name, record_verification):
    make, program, tolerance = CASES[name]
    model, procedure = make()
    tg.files.write_inp(model, tmp_path / "part.inp", program=program, procedure=procedure)
    job = tg.jobs.read_job(tg.files.import_deck(tmp_path / "part.inp").write(tmp_path / "job"))
    again = model_of(job, mesh_of(job, job.geometry()))
    ours, theirs = problems.solve(model, procedure), problems.solve(again, job.procedure)
    assert theirs.complete
    _, rows = cKDTree(again.mesh.points).query(model.mesh.points)
    one, other = ours.states[-1].displacement, theirs.states[-1].displacement[rows]
    assert np.abs(other - one).max() < tolerance * np.abs(one).max()
    record_verification(
        claim=f"largest displacement [mm] of {name}, written and read again", source="the model that was written",
        expected=float(np.abs(one).max() / mm), got=float(np.abs(other).max() / mm), tolerance=f"{tolerance:g}",
    )  # fmt: skip
