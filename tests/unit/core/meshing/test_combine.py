"""Meshes are placed, mirrored and put together; supports are asked for body by body."""

from dataclasses import replace

import numpy as np
import pytest

from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.solids import Block, RoundBar
from turgor.core.inp.write_inp import write_inp
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.bodies.bodies import find_bodies, find_overlap
from turgor.core.meshing.bodies.combine import together
from turgor.core.meshing.bodies.placing import mirrored, placed
from turgor.core.meshing.exchange import read_mesh
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import cell_volumes, refuse_inverted
from turgor.core.meshing.quality.checks import check_mesh
from turgor.core.meshing.quality.proximity import find_facing_walls, smallest_gap
from turgor.core.model.contact import Contact
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.model.supports import Fixed, Support
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.mesh_vtu import write_mesh_vtu
from turgor.core.results.measures.cavities import enclosed_volume
from turgor.core.solvers.checks.supports import check_supports
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity
from turgor.units import deg, kPa, mm
from turgor.views.report.mesh_text import describe_mesh

RUBBER = Material(name="rubber", law=NeoHooke(C10=0.1e6))
PNEUNET = FastPneuNet(chambers=2, length=20 * mm)


def of_20_nodes(hexahedra: Mesh) -> Mesh:
    """The same mesh without the middles of sides and cells."""
    cells = hexahedra.cells[:, :20]
    used = np.unique(cells)
    number = np.full(len(hexahedra.points), -1)
    number[used] = np.arange(len(used))
    faces = {name: number[sides[:, :8]] for name, sides in hexahedra.faces.items()}
    return replace(hexahedra, points=hexahedra.points[used], cells=number[cells], faces=faces, serendipity=False)


@pytest.fixture(scope="module")
def finger() -> Mesh:
    return mesh(PNEUNET.build(), size=4 * mm)


@pytest.fixture(scope="module")
def meshes(finger: Mesh) -> dict[int, Mesh]:
    """The finger, and a hexahedral one, by the nodes of their cells."""
    hexahedra = mesh(PNEUNET.build(), size=4 * mm, cells="hexahedra")
    return {10: finger, 20: of_20_nodes(hexahedra), 27: hexahedra}


@pytest.fixture(scope="module")
def bar() -> Mesh:
    """Half a bar across the finger, cut at symmetry_y."""
    half = mesh(RoundBar(radius=4 * mm, length=30 * mm, mirrors="x").build(), size=5 * mm)
    return placed(half, angle=90 * deg, shift=(12 * mm, 0, 0))


@pytest.fixture(scope="module")
def pair(finger: Mesh, bar: Mesh) -> Mesh:
    """Two fingers, 12 mm apart, and a bar of 8 mm between them."""
    upper = placed(finger, shift=(0, 0, 6 * mm))
    return together({"upper": upper, "lower": mirrored(upper), "bar": bar})


def volume(of: Mesh, *cavities: str) -> float:
    """What cavities enclose at rest."""
    materials = dict.fromkeys(of.regions, RUBBER)
    zero = np.zeros_like(of.points)
    rest = State(
        model=Model(of, materials, [], []),
        load_factor=0.0,
        displacement=zero,
        mean_stress=np.zeros(0),
        nodal_force=zero,
    )
    return enclosed_volume(StateFields(rest), cavities)


def codes(of: Mesh) -> set[str]:
    return {finding.code for finding in check_mesh(of)}


@pytest.mark.parametrize("nodes", [10, 20, 27])
@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 2, 0), (1, 0, 1)])
def test_a_mirror_image_is_right_side_out(meshes: dict[int, Mesh], nodes: int, normal: tuple[float, ...]) -> None:
    original = meshes[nodes]
    image = mirrored(original, normal)
    n = np.array(normal) / np.linalg.norm(normal)
    assert image.points == pytest.approx(original.points - 2 * np.outer(original.points @ n, n), abs=1e-15)
    refuse_inverted(image)
    assert cell_volumes(image) == pytest.approx(cell_volumes(original))
    assert image.symmetry_faces == ("symmetry_y",)
    if nodes != 20:  # these have no triangles to look at
        assert codes(image) == codes(original)  # faces turned over would be G04
        assert volume(image, "cavity") == pytest.approx(volume(original, "cavity"))


@pytest.mark.parametrize("nodes", [10, 20, 27])
def test_the_image_of_the_image_is_the_original(meshes: dict[int, Mesh], nodes: int) -> None:
    original = meshes[nodes]
    twice = mirrored(mirrored(original))
    assert np.array_equal(twice.points, original.points)
    assert np.array_equal(twice.cells, original.cells)
    for name, sides in original.faces.items():
        assert np.array_equal(twice.faces[name], sides)


def test_a_turn_follows_the_right_hand_and_comes_before_the_shift() -> None:
    block = mesh(Block().build(), size=10 * mm)
    turned = placed(block, shift=(1, 0, 0), axis=(0, 0, 5), angle=90 * deg)
    x, y, z = block.points.T
    assert turned.points == pytest.approx(np.column_stack([1 - y, x, z]), abs=1e-15)
    skew = placed(block, axis=(1, 1, 1), angle=120 * deg)  # x to y, y to z, z to x
    assert skew.points == pytest.approx(np.column_stack([z, x, y]), abs=1e-15)
    tilted = placed(block, axis=(1, 2, 3), angle=0.3)
    assert cell_volumes(tilted) == pytest.approx(cell_volumes(block))


def test_a_mirror_plane_is_renamed_when_it_is_another_coordinate_plane(finger: Mesh) -> None:
    turned = placed(finger, axis=(1, 0, 0), angle=90 * deg, shift=(0, 0, 5 * mm))
    assert turned.symmetry_faces == ("symmetry_z",)
    assert set(turned.points[turned.face_nodes("symmetry_z"), 2]) == {5 * mm}
    nearly = placed(finger, axis=(1, 0, 0), angle=90 * deg + 5e-7)
    assert len(set(nearly.points[nearly.face_nodes("symmetry_z"), 2])) == 1  # exactly plane all the same
    own = replace(finger, faces={"symmetry_middle": finger.faces["symmetry_y"]})
    assert placed(own, axis=(1, 0, 0), angle=90 * deg).symmetry_faces == ("symmetry_middle",)


@pytest.mark.parametrize("angle", [30 * deg, 0.01 * deg, 135 * deg])
def test_a_mirror_plane_that_would_be_askew_is_refused(finger: Mesh, angle: float) -> None:
    with refused("symmetry_y", "about y"):
        placed(finger, axis=(1, 0, 0), angle=angle)
    assert placed(finger, axis=(0, 1, 0), angle=angle).symmetry_faces == ("symmetry_y",)
    with refused("symmetry_y", "about y"):
        mirrored(finger, (0, 1, 2))


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"angle": 90.0}, ("angle", "5156.6 deg", "-360 deg to 360 deg")),
        ({"shift": (0, 0, 20)}, ("shift along z", "20000 mm", "-2000 mm to 2000 mm", "unit")),
        ({"shift": (0, 0)}, ("shift", "(0, 0)", "three lengths")),
        ({"axis": (0, 0, 0)}, ("axis", "(0, 0, 0)", "(0, 0, 1)")),
    ],
)
def test_numbers_that_cannot_be_meant_are_refused(finger: Mesh, wrong: dict, facts: tuple) -> None:
    with refused(*facts):
        placed(finger, **wrong)


def test_bodies_keep_their_parts_under_names_of_their_own(pair: Mesh, finger: Mesh, bar: Mesh) -> None:
    assert list(pair.regions) == ["body_upper", "base_upper", "body_lower", "base_lower", "body_bar"]
    assert pair.cavities == ("cavity_lower", "cavity_upper")
    assert {"fixed_upper", "tip_lower", "outside_bar", "ends_bar"} < set(pair.faces)
    assert pair.symmetry_faces == ("symmetry_y",)
    assert pair.symmetry_factor == 2
    assert len(pair.points) == 2 * len(finger.points) + len(bar.points)
    assert cell_volumes(pair)[pair.region("body_bar")] == pytest.approx(cell_volumes(bar))
    assert pair.points[pair.face("tip_upper")] == pytest.approx(finger.points[finger.face("tip")] + [0, 0, 6 * mm])
    assert len(pair.face("symmetry_y")) == 2 * len(finger.face("symmetry_y")) + len(bar.face("symmetry_y"))


def test_cavities_enclose_what_they_did(pair: Mesh, finger: Mesh) -> None:
    alone = volume(finger, "cavity")
    assert volume(pair, "cavity_upper") == pytest.approx(alone)
    assert volume(pair, *pair.cavities) == pytest.approx(2 * alone)


def test_checks_find_nothing_new(pair: Mesh, finger: Mesh) -> None:
    assert codes(pair) - {"G08"} == codes(finger) - {"G08"}
    assert "regions: body_upper" in describe_mesh(pair)


def test_findings_say_where_they_are_from(finger: Mesh) -> None:
    result = Finding(code="G08", severity=Severity.NOTE, message="Mended.", advice="Look.")
    noted = placed(placed(replace(finger, findings=(result,))), shift=(0, 0, 50 * mm))
    (said,) = together({"a": noted, "b": replace(finger, findings=())}).findings
    assert said.message == "Body 'a': Before it was moved: Mended."


def test_bodies_and_what_lies_on_each_are_found(pair: Mesh) -> None:
    upper, lower, bar = find_bodies(pair)
    assert upper.regions == ("body_upper", "base_upper")
    assert "cavity_lower" in lower.faces and "symmetry_y" not in lower.faces
    assert bar.faces == ("ends_bar", "outside_bar")
    assert sorted(np.concatenate([body.nodes for body in (upper, lower, bar)])) == list(range(len(pair.points)))


def test_a_body_beside_the_mirror_plane_has_a_twin(finger: Mesh) -> None:
    small = mesh(Block(length=4 * mm, width=4 * mm, height=4 * mm).build(), size=4 * mm)
    beside = together({"finger": finger, "block": placed(small, shift=(5 * mm, 5 * mm, -5 * mm))})
    assert beside.symmetry_faces == ("symmetry_y",)
    for y in (0.0, -5 * mm, 2 * mm):  # across the plane, on the other side, and touching its twin
        with refused("'block'", "symmetry_y", "'finger'"):
            together({"finger": finger, "block": placed(small, shift=(5 * mm, y, -5 * mm))})
    with refused("'other'", "symmetry_y", "'finger'"):
        together({"finger": finger, "other": placed(mirrored(finger, (0, 1, 0)), shift=(0, 0, 30 * mm))})


def test_either_side_of_the_mirror_plane_can_be_modeled(finger: Mesh) -> None:
    other = mirrored(finger, (0, 1, 0))
    assert together({"a": other, "b": placed(other, shift=(0, 0, 30 * mm))}).points[:, 1].max() == 0


def test_mirror_planes_must_be_the_same(finger: Mesh) -> None:
    with refused("symmetry_y", "'b'", "y = 1 mm", "'a'", "0 mm"):
        together({"a": finger, "b": placed(finger, shift=(0, 1 * mm, 30 * mm))})
    renamed = replace(finger, faces={"symmetry_cut": finger.face("symmetry_y")})
    both = together({"a": finger, "b": placed(renamed, shift=(0, 0, 30 * mm))})
    assert both.symmetry_faces == ("symmetry_y",)  # one plane under two names would count twice
    quarter = mesh(Block(mirrors="z").build(), size=10 * mm)
    odd = placed(replace(quarter, faces={"symmetry_y": quarter.face("symmetry_z")}), shift=(0, 20 * mm, 0))
    with refused("symmetry_y", "mirror planes"):
        together({"a": finger, "b": odd})


def test_what_cannot_be_put_together_is_refused(finger: Mesh, meshes: dict[int, Mesh]) -> None:
    apart = placed(finger, shift=(0, 0, 30 * mm))
    for bodies, facts in (
        ({"a": finger}, ("1 body", "least two")),
        ({"a b": finger, "c": apart}, ("body 'a b'", "underscores")),
        ({"a": finger, "b": meshes[27]}, ("body 'b'", "27-node hexahedra", "'a'", "ten-node tetrahedra")),
        ({"a": finger, "b": placed(finger, shift=(1 * mm, 0, 0))}, ("'a' and 'b'", "overlap", "mm")),
        ({"b": replace(finger, regions={"body_a": np.arange(len(finger.cells))}), "a_b": apart}, ("'body_a_b'",)),
    ):
        with refused(*facts):
            together(bodies)


@pytest.mark.parametrize("cells", ["tetrahedra", "hexahedra"])
def test_overlaps_are_told_from_touching(cells: str) -> None:
    large = mesh(Block().build(), size=10 * mm, cells=cells)
    small = mesh(Block(length=4 * mm, width=4 * mm, height=4 * mm).build(), size=4 * mm, cells=cells)
    assert find_overlap(large, placed(large, shift=(20 * mm, 0, 0))) is None
    assert find_overlap(large, placed(large, axis=(0, 0, 1), angle=45 * deg, shift=(24.2 * mm, 0, 0))) is None
    assert find_overlap(large, placed(large, shift=(16 * mm, 0, 0))) is not None
    within = placed(small, shift=(5 * mm, 5 * mm, 5 * mm))  # wholly, and between the corners of the cells
    assert find_overlap(within, large) is not None
    assert find_overlap(large, within) is not None


def test_a_body_may_stand_in_the_cavity_of_another() -> None:
    wide = mesh(FastPneuNet(chambers=1, length=40 * mm).build(), size=4 * mm)
    low, high = (wide.points[wide.face_nodes("cavity")].min(axis=0), wide.points[wide.face_nodes("cavity")].max(axis=0))
    block = mesh(Block(length=2 * mm, width=2 * mm, height=2 * mm).build(), size=2 * mm)
    assert find_overlap(wide, placed(block, shift=tuple((low + high) / 2))) is None


def test_bodies_face_each_other_and_contact_is_on_by_itself(pair: Mesh) -> None:
    walls = find_facing_walls(pair)
    assert smallest_gap(walls) == pytest.approx(1 * mm, rel=0.01)  # between the chambers
    assert len(walls.pairs) == 4  # two gaps between chambers, and the bar with either finger
    far = mesh(Block().build(), size=10 * mm)
    strangers = together({"a": far, "b": placed(far, shift=(200 * mm, 0, 0))})
    assert len(find_facing_walls(strangers).pairs) == 0
    assert Contact().for_mesh(strangers) is not None  # they may meet after all
    assert Contact().for_mesh(far) is None
    assert Contact(self_contact=False).for_mesh(strangers) is None


def model(of: Mesh, supports: list[Support], contact: Contact | None = None) -> Model:
    return Model(of, dict.fromkeys(of.regions, RUBBER), supports, [], contact=contact)


HELD = [Fixed("fixed_upper"), Fixed("fixed_lower"), Fixed("ends_bar")]


@pytest.mark.parametrize(
    ("missing", "body", "face"),
    [(0, "'body_upper' and 'base_upper'", "fixed_upper"), (2, "'body_bar'", "ends_bar")],
)
def test_every_body_needs_supports_of_its_own(pair: Mesh, missing: int, body: str, face: str) -> None:
    check_supports(model(pair, HELD))
    with refused("3 of 6", body, "B01", f"'{face}'", "Contact"):  # the mirror plane fixes the other motions
        check_supports(model(pair, [support for i, support in enumerate(HELD) if i != missing]))


def test_a_face_that_is_meant_for_it_is_proposed_first(finger: Mesh) -> None:
    other = replace(finger, faces=dict(reversed(finger.faces.items())))
    both = together({"a": finger, "b": placed(other, shift=(0, 0, 30 * mm))})
    with refused("3 of 6", "'body_b' and 'base_b'", "'fixed_b'"):
        check_supports(model(both, [Fixed("fixed_a")]))


def test_a_direction_is_enough_where_mirror_planes_hold_the_rest() -> None:
    quarter = mesh(RoundBar(radius=4 * mm, mirrors="yz").build(), size=4 * mm)
    check_supports(model(quarter, [Fixed("ends", "x")]))
    with refused("1 of 6", "B01"):
        check_supports(model(quarter, []))


def test_obstacles_are_no_supports(finger: Mesh) -> None:
    plate = Obstacle(name="plate", shape=Plane(point=(0, 0, -1 * mm), normal=(0, 0, 1)))
    with refused("3 of 6", "B01", "'plate'"):
        check_supports(model(finger, [], Contact(obstacles=[plate])))


def test_one_body_whose_whole_surface_is_held_is_refused() -> None:
    block = mesh(Block().build(), size=10 * mm)
    both = together({"a": block, "b": placed(block, shift=(50 * mm, 0, 0))})
    with refused("B01", "incompressible", "bulk_modulus"):
        check_supports(model(both, [Fixed("ends_a"), Fixed("ends_b"), Fixed("outside_b")]))


def test_files_keep_the_names(pair: Mesh, tmp_path) -> None:
    loads = [Pressure("cavity_upper", 1 * kPa), Pressure("cavity_lower", 2 * kPa)]
    write_inp(Model(pair, dict.fromkeys(pair.regions, RUBBER), HELD, loads), tmp_path / "pair.inp", program="abaqus")
    back = read_mesh(tmp_path / "pair.inp")
    assert set(back.faces) - set(pair.faces) == {"contact_outside", "contact_cavity_upper"}  # of its contact pairs
    assert {name: len(cells) for name, cells in back.regions.items()} == {n: len(c) for n, c in pair.regions.items()}
    assert back.cavities == pair.cavities and back.symmetry_factor == 2
    write_mesh_vtu(tmp_path / "pair.vtu", pair)
    assert len(read_mesh(tmp_path / "pair.vtu", unit="m").cells) == len(pair.cells)
