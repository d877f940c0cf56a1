"""Where mean stresses are doubled: between unlike rubbers and at inner faces on which something acts, nowhere else."""

import numpy as np
import pytest
from lattice_cases import KINDS, lattice

from turgor.core.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.loads import Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane
from turgor.core.model.supports import Fixed, Radial

SOFT = Material(name="soft", law=NeoHooke(C10=0.1e6))
STIFF = Material(name="stiff", law=NeoHooke(C10=1e6))
SHEET = Membrane(Material(name="paper", law=Hooke(E=1e9, nu=0.3)), 1e-4)
COUNTS = (2, 4, 3)
ON_BORDER, INSIDE_PATCH = 5 * 4, 2 * 4  # vertices at x = 1/2, and those of them below y = 1/2 (the rim left out)


@pytest.fixture(scope="module", params=KINDS)
def box(request: pytest.FixtureRequest) -> Mesh:
    return lattice(COUNTS, KINDS[request.param])


def count(
    mesh: Mesh,
    right: Material = SOFT,
    supports: tuple[object, ...] = (),
    loads: tuple[object, ...] = (),
    **more: object,
) -> int:
    """Mean stresses beyond one for each vertex."""
    sheets = more.pop("sheets", {})
    model = Model(mesh, {"left": SOFT, "right": right} | sheets, [Fixed("x0"), *supports], list(loads), **more)
    numbers, total = mean_stress_numbers(model)
    assert np.array_equal(np.unique(numbers), np.arange(total))
    check_each_number_has_one_vertex(mesh, numbers)
    return total - mesh.vertex_count


def check_each_number_has_one_vertex(mesh: Mesh, numbers: np.ndarray) -> None:
    vertices = mesh.cells[:, : numbers.shape[1]].ravel()
    pairs = np.unique(np.stack([numbers.ravel(), vertices], axis=1), axis=0)
    assert len(pairs) == len(np.unique(numbers))


def test_equal_rubbers_share_all(box: Mesh) -> None:
    same = Material(name="another name", law=NeoHooke(C10=0.1e6), density=1100.0)
    assert count(box, same) == 0


def test_unlike_rubbers_share_nothing_at_their_border(box: Mesh) -> None:
    assert count(box, STIFF) == ON_BORDER


@pytest.mark.parametrize(
    "right",
    [
        Material(name="soft", law=SOFT.law, bulk_modulus=1e8),
        Material(name="soft", law=SOFT.law, viscoelasticity=Prony(g=(0.2,), tau=(1.0,), moduli="instantaneous")),
    ],
)
def test_what_responds_otherwise_is_another_rubber(box: Mesh, right: Material) -> None:
    assert count(box, right) == ON_BORDER


def test_the_continuous_formulation_shares_all(box: Mesh) -> None:
    assert count(box, STIFF, formulation="continuous") == 0
    model = Model(box, {"left": SOFT, "right": STIFF}, [Fixed("x0")], [], "continuous")
    assert np.array_equal(mean_stress_numbers(model)[0], box.cells[:, : box.cell_type.corners])


def test_a_membrane_through_the_body_separates_its_sides(box: Mesh) -> None:
    assert count(box, sheets={"middle": SHEET}) == ON_BORDER


def test_around_the_rim_of_an_inner_face_cells_share(box: Mesh) -> None:
    """Vertices on the rim are reached around it; only those inside the face, or where it ends outside, are doubled."""
    assert count(box, sheets={"patch": SHEET}) == INSIDE_PATCH


@pytest.mark.parametrize(
    ("supports", "loads"),
    [((Fixed("patch"),), ()), ((), (Pressure("patch", 1e3),)), ((), (Traction("patch", (1.0, 0.0, 0.0)),))],
)
def test_supports_and_loads_on_inner_faces_let_it_jump(
    box: Mesh, supports: tuple[object, ...], loads: tuple[object, ...]
) -> None:
    assert count(box, supports=supports, loads=loads) == INSIDE_PATCH


def test_fibers_let_it_jump(box: Mesh) -> None:
    winding = Winding(angle_from_circumference=0.0, spacing=1e-3)
    fibers = Fibers(face="middle", material=SHEET.material, diameter=1e-4, winding=winding)
    assert count(box, reinforcements=[fibers]) == ON_BORDER


def test_outer_faces_do_not_matter(box: Mesh) -> None:
    assert count(box, loads=(Pressure("x1", 1e3),), sheets={"x1": SHEET}) == 0


def test_a_wound_face_of_a_wall_is_separated_by_a_radial_support(box: Mesh) -> None:
    assert count(box, supports=(Radial("middle"),)) == ON_BORDER
