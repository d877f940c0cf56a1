"""Equations, ties and centrifugal forces of decks: which supports and loads they become, and what is refused."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import CELLS, FIXED, NODES, PULL, deck, step
from refused import refused
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of


def model_in(file, folder) -> tg.Model:
    job = tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))
    return model_of(job, mesh_of(job, job.geometry()))


def equations(model: tg.Model) -> list[tg.supports.Equation]:
    return [each for each in model.supports if isinstance(each, tg.supports.Equation)]


def rows(model: tg.Model) -> set[tuple]:
    """Places [mm] and vectors of all equations between corners of the deck."""
    found = set()
    for each in equations(model):
        nodes, vectors = each.equations(model.mesh)
        for row, parts in zip(model.mesh.points[nodes] * 1e3, vectors, strict=True):
            found.add(
                tuple((*map(round, at), *np.round(part, 6)) for at, part in zip(row.tolist(), parts, strict=True))
            )
    return found


def test_equations_of_single_nodes_with_directions_of_their_own(tmp_path):
    lines = "*TRANSFORM, NSET=TOP, TYPE=R\n0., 1., 0., -1., 0., 0.\n*EQUATION\n3\n9, 1, 1., 5, 3, 2., 6, 3, 0.5\n"
    model = model_in(deck(tmp_path, model=FIXED + lines), tmp_path)
    assert rows(model) == {((0, 0, 20, 0, 1, 0), (0, 0, 10, 0, 0, 2), (10, 0, 10, 0, 0, 0.5))}


def test_small_factors_of_an_equation_stay(tmp_path):
    model = model_in(deck(tmp_path, model=FIXED + "*EQUATION\n2\n9, 3, 1., 5, 3, -2.5e-8\n"), tmp_path)
    (one,) = equations(model)
    _, ((_, small),) = one.equations(model.mesh)
    assert small.tolist() == [0.0, 0.0, -2.5e-8]


def test_equations_of_faces_that_lie_alike_are_one(tmp_path):
    pairs = [(2, 1), (6, 5), (10, 9), (3, 4), (7, 8), (11, 12)]
    lines = "*EQUATION\n" + "".join(f"2\n{one}, 3, 1.,\n{other}, 3, -1.\n" for one, other in pairs)
    model = model_in(deck(tmp_path, model="*BOUNDARY\nBOTTOM, 1, 2\n9, 3\n" + lines), tmp_path)
    (one,) = equations(model)
    nodes, _ = one.equations(model.mesh)
    apart = model.mesh.points[nodes[:, 0]] - model.mesh.points[nodes[:, 1]]
    assert np.abs(apart) * 1e3 == pytest.approx(np.tile([10.0, 0, 0], (15, 1)))  # with the middles of sides


def test_a_node_of_no_cell_counts_where_it_is_fixed(tmp_path):
    mesh = NODES + "90, 0., 0., 50.\n" + CELLS
    lines = "*EQUATION\n3\n9, 3, 1., 10, 3, -1., 90, 3, 4.\n"
    model = model_in(deck(tmp_path, mesh=mesh, model=FIXED + "*BOUNDARY\n90, 1, 3\n" + lines), tmp_path)
    assert rows(model) == {((0, 0, 20, 0, 0, 1), (10, 0, 20, 0, 0, -1))}
    with refused("*EQUATION", "90"):
        tg.files.import_deck(deck(tmp_path, mesh=mesh, model=FIXED + lines))


@pytest.mark.parametrize(
    ("lines", "fact"),
    [("3\n9, 3, 1., 10, 3, -1.\n", "'3'"), ("2\nTOP, 3, 1., 5, 3, -1.\n", "'TOP'"), ("2\n9, 4, 1., 5, 3, 1.\n", "4")],
)
def test_damaged_and_other_equations_are_refused(tmp_path, lines, fact):
    with refused("*EQUATION", fact):
        tg.files.import_deck(deck(tmp_path, model=FIXED + "*EQUATION\n" + lines))


#: A body of half the width on the block, whose nodes are at the place of those of the block in two corners.
SMALL = """\
*NODE
20, 0., 0., 20.
21, 5., 0., 20.
22, 5., 10., 20.
23, 0., 10., 20.
24, 0., 0., 30.
25, 5., 0., 30.
26, 5., 10., 30.
27, 0., 10., 30.
*ELEMENT, TYPE=C3D8, ELSET=BLOCK
3, 20,21,22,23,24,25,26,27
*SURFACE, NAME=FOOT, TYPE=ELEMENT
3, S1
"""


def test_surfaces_of_other_nodes_are_tied(tmp_path):
    mesh = NODES + CELLS + SMALL
    load = step("*DSLOAD\nEND, P, -0.03\n")
    model = FIXED + "*SURFACE, NAME=END, TYPE=ELEMENT\n3, S2\n*TIE, NAME=GLUE\nFOOT, LID\n"
    read = model_in(deck(tmp_path, mesh=mesh, model=model, steps=load), tmp_path)
    (tie,) = [each for each in read.supports if isinstance(each, tg.supports.Tied)]
    moved = tg.solve(read, tg.Static()).states[-1].displacement
    assert (tie.face, tie.to) == ("tied", "tied_to")
    both = np.flatnonzero(np.linalg.norm(read.mesh.points - [0.005, 0, 0.02], axis=1) < 1e-9)
    assert len(both) == 2  # a corner above, the middle of an edge below
    assert moved[both[0]] == pytest.approx(moved[both[1]], abs=1e-12)
    assert moved[both[0], 2] > 2e-4
    with refused("*TIE", "'TOP'"):
        tg.files.import_deck(deck(tmp_path, mesh=mesh, model=model.replace("FOOT, LID", "TOP, FOOT"), steps=load))


def test_contact_that_ties_is_a_tie(tmp_path):
    pair = "*SURFACE INTERACTION, NAME=GLUE\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.e7\n"
    pair += "*CONTACT PAIR, INTERACTION=GLUE\nFOOT, LID\n"
    read = tg.files.import_deck(deck(tmp_path, mesh=NODES + CELLS + SMALL, model=FIXED + pair))
    assert 'tied_to = "tied_to"' in read.job
    assert "self_contact = false" in read.job


def test_numbers_beyond_the_nodes_of_a_cell_are_skipped(tmp_path):
    longer = CELLS.replace("6,7,8\n", "6,7,8,9,10,\n").replace(
        "2, 5,6,7,8,9,10,11,12\n", "2, 5,6,7,8,9,10,11,12,1,2,\n"
    )
    plain, other = (tg.files.import_deck(deck(tmp_path, mesh=NODES + cells)).mesh for cells in (CELLS, longer))
    assert plain == other


def test_nodes_at_one_place_stay_two_without_a_tie(tmp_path):
    foot = "*BOUNDARY\n24, 1, 3\n25, 1, 3\n26, 1, 3\n27, 1, 3\n"
    read = model_in(deck(tmp_path, mesh=NODES + CELLS + SMALL, model=FIXED + foot), tmp_path)
    moved = tg.solve(read, tg.Static()).states[-1].displacement
    at = np.flatnonzero(np.linalg.norm(read.mesh.points - [0, 0, 0.02], axis=1) < 1e-9)
    assert len(at) == 2
    assert abs(np.diff(moved[at, 2])[0]) > 1e-4


def test_contact_of_single_nodes_is_refused(tmp_path):
    pair = "*NSET, NSET=ONE\n25\n*SURFACE, NAME=TIP, TYPE=NODE\nONE\n*SURFACE INTERACTION, NAME=RUB\n"
    pair += "*CONTACT PAIR, INTERACTION=RUB\nTIP, LID\n"
    with refused("*CONTACT PAIR", "'TIP'"):
        tg.files.import_deck(deck(tmp_path, mesh=NODES + CELLS + SMALL, model=pair + FIXED))


def test_a_centrifugal_force_has_its_speed_and_axis(tmp_path):
    dense = "*HYPERELASTIC, NEO HOOKE\n0.1, 0.4\n*DENSITY\n1e-9\n"
    spin = step("*DLOAD\nBLOCK, CENTRIF, 400., 1., 2., 3., 0., 0., 2.\n")
    (load,) = model_in(deck(tmp_path, material=dense, steps=spin), tmp_path).loads
    assert (load.speed, load.through, load.axis) == (20.0, (1e-3, 2e-3, 3e-3), (0, 0, 2))
    with refused("*DLOAD"):
        part = step("*DLOAD\n1, CENTRIF, 400., 1., 2., 3., 0., 0., 2.\n")
        tg.files.import_deck(deck(tmp_path, material=dense, steps=part))


def test_equations_come_back_from_a_written_deck(tmp_path):
    model = model_in(deck(tmp_path, model=FIXED + "*EQUATION\n2\n9, 3, 1., 11, 1, 0.5\n", steps=step(PULL)), tmp_path)
    tg.files.write_inp(model, tmp_path / "again.inp")
    assert rows(model_in(tmp_path / "again.inp", tmp_path)) == rows(model)


def test_linear_constraints_of_nodes(tmp_path):
    lines = "*MPC\nPIN, 9, 5\nLINEAR, 90, 9, 10\n"
    mesh = NODES + "90, 2.5, 0., 20.\n91, 2.5, 0., 21.\n92, 2.5, 1., 20.\n93, 2., 0., 21.\n" + CELLS
    mesh = mesh.replace("*NSET, NSET=BOTTOM", "*ELEMENT, TYPE=C3D4, ELSET=BLOCK\n3, 90, 91, 92, 93\n*NSET, NSET=BOTTOM")
    model = model_in(deck(tmp_path, mesh=mesh, model=FIXED + lines), tmp_path)
    pinned = {((0, 0, 20, *-row), (0, 0, 10, *row)) for row in np.eye(3)}
    hung = {((2, 0, 20, *-row), (0, 0, 20, *(0.75 * row)), (10, 0, 20, *(0.25 * row))) for row in np.eye(3)}
    assert rows(model) == pinned | hung


@pytest.mark.parametrize(
    ("line", "facts"),
    [
        ("MEANROT, 9, 9, 9, 262", ("MEANROT", "PIN", "TIE", "LINEAR")),
        ("PIN, 9", ("PIN", 1, 2)),
        ("TIE, TOP, 5", ("TOP, 5",)),
        ("LINEAR, 9, 5, 6", ("node 9", "5 and 6")),
    ],
)
def test_other_constraints_of_nodes_are_refused(tmp_path, line, facts):
    with refused("*MPC", *facts):
        tg.files.import_deck(deck(tmp_path, model=FIXED + f"*MPC\n{line}\n"))


def test_pinned_bricks_are_one_block(tmp_path):
    folders = [tmp_path / "whole", tmp_path / "pinned"]
    for folder in folders:
        folder.mkdir()
    again = "".join(f"10{n}, {at}\n" for n, at in ((5, "0,0,10"), (6, "10,0,10"), (7, "10,10,10"), (8, "0,10,10")))
    mesh = (NODES + again + CELLS).replace("2, 5,6,7,8,9", "2, 105,106,107,108,9")
    sets = "*NSET, NSET=LOW\n5, 6, 7, 8\n*NSET, NSET=HIGH\n105, 106, 107, 108\n*MPC\nTIE, HIGH, LOW\n"
    files = [deck(folders[0]), deck(folders[1], mesh=mesh, model=FIXED + sets)]
    heights = []
    for file, folder in zip(files, folders, strict=True):
        model = model_in(file, folder)
        state = tg.solve(model).states[-1]
        heights.append(state.displacement[model.mesh.face_nodes("LID"), 2].mean())
    assert heights[1] == pytest.approx(heights[0], rel=0.01)  # two bricks have two mean stresses where they meet
