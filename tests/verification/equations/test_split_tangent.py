"""V24 where mean stresses jump and volume is penalized: energy, residual, tangent and extrapolated stress agree.

Problem: two cubes of cells of two rubbers with a sheet between them, so that mean stresses are doubled there; a large
random deformation and any mean stresses. Tetrahedra and 27-node hexahedra, whose energy has a penalty on the moments of
the lost volume; both rubbers incompressible, both compressible, one of each.
Exact: the residual is the derivative of the saddle functional Π = U + ∫ p (J − 1 − p/κ) dV, U the stored energy with
p²/2κ and the penalty; the tangent is the derivative of the residual; the stress that Newton's method extrapolates along
an update is linear in it, so that the error of a half update is a quarter.
Tolerance: 1e-6 of the largest entry for the tangent, and of the largest force for the energy, as in `test_tangent`; 5 %
for the factor of four. With half the penalty in the energy alone the error is 0.1, without the penalty in the
extrapolated stress the factor is 2.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from differences import difference
from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.energy import stored_energy
from turgor.core.engine.system import System
from turgor.core.meshing.cells import HEXAHEDRON, TETRAHEDRON
from turgor.core.meshing.surface import cell_sides

SHEET = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e6, nu=0.3)), 5e-4)
KINDS = {"ten-node tetrahedra": TETRAHEDRON, "27-node hexahedra": HEXAHEDRON}
BULK = {"incompressible": (np.inf, np.inf), "compressible": (1e6, 3e6), "one of each": (np.inf, 1e6)}


def two_rubbers(kind, bulk):
    """A soft cube beside a ten times stiffer one, curved, with a sheet between them."""
    place = lambda X: X + 3 * X[:, [1, 2, 0]] ** 2  # noqa: E731
    flat = meshes.box((0.02, 0.01, 0.01), (2, 1, 1), kind=kind)
    right = flat.points[flat.cells[:, : kind.corners]].mean(axis=1)[:, 0] > 0.01
    sides = cell_sides(flat.cells)
    middle = sides[(np.abs(flat.points[sides][..., 0] - 0.01) < 1e-9).all(axis=1)]
    middle = middle[: len(middle) // 2]  # each side once: the first half belongs to one cube
    _, once = np.unique(np.sort(middle, axis=1), axis=0, return_index=True)
    mesh = tg.Mesh(
        points=place(flat.points),
        cells=flat.cells,
        regions={"soft": np.flatnonzero(~right), "stiff": np.flatnonzero(right)},
        faces={**flat.faces, "middle": middle[once]},
    )
    soft, stiff = (
        problems.rubber(law, k) for law, k in zip((problems.YEOH, tg.laws.NeoHooke(C10=1e6)), bulk, strict=True)
    )
    return tg.Model(mesh, {"soft": soft, "stiff": stiff, "middle": SHEET}, [tg.Fixed("x0")], [])


def deformed(system, seed=17):
    """Unknowns of a large smooth deformation with noise on top, and any mean stresses."""
    rng = np.random.default_rng(seed)
    X = system.model.mesh.points
    u = X @ (0.25 * rng.uniform(-1, 1, (3, 3))) + 10 * X[:, [2, 0, 1]] * X + rng.normal(0, 1e-4, X.shape)
    return np.concatenate([u.ravel() / system.length, rng.uniform(-1, 1, system.element.mean_count)])


def saddle(system, unknowns):
    """The functional whose derivative the residual is, in scaled units."""
    e, r = system.element, system.element.tables
    u, p = system.split(unknowns)
    J = kernels_geometry.kinematics(e.shape, system.cells, u, r.dN, system.Jinv)[2]
    mean = np.einsum("qm,cm->cq", r.M, p[e.mean])
    lost = J - 1 - mean * system.materials.compliance[:, None]
    scale = system.stress_scale * system.length**3
    return stored_energy(system, unknowns, 0.0) / scale + float((system.dV * mean * lost).sum())


@pytest.mark.parametrize("bulk", BULK)
@pytest.mark.parametrize("kind", KINDS)
def test_energy_residual_and_tangent(kind, bulk, record_verification):
    system = System(two_rubbers(KINDS[kind], BULK[bulk]))
    assert system.element.mean_count == system.model.mesh.vertex_count + 4
    x, free = deformed(system), np.flatnonzero(~system.prescribed)
    residual, rng, h = system.residual(x, 1.0), np.random.default_rng(5), 1e-5
    errors = []
    for _ in range(6):
        way = np.where(system.prescribed, 0.0, rng.normal(size=system.size))
        slope = (saddle(system, x + h * way) - saddle(system, x - h * way)) / (2 * h)
        errors.append(abs(slope - residual @ way) / np.linalg.norm(residual[free]) / np.linalg.norm(way))
    exact = difference(system, x)[np.ix_(free, free)]
    tangent = system.tangent(x, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    record_verification(
        claim=f"two rubbers with a sheet between, {kind}, {bulk}: residual against differences of the energy, tangent "
        "against those of the residual",
        source="V24",
        expected=[0.0, 0.0],
        got=[max(errors), error],
        tolerance="1e-6",
    )
    assert max(errors) < 1e-6
    assert error < 1e-6


@pytest.mark.parametrize("bulk", BULK)
@pytest.mark.parametrize("kind", KINDS)
def test_extrapolated_stress_is_linear_in_the_update(kind, bulk, record_verification):
    """What is extrapolated along a way x + t d, against the stress that is there: the error grows as t²."""
    system = System(two_rubbers(KINDS[kind], BULK[bulk]))
    x = deformed(system)
    way = 1e-3 * np.where(system.prescribed, 0.0, np.random.default_rng(5).normal(size=system.size))
    at, errors = system.evaluate(x, 1.0), []
    for share in (1.0, 0.5):
        result = system.stresses(at, share * way).cells
        there = system.stresses(system.evaluate(x + share * way, 1.0)).cells
        errors.append(float(np.abs(result - there).max()))
    record_verification(
        claim=f"stress extrapolated along an update, two rubbers, {kind}, {bulk}: error over that of half the update",
        source="V24",
        expected=4.0,
        got=errors[0] / errors[1],
        tolerance="5 %",
    )
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.05)
