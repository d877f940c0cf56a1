"""Decks with inertia: a load without an amplitude acts at once on a body at rest.

Problem: a bar of 16 bricks without contraction across, on a smooth plane, pulled suddenly at its lid by a small
pressure below zero; and a bar of two bricks, as a deck and as a .feb file.
Exact: a wave of speed c = √(E/ρ) runs to the plane and back: the lid moves by σ t/(ρ c) up to the time 2 L/c, that is
by 2 σ L/E, twice as far as under the same load that is there from the start. The deck and the file are the same model.
Tolerance: 1 %, for the waves that 16 bricks do not resolve; digits of the file.
"""

import pytest

import problems
import turgor as tg
from deck_cases import CELLS, NODES, PULL, deck, step
from febio_cases import BRICKS, RISE, SETS, feb
from febio_cases import PULL as PULLED
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

E, DENSITY, LENGTH, TENSION = 0.4, 1.0e-9, 20.0, 1e-5
PERIOD = 2 * LENGTH * (DENSITY / E) ** 0.5


def column(count):
    """Bricks above each other, with the names of `deck_cases`."""
    corners = ((0, 0), (10, 0), (10, 10), (0, 10))
    rows = [
        f"{4 * k + i + 1}, {x}, {y}, {k * LENGTH / count}" for k in range(count + 1) for i, (x, y) in enumerate(corners)
    ]
    cells = [f"{k + 1}, " + ", ".join(str(4 * k + i) for i in range(1, 9)) for k in range(count)]
    walls = {
        name: [4 * k + i for k in range(count + 1) for i in at] for name, at in {"X0": (1, 4), "Y0": (1, 2)}.items()
    }
    sets = [f"*NSET, NSET={name}\n" + "\n".join(map(str, nodes)) for name, nodes in walls.items()]
    named = "*NSET, NSET=BOTTOM\n1, 2, 3, 4"
    lid = f"*SURFACE, NAME=LID, TYPE=ELEMENT\n{count}, S2"
    return "\n".join(["*NODE, NSET=ALL", *rows, "*ELEMENT, TYPE=C3D8, ELSET=BLOCK", *cells, *sets, named, lid, ""])


def as_deck(folder, mesh=NODES + CELLS):
    material = f"*ELASTIC\n{E}, 0.\n*DENSITY\n{DENSITY}\n"
    planes = "*BOUNDARY\nBOTTOM, 3\nX0, 1\nY0, 2\n"
    pull = step(PULL.replace("-0.03", f"-{TENSION}"), period=PERIOD)
    return deck(folder, material=material, model=planes, steps=pull.replace("*STATIC", "*DYNAMIC"), mesh=mesh)


def as_feb(folder):
    constants = f"<density>{DENSITY}</density><E>{E}</E><v>0</v>"
    walls = '<NodeSet name="X0">1,4,5,8,9,12</NodeSet><NodeSet name="Y0">1,2,5,6,9,10</NodeSet>'
    boundary = "".join(
        f'<bc node_set="{nodes}" type="zero displacement"><{axis}_dof>1</{axis}_dof></bc>'
        for nodes, axis in (("BOTTOM", "z"), ("X0", "x"), ("Y0", "y"))
    )
    file = feb(
        folder, material=f'<material id="1" name="SOFT" type="isotropic elastic">{constants}</material>',
        mesh=BRICKS + SETS + walls, boundary=boundary, control="<analysis>DYNAMIC</analysis>",
        loads=PULLED.replace("-0.03", f"-{TENSION}"), curve=RISE.replace("<pt>0,0</pt>", "<pt>0,1</pt>"),
    )  # fmt: skip
    file.write_text(file.read_text().replace("<step_size>0.1<", f"<step_size>{PERIOD / 10}<"))
    return file


def lid(file, folder):
    """Last displacement of the lid [mm]."""
    job = tg.jobs.read_job(tg.files.import_deck(file, units="mm, N, MPa").write(folder))
    model = model_of(job, mesh_of(job, job.geometry()))
    state = problems.solve(model, job.procedure).states[-1]
    return 1e3 * float(state.displacement[model.mesh.face_nodes("LID"), 2].mean())


def test_sudden_pull(tmp_path, record_verification):
    got, expected = lid(as_deck(tmp_path, column(16)), tmp_path), 2 * TENSION * LENGTH / E
    assert got == pytest.approx(expected, rel=0.01)
    record_verification(
        claim="lid of a bar that a deck pulls suddenly", source="wave in a bar", expected=expected, got=got,
        tolerance="1 %",
    )  # fmt: skip


def test_a_file_of_febio_moves_as_the_deck(tmp_path):
    theirs, ours = tmp_path / "deck", tmp_path / "feb"
    theirs.mkdir()
    ours.mkdir()
    assert lid(as_feb(ours), ours) == pytest.approx(lid(as_deck(theirs), theirs), rel=1e-9)
