"""Plane decks that CalculiX solves and that turgor imports: plane strain and a body of revolution, warmed and pressed.

CalculiX has 8-node cells, and turgor 9-node ones with mean stresses. The bottom is fixed, so that its ends are
singular: twice as many cells along each side differ by half of it.
"""

import numpy as np
import pytest
from calculix import displacements, needs_calculix, run_ccx
from scipy.spatial import cKDTree

import turgor as tg
from turgor.job.decks.deck import read_deck
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

#: Cells along each side of a square of 6 mm, 4 mm from the axis.
SIDE = 6

BODY = """\
*BOUNDARY
BOTTOM, 1, 2
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*MATERIAL, NAME=SOFT
*ELASTIC
1., 0.4
*EXPANSION
3e-4
*SOLID SECTION, ELSET=BODY, MATERIAL=SOFT
{thickness}
*STEP, NLGEOM
*STATIC
0.5, 1.
"""


def mesh_lines(kind):
    """A square of 8-node cells, whose nodes are numbered on a grid of half cells."""
    row = 2 * SIDE + 1
    at = {(i, j): 1 + i + row * j for j in range(row) for i in range(row) if not (i % 2 and j % 2)}
    lines = ["*NODE, NSET=ALL", *(f"{n}, {4 + 3 * i / SIDE}, {3 * j / SIDE}, 0." for (i, j), n in at.items())]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=BODY")
    corners = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    for cell in range(SIDE**2):
        i, j = 2 * (cell % SIDE), 2 * (cell // SIDE)
        lines.append(f"{cell + 1}, " + ", ".join(str(at[i + a, j + b]) for a, b in corners))
    lines += ["*NSET, NSET=BOTTOM", *(f"{at[i, 0]}," for i in range(row))]
    inner = "\n".join(f"{1 + SIDE * k}, P4, 0.002" for k in range(SIDE))
    top = [at[i, row - 1] for i in range(row)]
    return "\n".join(lines) + "\n", inner, top


def uniform(row):
    """Shares of a row of nodes in a uniform traction."""
    ends = {row[0]: 1 / 6, row[-1]: 1 / 6}
    inner = {node: (2 / 3 if k % 2 else 1 / 3) for k, node in enumerate(row) if node not in ends}
    return {node: share / SIDE for node, share in (ends | inner).items()}


@needs_calculix
@pytest.mark.parametrize(("kind", "thickness"), [("CPE8", "5.,"), ("CAX8", "")])
def test_square_that_is_warmed_pressed_and_pulled(tmp_path, kind, thickness):
    file = tmp_path / "square.inp"
    mesh, inner, top = mesh_lines(kind)
    shares = {top[-1]: 1.0} if kind == "CAX8" else uniform(top)
    forces = "\n".join(f"{node}, 2, {0.05 * share:.9f}" for node, share in shares.items())
    loads = f"*TEMPERATURE\nALL, 24.\n*DLOAD\n{inner}\n*CLOAD\n{forces}\n"
    body = BODY.format(thickness=thickness).replace("\n\n", "\n")
    file.write_text(f"{mesh}{body}{loads}*NODE PRINT, NSET=ALL\nU\n*END STEP\n")
    run_ccx(file)
    job = tg.jobs.read_job(tg.files.import_deck(file).write(tmp_path / "job"))
    model = model_of(job, mesh_of(job, job.geometry()))
    solution = tg.solve(model, job.procedure)
    place = read_deck(file).place
    _, rows = cKDTree(model.mesh.points).query(1e-3 * np.array([place[number] for number in sorted(place)]))
    theirs = displacements(file, max(place))[-1][1][[number - 1 for number in sorted(place)]]
    away = np.linalg.norm(solution.states[-1].displacement[rows] - theirs, axis=1)
    assert np.sqrt((away**2).mean()) < 0.015 * np.linalg.norm(theirs, axis=1).max()
