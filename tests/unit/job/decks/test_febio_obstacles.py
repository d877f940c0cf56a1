"""Rigid bodies of .feb files that others touch: obstacles, and how they move."""

import numpy as np
import pytest

import turgor as tg
from febio_cases import BRICKS, DOMAIN, FIXED, POINTS, SETS, SOFT, feb
from refused import refused
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

PLATE = "".join(
    f'<node id="{n}">{x},{y},{z}</node>'
    for n, (x, y, z) in enumerate(
        [(x, y, z) for z in (20.5, 22) for x, y in ((-5, -5), (15, -5), (15, 15), (-5, 15))], start=21
    )
)
CELL = '<Elements type="hex8" name="PLATE"><elem id="9">21,22,23,24,25,26,27,28</elem></Elements>'
PAIR = (
    '<Surface name="UNDER"><quad4 id="1">21,24,23,22</quad4></Surface>'
    '<SurfacePair name="TOUCH"><primary>UNDER</primary><secondary>LID</secondary></SurfacePair>'
)
CONTACT = (
    '<Contact><contact type="sliding-elastic" surface_pair="TOUCH"><fric_coeff>0.3</fric_coeff></contact></Contact>'
)
HARD = '<material id="2" name="STEEL" type="rigid body"><density>1</density></material>'
TURNS = "".join(f"<R{x}_dof>1</R{x}_dof>" for x in "xyuvw")


def rigid(dof, turns=TURNS):
    stays = f'<rigid_bc type="rigid_fixed"><rb>STEEL</rb>{turns}</rigid_bc>'
    moves = f'<rb>STEEL</rb><dof>{dof}</dof><value lc="1">-1.5</value>'
    return f'<Rigid>{stays}<rigid_bc type="rigid_displacement">{moves}</rigid_bc></Rigid>'


def pressed(folder, dof="z", **more):
    return feb(
        folder, material=SOFT + HARD, mesh=BRICKS + CELL + SETS + PAIR, points=POINTS + PLATE, boundary=FIXED, loads="",
        domains=DOMAIN + '<SolidDomain name="PLATE" mat="STEEL"/>', more=rigid(dof, **more) + CONTACT,
    )  # fmt: skip


@pytest.mark.parametrize("dof", ["z", "Rz"])
def test_a_rigid_body_that_moves_is_an_obstacle(tmp_path, dof):
    read = tg.files.import_deck(pressed(tmp_path, dof), units="mm, N, MPa")
    job = tg.jobs.read_job(read.write(tmp_path))
    (obstacle,) = job.contact.obstacles
    assert (obstacle.face, obstacle.friction) == ("LID", 0.3)
    assert len(job.actuator.read().cells) == 2
    (surface,) = read.surfaces.values()
    assert surface.count("facet normal") == 12
    end = obstacle.path[-1]
    assert (end[0], end[1]) == (1.0, pytest.approx([0, 0, -1.5e-3]))


def test_it_presses_the_block(tmp_path):
    job = tg.jobs.read_job(tg.files.import_deck(pressed(tmp_path), units="mm, N, MPa").write(tmp_path))
    model = model_of(job, mesh_of(job, job.geometry()))
    state = tg.solve(model, job.procedure).states[-1]
    lid = state.displacement[model.mesh.face_nodes("LID"), 2]
    # 1.5 mm less a gap of 0.5 mm; the penalty gives way
    assert lid == pytest.approx(np.full(len(lid), -1e-3), abs=6e-5)


def test_one_that_may_turn_is_refused(tmp_path):
    with refused("STEEL", "Rw"):
        tg.files.import_deck(pressed(tmp_path, turns=TURNS.replace("<Rw_dof>1</Rw_dof>", "")), units="mm, N, MPa")
