"""Bodies and faces of a CAD part are named by the file, by selectors and by splitting."""

import cad_cases as cases
import numpy as np
import pytest
from netgen.occ import Axes, Box, Compound, Pnt, ThruSections, WorkPlane, X, Y

import turgor as tg
from refused import refused
from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.read import read_here as read_cad
from turgor.core.geometry.cad.selectors import ByColor, ByName, InBox, NearestTo, WithNormal
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.cad.symmetry.requested import RequestedSymmetry
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.units import mm

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}


@pytest.fixture(scope="module")
def block(tmp_path_factory):
    """A block of 40 x 20 x 10 mm with a void, two colors and one name."""
    shape = Box(Pnt(0, 0, 0), Pnt(40, 20, 10)) - Box(Pnt(4, 4, 4), Pnt(36, 16, 8))
    for face in shape.faces:
        if face.center.z > 9.9:
            face.name = "lid"
        if face.center.x < 0.1:
            face.col = (1.0, 0.0, 0.0)
    return cases.written(tmp_path_factory.mktemp("block"), shape)


def areas(part):
    results = {}
    for face in dict.fromkeys(part.shape.faces):
        results[face.name] = results.get(face.name, 0.0) + face.mass
    return results


@pytest.mark.parametrize(
    ("selector", "area"),
    [
        (ByName("lid"), 800),
        (ByColor("red"), 200),
        (ByColor("#ff0000"), 200),
        (NearestTo((41 * mm, 10 * mm, 5 * mm)), 200),
        (InBox((-1 * mm, -1 * mm, -1 * mm), (41 * mm, 21 * mm, 0.001 * mm)), 800),
        (WithNormal("+x"), 200),
        (WithNormal((0, 0, -3.0)), 800),
    ],
)
def test_each_selector_picks_its_faces(block, selector, area):
    result = areas(read_cad(block, faces={"fixed": selector}))
    assert result["fixed"] == pytest.approx(area, rel=1e-9)
    assert result["cavity"] == pytest.approx(2 * (32 * 12 + 32 * 4 + 12 * 4), rel=1e-9)
    assert sum(result.values()) == pytest.approx(2 * (800 + 400 + 200) + result["cavity"], rel=1e-9)


@pytest.mark.parametrize(
    ("selector", "facts"),
    [
        (ByName("lad"), ("name 'lad'", "lid")),
        (ByColor("green"), ("color green", "#ff0000")),
        (InBox((0, 0, 0), (0, 0, 0)), ("box", "(0, 0, 0) mm", "(40, 20, 10) mm")),
        (WithNormal((1, 1, 1)), ("normal (0.57735, 0.57735, 0.57735)", "plane face")),
    ],
)
def test_a_selector_that_picks_nothing_says_what_there_is(block, selector, facts):
    with refused(*facts):
        read_cad(block, faces={"fixed": selector})


def test_two_names_for_one_face_are_refused(block):
    with refused("(0, 10, 5) mm", "fixed", "tip"):
        read_cad(block, faces={"fixed": WithNormal("-x"), "tip": ByColor("red")})


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: NearestTo((0, 1)), ("NearestTo", "(0, 1)")),
        (lambda: InBox((0, 0, 1), (1, 1, 0)), ("box", "1000 mm to 0 mm", "along z")),
        (lambda: WithNormal("up"), ("normal", "'up'", "'+x', '-x', '+y', '-y', '+z', '-z'")),
        (lambda: WithNormal((0, 0, 0)), ("normal", "(0, 0, 0)", "'+x'")),
        (lambda: ByColor("purpel"), ("color", "purpel", "purple")),
        (lambda: SplitPlane(), ("split", "neither", "position", "thickness")),
        (lambda: SplitPlane(position=1.0, thickness=1.0), ("split", "both", "position", "thickness")),
    ],
)
def test_selectors_are_checked_when_they_are_made(make, facts):
    with refused(*facts):
        make()


def test_standard_names_of_the_file_are_kept_and_others_are_not(tmp_path):
    shape = cases.FINGER.build().shape
    for face in shape.faces:
        if face.name == "outside":
            face.name = "skin of the finger"
    part = read_cad(cases.written(tmp_path, shape))
    assert part.faces == ("cavity", "fixed", "outside", "strain_limiting_layer", "tip")
    assert part.findings == ()


def test_a_plane_splits_off_the_bottom(tmp_path):
    path = cases.written(tmp_path, cases.finger())
    part = read_cad(path, faces=ENDS, split=SplitPlane(thickness=cases.FINGER.base))
    assert part.regions == ("body", "base")
    assert part.faces == ("cavity", "fixed", "outside", "strain_limiting_layer", "tip")
    whole = cases.FINGER.build()
    assert areas(part) == pytest.approx(areas(whole), rel=1e-9)
    assert part.cavity_volume == pytest.approx(whole.cavity_volume, rel=1e-9)
    solids = {solid.name: solid.mass for solid in part.shape.solids}
    assert solids == pytest.approx({solid.name: solid.mass for solid in whole.shape.solids}, rel=1e-9)
    named = read_cad(path, split=SplitPlane(position=-5 * mm, normal="-x", below="rear", interface="cut"))
    assert named.regions == ("body", "rear")
    assert "cut" in named.faces
    with refused("position", "80 mm", "0 and 15 mm"):
        read_cad(path, split=SplitPlane(position=80 * mm))
    with refused("thickness", "80 mm", "0 and 15 mm"):
        read_cad(path, split=SplitPlane(thickness=80 * mm))


def test_a_region_that_is_selected_does_not_move_the_split(tmp_path):
    path = cases.written(tmp_path, cases.tube())
    part = read_cad(path, regions={"rubber": NearestTo((0, 0, 0))}, split=SplitPlane(thickness=25 * mm, normal="+x"))
    assert set(part.regions) == {"rubber", "base"}
    masses = {solid.name: solid.mass for solid in part.shape.solids}
    assert masses["base"] == pytest.approx(masses["rubber"], rel=1e-9)


def test_bodies_of_an_assembly_of_another_program_keep_their_names():
    part = read_cad(cases.DATA / "cup_and_plate.step", faces=ENDS)
    assert part.regions == ("top", "base plate")
    assert part.cavity_volume / mm**3 == pytest.approx(34 * 14 * 8 + 3 * np.pi * 1.5**2, rel=1e-6)
    assert "interface" in part.faces
    renamed = read_cad(
        cases.DATA / "cup_and_plate.step", faces=ENDS, regions={"body": ByName("top"), "base": ByColor("blue")}
    )
    assert renamed.regions == ("body", "base")
    assert "strain_limiting_layer" in renamed.faces
    mesh = tg.mesh(renamed, size=5 * mm)
    assert set(mesh.regions) == {"body", "base"}
    with refused("body", "top plate", "base plate"):
        read_cad(cases.DATA / "cup_and_plate.step", regions={"body": ByName("top plate")})


def test_a_tube_of_another_program_has_its_radial_inlet():
    part = read_cad(cases.DATA / "tube_radial_inlet.step", faces=ENDS)
    assert part.regions == ("finger tube",)
    volume = np.pi * 64 * 40 + cases.radial_inlet_volume()
    assert part.cavity_volume / mm**3 == pytest.approx(volume, rel=1e-6)


def test_a_user_can_close_the_cavity_further_in(tmp_path):
    path = cases.written(tmp_path, cases.tube(inlet="z"))
    bore = InBox((4.9 * mm, -8.1 * mm, -8.1 * mm), (45.1 * mm, 8.1 * mm, 8.1 * mm))
    closed = read_cad(path, faces={"cavity": bore})
    assert closed.cavity_volume / mm**3 == pytest.approx(np.pi * 64 * 40, rel=2e-4)
    assert read_cad(path).cavity_volume - closed.cavity_volume > 24 * mm**3
    everything = InBox((-1, -1, -1), (1, 1, 1))
    with refused("(50,", "cavity", "tip"):
        read_cad(path, faces={"cavity": everything, "tip": WithNormal("+x")})


def test_cavities_can_be_numbered_by_hand(tmp_path):
    path = cases.written(tmp_path, cases.three_chambers())
    faces = {"cavity_1": NearestTo((25 * mm, -4.33 * mm, -2.5 * mm)), "cavity_2": NearestTo((25 * mm, 0, 5 * mm))}
    part = read_cad(path, faces=faces)
    assert set(part.cavity_volumes) == {"cavity_1", "cavity_2"}
    assert [volume / mm**3 for volume in part.cavity_volumes.values()] == pytest.approx(
        [cases.CHAMBER_VOLUME] * 2, rel=1e-6
    )


def test_two_bodies_that_touch_share_a_face_after_reading(tmp_path):
    bodies = [Box(Pnt(0, 0, 0), Pnt(10, 10, 10)), Box(Pnt(10, 2, 2), Pnt(15, 8, 8))]
    part = read_cad(cases.written(tmp_path, Compound(bodies)))
    assert part.regions == ("body_1", "body_2")
    assert areas(part)["interface"] == pytest.approx(36)


def test_three_colored_solids_become_three_bonded_regions(tmp_path):
    low, lid = Box(Pnt(0, 0, 0), Pnt(30, 10, 2)), Box(Pnt(0, 0, 8), Pnt(30, 10, 10))
    walls = Box(Pnt(0, 0, 2), Pnt(30, 10, 8)) - Box(Pnt(3, 2, 2), Pnt(27, 8, 8))
    for body, color in ((low, (1, 0, 0)), (walls, (0, 1, 0)), (lid, (0, 0, 1))):
        body.faces.col = color
    colors = {"base": ByColor("red"), "walls": ByColor("#00ff00"), "lid": ByColor("blue")}
    part = read_cad(cases.written(tmp_path, Compound([low, walls, lid])), faces=ENDS, regions=colors)
    assert set(part.regions) == {"base", "walls", "lid"}
    assert [volume / mm**3 for volume in part.cavity_volumes.values()] == pytest.approx([24 * 6 * 6])
    order = list(part.regions)
    low, high = ("-".join(sorted(pair, key=order.index)) for pair in (("base", "walls"), ("walls", "lid")))
    assert (areas(part)[low], areas(part)[high]) == pytest.approx((30 * 10 - 24 * 6,) * 2)
    assert "interface" not in part.faces
    half = read_cad(part.file, faces=ENDS, regions=colors, symmetry=RequestedSymmetry("y"))
    assert (areas(half)[low], areas(half)[high]) == pytest.approx((15 * 10 - 12 * 6,) * 2)
    mesh = tg.mesh(part, size=4 * mm)
    nodes = {name: set(np.unique(mesh.cells[cells]).tolist()) for name, cells in mesh.regions.items()}
    heights = {pair: np.unique(mesh.points[sorted(nodes[pair[0]] & nodes[pair[1]]), 2]) for pair in (
        ("base", "walls"), ("walls", "lid"), ("base", "lid")
    )}  # fmt: skip
    assert heights["base", "walls"] == pytest.approx([2 * mm])
    assert heights["walls", "lid"] == pytest.approx([8 * mm])
    assert not len(heights["base", "lid"])
    assert len(np.unique(np.round(mesh.points, 9), axis=0)) == len(mesh.points), "bonded: no node is there twice"


def test_walls_of_splines_are_followed(tmp_path):
    def loft(start, radii, step):
        circles = [WorkPlane(Axes((start + i * step, 0, 0), n=X, h=Y)).Circle(0, 0, r) for i, r in enumerate(radii)]
        return ThruSections([circle.Wire() for circle in circles])

    part = read_cad(cases.written(tmp_path, loft(0, (8, 11, 8), 15) - loft(3, (6, 9, 6), 12)), faces=ENDS)
    mesh = tg.mesh(part, size=4 * mm)
    assert cell_volumes(mesh).sum() == pytest.approx(part.solid_volume, rel=1e-3)
    ring = mesh.points[mesh.face_nodes("cavity")]
    middle = np.hypot(*ring[np.abs(ring[:, 0] - 15 * mm) < 0.5 * mm, 1:].T)
    assert middle == pytest.approx(9 * mm, rel=5e-3)


def test_an_assembly_of_many_bodies_keeps_their_names(tmp_path):
    bodies = [Box(Pnt(6 * i, 0, 4 * k), Pnt(6 * i + 6, 10, 4 * k + 4)) for i in range(12) for k in range(2)]
    for number, body in enumerate(bodies):
        body.name = f"part {number}"
    part = read_cad(cases.written(tmp_path, Compound(bodies)), faces=ENDS)
    assert set(part.regions) == {f"part {number}" for number in range(24)}
    pairs = {name: area for name, area in areas(part).items() if "-" in name}
    assert sum(pairs.values()) == pytest.approx(12 * 60 + 2 * 11 * 40)
    assert len(pairs) == 12 + 2 * 11
    assert pairs["part 3-part 5"] == pytest.approx(40)
    mesh = tg.mesh(part, size=6 * mm)
    assert {name: cell_volumes(mesh)[cells].sum() for name, cells in mesh.regions.items()} == pytest.approx(
        dict.fromkeys(part.regions, 240 * mm**3)
    )


def test_a_cad_file_notices_that_its_content_has_changed(tmp_path):
    path = cases.written(tmp_path, cases.tube())
    first = CadFile(file=path)
    assert CadFile(file=path, sha256=first.sha256) == first
    cases.written(tmp_path, cases.tube(inlet="y"))
    with refused("sha256", first.sha256[:12], path):
        CadFile(file=path, sha256=first.sha256)
