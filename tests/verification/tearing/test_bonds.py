"""Stress on the face between two bodies.

Problems: two blocks of rubber, the lower one three times as stiff, bonded on z = 0; (1) pulled apart without lateral
motion of the bond's neighborhood, that is with a uniform stress; (2) sheared in series.
Exact: (1) the traction is the nominal stress over the current area; (2) both blocks carry the same shear stress, μ γ.
Tolerance: 1e-6, since both states are homogeneous in each block.
"""

import numpy as np
import pytest

import meshes
import turgor as tg
from turgor.units import kPa

SOFT, STIFF = (tg.Material(name=name, law=tg.laws.NeoHooke(C10=c)) for name, c in (("soft", 50e3), ("stiff", 150e3)))


def bonded():
    """Cube of side 1 of two regions, with the face ``bond`` between them."""
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    low = mesh.points[mesh.cells][:, :4, 2].mean(axis=1) < 0.5
    sides = np.concatenate([mesh.cells[low][:, list(side)] for side in mesh.cell_type.sides])
    on = np.abs(mesh.points[sides][..., 2] - 0.5).max(axis=1) < 1e-9
    return tg.Mesh(
        points=mesh.points, cells=mesh.cells, regions={"low": np.flatnonzero(low), "high": np.flatnonzero(~low)},
        faces={**mesh.faces, "bond": sides[on]},
    )  # fmt: skip


def model(supports, loads):
    return tg.Model(bonded(), {"low": STIFF, "high": SOFT}, supports, loads)


def test_shear_in_series(record_verification):
    tau = 30 * kPa
    sides = [tg.Fixed(face, "yz") for face in ("x0", "x1", "y0", "y1", "z1")]
    shearing = tg.solve(model([tg.Fixed("z0"), *sides], [tg.Traction("z1", (tau, 0.0, 0.0))]), progress=False)
    got = tg.measures.bond_shear_on("bond")(shearing.states[-1])
    record_verification("shear stress of a bond between two blocks [kPa]", "exact", tau / kPa, got / kPa, "1e-6")
    assert got == pytest.approx(tau, rel=1e-6)


def test_pull_across(record_verification):
    pull = 20 * kPa
    free = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    equal = tg.Model(bonded(), {"low": SOFT, "high": SOFT}, free, [tg.Traction("z1", (0.0, 0.0, pull))])
    state = tg.solve(equal, progress=False).states[-1]
    stretch = 1 + state.displacement[:, 2].max()
    got = tg.measure(tg.solve(equal, progress=False), "bond_peel_stress_p99")["bond_peel_stress_p99"]
    record_verification("peel stress of a bond under uniaxial pull [kPa]", "exact", pull * stretch / kPa, got[-1] / kPa,
                        "1e-6")  # fmt: skip
    assert got[-1] == pytest.approx(pull * stretch, rel=1e-6)
    pushed = tg.Model(bonded(), {"low": SOFT, "high": SOFT}, free, [tg.Traction("z1", (0.0, 0.0, -pull))])
    assert tg.measure(tg.solve(pushed, progress=False), "bond_peel_stress_p99")["bond_peel_stress_p99"][-1] == 0.0
