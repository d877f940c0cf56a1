"""V24: the tangent is the derivative of the residual: material, geometric, pressure and membrane parts, all columns.

Problem: two cubes of cells at a random, large deformation and mean stress; each case adds one part. A law in
principal stretches is tested where stretches are equal, too. Residuals at x ± h e_j give the columns by central
differences.
Exact: equality for the free unknowns (supports drop the rest, with them the rim terms of pressure on a cut cavity).
Tolerance: 1e-6 of the largest entry of the tangent; the differences themselves are good to 1e-8 at h = 1e-5, so a tenth
of the tolerance is left to them. The compressibility of 1e-9 that keeps incompressible tangents regular is far below.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from differences import difference
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    BlatzKo,
    CompressibleNeoHooke,
    ExtendedTube,
    GeneralizedRivlin,
    Gent,
    Hyperfoam,
    Ogden,
)

SHEET = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e6, nu=0.3)), 5e-4)
SHELL = tg.Shell(tg.Material(name="sheet", law=tg.laws.Hooke(E=5e7, nu=0.3)), 1e-3)
WRINKLING = tg.Membrane(SHEET.material, SHEET.thickness, compression=0.0)
OPEN = tg.Pressure("z1", 4e4)
OGDEN = Ogden(mu=(8e4, 2e3, -1e4), alpha=(1.7, 5.0, -2.3))
AROUND = tg.laws.Orientation(along=(1, 0.2, 0), around=(0, -0.02, 0.005), angle="30 deg")
FIBERS = tg.Material(
    name="fibers", law=tg.laws.HolzapfelGasserOgden(C10=5e4, k1=9e4, k2=0.7, kappa=0.05), orientation=AROUND
)
PRINT = tg.Material(
    name="print",
    law=tg.laws.Orthotropic(C10=5e4, C20=1e4, a1=6e4, a2=3e4),
    orientation=tg.laws.Orientation(along=(1, 0.5, 0), across=(0, 1, 1)),
    bulk_modulus=1e6,
)
FOAM = Hyperfoam(mu=(3e4, -1e4), alpha=(6.0, -3.0), nu=(0.0, 0.2))
STATES = (
    tg.loads.Shrinkage("body", 0.1),
    tg.loads.PreStretch("body", 1.4, (1, 2, 0)),
    tg.loads.PreStretch("body", 1.2, (0, 0, 1), "around", (0, -5e-3, 0)),
    tg.loads.Stiffness("body", 0.3),
)
GUIDES = ((7.5e-5, 5.3e-3, 10e-3), (10.075e-3, 5.3e-3, 10.3e-3), (20.012e-3, 2.3e-3, 11.2e-3))
PULLED = tg.loads.Tendon(through=GUIDES, tension=5.0)
DRAWN = tg.loads.Tendon(through=GUIDES, pull=4e-3, cable_stiffness=2e3, friction=0.4)
WIRE = tg.loads.ShapeMemoryWire(
    through=GUIDES, diameter=2e-4, alloy="nitinol-brinson-1993", strain=0.04, temperature="80 °C"
)
TILTED = {"density": 3e5, "level": 0.05, "direction": (0.3, -1, 0.5)}
WATER = tuple(tg.loads.HydrostaticPressure(face=side, **TILTED) for side in meshes.SIDES)
FLOAT = (tg.loads.HydrostaticPressure(face="z1", free_surface=True, **TILTED | {"level": -0.005}),)
NETWORK = (*STATES[:2], tg.loads.Hardening("body", 1.5))
CASES = {
    "tendon": (problems.NEO_HOOKE, np.inf, None, (PULLED,)),
    "tendon with friction, drawn in": (problems.NEO_HOOKE, np.inf, None, (DRAWN,)),
    "shape-memory wire": (problems.NEO_HOOKE, np.inf, None, (WIRE,)),
    "neo-Hookean, incompressible": (problems.NEO_HOOKE, np.inf, None, ()),
    "Mooney-Rivlin, compressible": (tg.laws.MooneyRivlin(C10=1e4, C01=9e4), 1e6, None, ()),
    "Yeoh, incompressible": (tg.Yeoh(C10=1e5, C20=2e4, C30=-1e3), np.inf, None, ()),
    "Ogden, incompressible": (OGDEN, np.inf, None, ()),
    "Ogden, compressible": (OGDEN, 1e6, None, ()),
    "extended tube": (ExtendedTube(Gc=8e4, Ge=6e4, delta=0.2, beta=0.4), np.inf, None, ()),
    "fibers in a body": (FIBERS, np.inf, None, ()),
    "print": (PRINT, np.inf, None, ()),
    "hyperfoam": (FOAM, np.inf, None, ()),
    "compressible neo-Hooke": (CompressibleNeoHooke(mu=1e5, nu=0.3), np.inf, None, ()),
    "Blatz-Ko": (BlatzKo(mu=1e5), np.inf, None, ()),
    "Gent, incompressible": (Gent(mu=2e5, Jm=30.0), np.inf, None, ()),
    "Arruda-Boyce, incompressible": (ArrudaBoyce(mu=2e5, locking_stretch=2.5), np.inf, None, ()),
    "generalized Rivlin, compressible": (
        GeneralizedRivlin.from_names({"C10": 5e4, "C01": 2e4, "C11": 3e3, "C02": -1e2}),
        1e6,
        None,
        (),
    ),
    "pressure on an open face": (problems.YEOH, np.inf, None, (OPEN,)),
    "pressure on all faces": (problems.YEOH, np.inf, None, tuple(tg.Pressure(s, 4e4) for s in meshes.SIDES)),
    "liquid on all faces": (problems.YEOH, np.inf, None, WATER),
    "liquid with a free surface on an open face": (problems.YEOH, np.inf, None, FLOAT),
    "membrane": (problems.YEOH, np.inf, SHEET, ()),
    "membrane that wrinkles": (problems.YEOH, np.inf, WRINKLING, ()),
    "shell": (problems.YEOH, np.inf, SHELL, ()),
    "states of a body": (problems.YEOH, np.inf, None, STATES),
    "states of a body, in stretches": (OGDEN, 1e6, SHEET, STATES),
    "network with a shape of its own": (problems.YEOH, np.inf, None, NETWORK),
    "network with a shape of its own, in stretches": (OGDEN, 1e6, None, NETWORK),
    "membrane and pressure": (problems.YEOH, 2e7, SHEET, (OPEN,)),
}


def _system(name):
    law, kappa, sheet, loads = CASES[name]
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1), lambda X: X + 3 * X[:, [1, 2, 0]] ** 2)
    material = law if isinstance(law, tg.Material) else problems.rubber(law, kappa)
    materials = {"body": material} | ({"y1": sheet} if sheet else {})
    X = mesh.points
    loads = [each.begun(0.3 * X[:, [1, 2, 0]] + 10 * X * X) if each.hardens else each for each in loads]
    return System(tg.Model(mesh, materials, [tg.Fixed("x0")], loads))


def _deformed(system, seed):
    """Unknowns of a large smooth deformation with noise on top, and any mean stress."""
    rng = np.random.default_rng(seed)
    X = system.model.mesh.points
    gradient = 0.25 * rng.uniform(-1, 1, (3, 3))
    u = X @ gradient + 10 * X[:, [2, 0, 1]] * X + rng.normal(0, 1e-4, X.shape)
    p = rng.uniform(-1, 1, system.model.mesh.vertex_count)
    return np.concatenate([u.ravel() / system.length, p])


@pytest.mark.parametrize("name", CASES)
def test_tangent_is_the_derivative_of_the_residual(name, record_verification):
    system = _system(name)
    unknowns = _deformed(system, seed=17)
    free = np.flatnonzero(~system.prescribed)
    exact = difference(system, unknowns)[np.ix_(free, free)]
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    record_verification(
        claim=f"tangent against differences of the residual, {name}: worst entry over the largest",
        source="V24",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6


@pytest.mark.parametrize(("law", "kappa"), [(OGDEN, np.inf), (OGDEN, 1e6), (FOAM, np.inf)])
@pytest.mark.parametrize("state", ["rest", "equal stretches", "two equal stretches", "nearly equal stretches"])
def test_tangent_of_a_law_in_stretches_where_they_are_equal(state, law, kappa, record_verification):
    """At rest, blown up, and in uniaxial tension, all turned by some angle, the quotients of the chain rule are 0/0."""
    mesh = meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    system = System(problems.one_material(mesh, law, kappa, [tg.Fixed("x0")]))
    stretches = {
        "rest": (1, 1, 1),
        "equal stretches": (1.1, 1.1, 1.1),
        "two equal stretches": (1.5, 0.8, 0.8),
        "nearly equal stretches": (1.5, 0.8, 0.8 + 4e-6),
    }[state]
    Q = problems.rotation((1, 2, 3), 0.7)
    move = Q @ np.diag(stretches) @ Q.T - np.eye(3) if state != "rest" else np.zeros((3, 3))
    p = np.random.default_rng(3).uniform(-1, 1, mesh.vertex_count)
    unknowns = np.concatenate([(mesh.points @ move.T).ravel() / system.length, p])
    free = np.flatnonzero(~system.prescribed)
    exact = difference(system, unknowns)[np.ix_(free, free)]
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    record_verification(
        claim=f"tangent against differences, {type(law).__name__}, {state}, κ = {kappa:g} Pa",
        source="V24",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6


def test_mirror_planes_keep_the_pressure_tangent_symmetric(record_verification):
    """A cavity cut by mirror planes has a symmetric tangent for the unknowns that are free, and the solver uses it."""
    mesh = meshes.sphere_octant(0.01, 0.015, 1, 1)
    model = problems.one_material(mesh, problems.YEOH, loads=[tg.Pressure("cavity", 4e4)])
    system = System(model)
    rng = np.random.default_rng(2)
    unknowns = 0.05 * rng.uniform(-1, 1, system.size)
    unknowns[system.prescribed] = 0
    free = np.flatnonzero(~system.prescribed)
    exact = difference(system, unknowns)[np.ix_(free, free)]
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    skew = float(np.abs(exact - exact.T).max() / np.abs(exact).max())
    record_verification(
        claim="cavity cut by mirror planes: tangent against differences, unsymmetric part of the differences",
        source="V24",
        expected=[0.0, 0.0],
        got=[error, skew],
        tolerance="1e-6",
    )
    assert system.skew_matrix(system.evaluate(unknowns, 1.0)) is None
    assert error < 1e-6
    assert skew < 1e-6
