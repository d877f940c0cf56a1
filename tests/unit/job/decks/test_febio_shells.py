"""Shells of .feb files without solids: the solid cells that they become, and what is refused."""

import numpy as np
import pytest

import turgor as tg
from febio_cases import SOFT, feb
from refused import refused

#: Two squares of 10 mm that fold by a right angle; a third one goes on in the plane of the first.
POINTS = "".join(
    f'<node id="{n}">{at}</node>'
    for n, at in enumerate(
        ("0,0,0", "10,0,0", "10,10,0", "0,10,0", "10,0,10", "10,10,10", "20,0,0", "20,10,0", "10,0,-2"), start=1
    )
)
DOMAIN = '<ShellDomain name="SKIN" mat="SOFT"><shell_thickness>2</shell_thickness></ShellDomain>'
FIXED = '<bc node_set="EDGE" type="zero displacement"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>'
SETS = '<NodeSet name="EDGE">1,4</NodeSet><NodeSet name="END">3</NodeSet>'
PRESSED = '<surface_load surface="TOP" type="pressure"><pressure lc="1">0.03</pressure></surface_load>'


def skin(folder, cells, boundary=FIXED, domain=DOMAIN, kind="quad4"):
    rows = "".join(f'<elem id="{k}">{nodes}</elem>' for k, nodes in enumerate(cells, start=1))
    top = f'<Surface name="TOP"><{kind} id="1">{cells[0]}</{kind}></Surface>'
    mesh = f'<Elements type="{kind}" name="SKIN">{rows}</Elements>{SETS}{top}'
    return feb(folder, mesh=mesh, points=POINTS, domains=domain, boundary=boundary, loads=PRESSED, material=SOFT)


def mesh_of(file, folder):
    job = tg.jobs.read_job(tg.files.import_deck(file, units="mm, N, MPa").write(folder, force=True))
    return job.actuator.read(), job


def test_a_fold_has_a_miter(tmp_path):
    mesh, job = mesh_of(skin(tmp_path, ["1,2,3,4", "3,2,5,6"]), tmp_path)
    assert len(mesh.cells) == 2
    points = mesh.points * 1e3
    at_fold = points[np.isclose(points[:, 0], 11) & np.isclose(points[:, 2], -1)]
    assert len(at_fold) == 3  # the mean of (0, 0, 2) and (−2, 0, 0) lies behind the nodes of the fold
    assert points.min(axis=0) == pytest.approx([0, 0, -2])
    pressed = mesh.points[mesh.face_nodes("TOP")] * 1e3
    assert pressed[:, 2] == pytest.approx(np.zeros(9))
    assert job.supports[0].directions == "xyz"


def test_a_hinge_leaves_the_back_free(tmp_path):
    mesh, job = mesh_of(skin(tmp_path, ["1,2,3,4"]), tmp_path)
    assert mesh.points[mesh.node_sets[job.supports[0].place], 2] == pytest.approx(np.zeros(3))
    back = (
        '<bc node_set="EDGE" type="zero shell displacement"><sx_dof>1</sx_dof><sy_dof>1</sy_dof><sz_dof>1</sz_dof></bc>'
    )
    mesh, job = mesh_of(skin(tmp_path, ["1,2,3,4"], FIXED + back), tmp_path)
    assert len(mesh.face_nodes(job.supports[0].place)) == 9


def test_a_back_may_be_moved(tmp_path):
    move = '<bc node_set="END" type="prescribed shell displacement"><dof>sz</dof><value lc="1">1.5</value></bc>'
    mesh, job = mesh_of(skin(tmp_path, ["1,2,3,4"], FIXED + move), tmp_path)
    moved = next(each for each in job.supports if type(each).__name__ == "Displacement")
    assert moved.shift == pytest.approx([0, 0, 1.5e-3])
    assert mesh.points[mesh.node_sets[moved.place]] * 1e3 == pytest.approx(np.array([[10, 10, -2]]))


def test_triangles_become_wedges(tmp_path):
    mesh, _ = mesh_of(skin(tmp_path, ["1,2,3", "1,3,4"], kind="tri3"), tmp_path)
    assert np.ptp(mesh.points, axis=0) * 1e3 == pytest.approx([10, 10, 2])


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        (["1,2,3,4", "3,2,5,6", "2,7,8,3"], ["2 and 3"]),
        (["1,2,3,4", "2,3,8,7"], ["node 2", "fold", "turned over"]),
    ],
)
def test_shells_without_a_back_are_refused(tmp_path, cells, words):
    with refused('<Elements name="SKIN" type="quad4">', *words):
        tg.files.import_deck(skin(tmp_path, cells), units="mm, N, MPa")
