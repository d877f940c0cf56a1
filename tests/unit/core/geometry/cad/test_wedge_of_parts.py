"""One sector of a CAD part that is the same after each of n turns: found, cut, meshed and refused."""

import numpy as np
import pytest
from netgen.occ import Cylinder, Face, Pnt, SplineInterpolation, Wire, X
from turgor.cad import read_cad

import turgor as tg
import wedge_cases
from refused import refused
from turgor.core.geometry.cad.naming import name_faces
from turgor.core.geometry.cad.part import load_part
from turgor.core.geometry.cad.symmetry.find import find_symmetry
from turgor.core.geometry.wedge import Wedge
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.exchange import write_stl
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.meshing.refining.split import split_edges
from turgor.core.meshing.surface import check_surface
from turgor.core.meshing.wedge import sectors
from turgor.units import mm

pytestmark = pytest.mark.usefixtures("read_here")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wedges")
    wedge_cases.written(wedge_cases.tube(), folder / "tube.step")
    wedge_cases.written(wedge_cases.chambers(), folder / "six.step")
    wedge_cases.written(wedge_cases.chambers(3, at=(4.0, -3.0)), folder / "three.step")
    return folder


def part(folder, name, symmetry):
    return read_cad(folder / f"{name}.step", faces=wedge_cases.ENDS, symmetry=symmetry)


@pytest.mark.parametrize(("symmetry", "fold"), [("wedge", 6), ("wedge 3", 3), ("wedge 2", 2)])
def test_a_sector_is_its_share_of_the_part(folder, symmetry, fold):
    if fold == 2:
        with refused("1/2", "six.step", "axis x"):
            part(folder, "six", symmetry)
        return
    whole, sector = part(folder, "six", "none"), part(folder, "six", symmetry)
    assert sector.wedge.fold == fold
    assert sector.solid_volume * fold == pytest.approx(whole.solid_volume, rel=1e-9)
    assert sector.cavity_volume * fold == pytest.approx(whole.cavity_volume, rel=1e-9)
    assert {"cyclic_low", "cyclic_high"} < set(sector.faces)
    assert sector.findings[-1].code == "D07"


def test_chambers_that_turns_join_get_one_name(folder):
    assert set(part(folder, "six", "wedge").cavity_volumes) == {"cavity"}
    thirds = part(folder, "six", "wedge 3")
    assert set(thirds.cavity_volumes) == {"cavity_1", "cavity_2"}
    assert "'cavity_1' stands for" in thirds.findings[-1].message


def test_the_axis_of_an_odd_part_is_not_the_middle_of_its_box(folder):
    sector = part(folder, "three", "wedge")
    assert sector.wedge.fold == 3
    assert np.array(sector.wedge.center)[1:] == pytest.approx([4 * mm, -3 * mm], abs=1e-6 * mm)


def test_automatic_takes_the_smaller_share(folder, tmp_path):
    path = wedge_cases.written(wedge_cases.lobed(), tmp_path / "lobed.step")
    assert read_cad(path, faces=wedge_cases.ENDS, symmetry="automatic").wedge.fold == 6
    assert part(folder, "tube", "automatic").wedge is None  # a quarter can be made axisymmetric
    assert part(folder, "six", "automatic").wedge is None  # its chambers have names of their own
    assert part(folder, "tube", "wedge").wedge.fold == 6
    assert part(folder, "tube", "wedge 16").wedge.fold == 16


@pytest.mark.parametrize(
    ("name", "asked", "facts"),
    [
        ("six", "wedge 5", ("six.step", "1/5 about x", "6 turns")),
        ("six", "wedge 40", ("'wedge 40'", "2 to 36")),
        ("six", "wedges", ("'wedges'", "2 to 36")),
    ],
)
def test_a_wedge_that_is_none_is_refused(folder, name, asked, facts):
    with refused(*facts):
        part(folder, name, asked)


def test_a_part_without_an_axis_has_no_wedge(tmp_path):
    shape = Cylinder(Pnt(0, 0, 0), X, r=8, h=20) - Cylinder(Pnt(2, 3, 1), X, r=3, h=10)
    with refused("odd.step", "x, y or z", "none"):
        read_cad(wedge_cases.written(shape, tmp_path / "odd.step"), symmetry="wedge")


def test_turned_faces_need_one_name(folder):
    names = wedge_cases.ENDS | {"cavity": tg.cad.NearestTo((8 * mm, 6 * mm, 0))}
    with refused("1/6 about x", "cavity", "outside"):
        read_cad(folder / "six.step", faces=names, symmetry="wedge")


def test_one_spline_with_lobes_is_no_body_of_revolution(tmp_path):
    angles = np.linspace(0, 2 * np.pi, 121)
    radius = 10 + 1.2 * np.cos(5 * angles)
    rim = [Pnt(0, r * np.cos(a), r * np.sin(a)) for r, a in zip(radius[:-1], angles[:-1], strict=True)]
    shape = Face(Wire([SplineInterpolation(rim, periodic=True)])).Extrude(12 * X)
    loaded = load_part(wedge_cases.written(shape, tmp_path / "lobes.step"))
    assert find_symmetry(loaded, name_faces(loaded, {}, None).names).fold == 5


@pytest.fixture(scope="module")
def sixth(folder):
    return tg.mesh(part(folder, "six", "wedge"), size=5 * mm)


def test_the_nodes_of_both_cuts_match(sixth):
    wedge, n = sixth.wedge, len(sixth.points)
    high = np.flatnonzero(sixth.leaders != np.arange(n))
    apart = wedge.images(sixth.points[sixth.leaders[high]]) - sixth.points[high]
    assert np.abs(apart).max() < 1e-15
    assert len(high) + (wedge.radii(sixth.points) < 1e-12).sum() == len(sixth.face_nodes("cyclic_high"))
    assert sixth.symmetry_factor == 6
    assert sixth.unknown_count < 3 * n + sixth.vertex_count


def test_all_sectors_make_the_whole(folder, sixth):
    whole = sectors(sixth).mesh
    assert cell_volumes(whole).min() > 0
    assert cell_volumes(whole).sum() == pytest.approx(part(folder, "six", "none").solid_volume, rel=2e-2)
    assert check_surface(whole) == ()
    assert whole.cavities == ("cavity",)


def test_cells_at_both_cuts_are_split_alike(sixth):
    edges = np.concatenate([sixth.cells[::7, e] for e in TETRAHEDRON.edges])
    fine = split_edges(sixth, np.unique(np.sort(edges, axis=1), axis=0))
    assert len(fine.cells) > 1.5 * len(sixth.cells)
    assert len(fine.face("cyclic_low")) == len(fine.face("cyclic_high")) > len(sixth.face("cyclic_low"))
    assert cell_volumes(sectors(fine).mesh).sum() == pytest.approx(6 * cell_volumes(sixth).sum(), rel=1e-12)


def test_the_surface_of_the_whole_is_written(folder, sixth, tmp_path):
    made = write_stl(sixth, tmp_path / "six.stl")
    assert made.open_edges == 0
    assert np.ptp(made.points, axis=0) == pytest.approx([16 * mm, 20 * mm, 20 * mm], rel=0.02)


def test_nodes_that_do_not_match_are_refused(sixth):
    points = sixth.points.copy()
    points[sixth.face_nodes("cyclic_high")[0]] += 0.1 * mm
    with refused("cyclic_high", "cyclic_low", "1/6 about x", "0.173 mm"):
        tg.Mesh(points=points, cells=sixth.cells, regions=sixth.regions, faces=sixth.faces, wedge=sixth.wedge)


def test_a_wedge_states_what_is_wrong():
    with refused("axis", "w", "x, y and z"):
        Wedge(axis="w", fold=6)
    with refused("fold", 99, "2 to 36"):
        Wedge(axis="x", fold=99)
