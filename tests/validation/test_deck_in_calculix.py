"""A deck that CalculiX solves and that turgor imports: displacements of both at the same nodes.

Cells differ: 20 nodes with reduced integration there, 27 nodes with mean stresses here, two by two by three of them,
and the edges of the clamped ends are singular. A mesh of twice as many cells along each side differs by a third of it.
"""

from pathlib import Path

import numpy as np
from calculix import displacements, needs_calculix, run_ccx
from scipy.spatial import cKDTree

import turgor as tg
from turgor.job.decks.deck import read_deck
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

DECK = Path(__file__).parents[2] / "examples" / "rubber_block.inp"


@needs_calculix
def test_block_that_is_pulled_and_pressed(tmp_path):
    file = tmp_path / DECK.name
    file.write_bytes(DECK.read_bytes())
    run_ccx(file)
    job = tg.jobs.read_job(tg.files.import_deck(file).write(tmp_path / "job"))
    model = model_of(job, mesh_of(job, job.geometry()))
    solution = tg.solve(model, job.procedure)
    place = read_deck(file).place
    _, rows = cKDTree(model.mesh.points).query(1e-3 * np.array([place[number] for number in sorted(place)]))
    results = displacements(file, max(place))
    assert [time for time, _ in results] == [1.0, 3.0]
    for time, theirs in results:
        (state,) = [each for each in solution.states if abs(each.load_factor - time / 3) < 1e-9]
        away = np.linalg.norm(state.displacement[rows] - theirs, axis=1)
        assert np.sqrt((away**2).mean()) < 0.015 * np.linalg.norm(theirs, axis=1).max()
