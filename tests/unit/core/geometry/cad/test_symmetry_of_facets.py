"""Parts that are given by facets are cut at their mirror planes."""

import numpy as np
import pytest

import wedge_cases
from prints import PRINTS
from refused import refused
from turgor.core.geometry.cad.read import read_here
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.meshing.generate import mesh
from turgor.units import mm


def read(name, folder, asked="automatic", **broken):
    path = PRINTS[name]().write(folder / f"{name}.stl")
    return read_here(path, faces=wedge_cases.ENDS, symmetry=RequestedSymmetry(asked, **broken))


@pytest.mark.parametrize(("name", "planes"), [("half_round", "y"), ("open_inlet", "yz")])
def test_a_print_is_cut_at_its_mirror_planes(name, planes, tmp_path):
    whole, part = read(name, tmp_path, "none"), read(name, tmp_path)
    copies = 2 ** len(planes)
    assert part.faces == tuple(sorted([*whole.faces, *(f"symmetry_{letter}" for letter in planes)]))
    assert copies * part.solid_volume == pytest.approx(whole.solid_volume, rel=2e-3)
    assert copies * part.cavity_volumes["cavity"] == pytest.approx(whole.cavity_volumes["cavity"], rel=2e-3)
    edges = part.shape.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    assert len(np.unique(edges, axis=0)) == len(edges)  # closed, and all normals point outside
    assert set(map(tuple, edges)) == set(map(tuple, edges[:, ::-1]))
    assert "D07" in {finding.code for finding in part.findings}


@pytest.mark.slow
def test_the_cut_is_a_mirror_plane_of_the_mesh(tmp_path):
    made = mesh(read("half_round", tmp_path), size=6 * mm)
    assert made.symmetry_factor == 2
    assert np.abs(made.points[made.face_nodes("symmetry_y"), 1]).max() == 0.0
    assert made.points[:, 1].min() == 0.0


def test_planes_that_join_names_or_are_broken_by_loads_are_left(tmp_path):
    whole = read("omnidirectional", tmp_path)
    assert not any(face.startswith("symmetry") for face in whole.faces)
    assert "it maps 'cavity_2' onto 'cavity_3'" in whole.findings[-1].message
    with refused("across y", "cavity_2", "cavity_3"):
        read("omnidirectional", tmp_path, "y")
    left = read("open_inlet", tmp_path, broken={"z": "gravity acts along z"})
    assert "symmetry_z" not in left.faces
    assert "gravity acts along z" in left.findings[-1].message


def test_what_is_no_mirror_plane_is_refused(tmp_path):
    with refused("half_round.stl", "across z", "x, y"):
        read("half_round", tmp_path, "z")
    with refused("half_round.stl", "wedge", "STEP"):
        read("half_round", tmp_path, "wedge")
