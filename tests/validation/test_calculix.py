"""The same model solved by CalculiX and by this package, on the same mesh with the same cells.

CalculiX has displacements only, so the pure-displacement formulation is compared with it here, at a Poisson's ratio of
0.475 at rest; docs/calculix.md shows what that formulation loses where rubber is nearly incompressible.
Tolerance: 0.1 % of the tip displacement, what remains of CalculiX's own tolerance; 4 % with a membrane, see there.
"""

from dataclasses import replace

import numpy as np
import pytest
from calculix import displacements, needs_calculix, run_ccx
from turgor.loads import Force, Hanging, Moment, Shrinkage, Temperature
from turgor.supports import Hinge, ReferencePoint, Rotation, Shift

import turgor as tg
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.inp.write_inp import write_inp
from turgor.units import MPa, kPa, mm

POISSON = 0.475


def rubber(law):
    mu = law.shear_modulus
    return tg.Material(name="rubber", law=law, bulk_modulus=mu * 2 * (1 + POISSON) / (3 * (1 - 2 * POISSON)))


def finger(chambers=2):
    return FastPneuNet(chambers=chambers, length=10 * chambers * mm, wall=1.5 * mm)


def question(mesh, pressure, paper=False):
    materials = {
        "body": rubber(tg.Yeoh(C10=0.05 * MPa, C20=0.001 * MPa)),
        "base": rubber(tg.laws.NeoHooke(C10=0.2 * MPa)),
    }
    if paper:
        sheet = tg.Material(name="paper", law=tg.laws.Hooke(E=100 * MPa, nu=0.2))
        materials["strain_limiting_layer"] = tg.Membrane(sheet, thickness=0.1 * mm)
    return tg.Model(
        mesh,
        materials=materials,
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure)],
        formulation="displacement",
    )


def with_twenty_nodes(mesh):
    """The 20-node hexahedra inside 27-node ones."""
    used = np.unique(mesh.cells[:, :20])
    number = np.full(len(mesh.points), -1)
    number[used] = np.arange(len(used))
    faces = {name: number[sides[:, :8]] for name, sides in mesh.faces.items()}
    return replace(mesh, points=mesh.points[used], cells=number[mesh.cells[:, :20]], faces=faces)


def compare(model, folder, at=(1.0,)):
    """Mean displacement of the tip [m], by both."""
    tip = np.unique(model.mesh.faces["tip"])
    solution = tg.solve(model, tg.Static(at=at))
    file = folder / "finger.inp"
    write_inp(model, file, at=at)
    run_ccx(file)
    pairs = []
    for time, u in displacements(file, len(model.mesh.points)):
        (ours,) = [state for state in solution.states if abs(state.load_factor - time) < 1e-6]
        pairs.append((ours.displacement[tip].mean(axis=0), u[tip].mean(axis=0)))
    return pairs


@needs_calculix
def test_ten_node_tetrahedra(tmp_path):
    model = question(tg.mesh(finger().build(), size=4 * mm), 4 * kPa)
    pairs = compare(model, tmp_path, at=(0.5, 1.0))
    assert len(pairs) == 2
    for ours, theirs in pairs:
        assert np.linalg.norm(ours) > 0.5 * mm
        assert np.linalg.norm(ours - theirs) < 1e-3 * np.linalg.norm(theirs)


@pytest.mark.slow
@needs_calculix
def test_twenty_node_hexahedra_with_eight_points(tmp_path):
    mesh = with_twenty_nodes(tg.mesh(finger().build(), size=4 * mm, cells="hexahedra"))
    ((ours, theirs),) = compare(question(mesh, 4 * kPa), tmp_path)
    assert np.linalg.norm(ours) > 0.5 * mm
    assert np.linalg.norm(ours - theirs) < 1e-3 * np.linalg.norm(theirs)


@pytest.mark.slow
@needs_calculix
def test_membrane_on_a_layer(tmp_path):
    """CalculiX makes thin wedges of a membrane, which bends 2 % further than ours with its three points a triangle."""
    model = question(tg.mesh(finger().build(), size=4 * mm), 2 * kPa, paper=True)
    ((ours, theirs),) = compare(model, tmp_path)
    assert np.linalg.norm(ours - theirs) < 4e-2 * np.linalg.norm(theirs)


@pytest.mark.slow
@needs_calculix
def test_mixed_cells_do_not_agree_with_it(tmp_path):
    """What it would look like if the comparison above could not fail: the mixed cells bend 3 % further."""
    model = question(tg.mesh(finger().build(), size=4 * mm), 1 * kPa)
    mixed = tg.Model(model.mesh, model.materials, model.supports, model.loads)
    ((ours, theirs),) = compare(mixed, tmp_path)
    assert 0.01 < np.linalg.norm(ours - theirs) / np.linalg.norm(theirs) < 0.2


@needs_calculix
@pytest.mark.parametrize(
    ("supports", "loads"),
    [
        ((tg.Fixed("plate"), Rotation("plate", 0.3, (0, 1, 0))), ()),
        ((Rotation("plate"), tg.Displacement("plate", Shift((2 * mm, 0, 3 * mm)))), ()),
        ((tg.Fixed("plate", "yz"), Hinge("plate", "y")), (Moment("plate", (0, 5e-3, 0)),)),
        ((Rotation("plate"),), (Force("plate", (0.1, 0, -0.3)), Hanging("plate", 10e-3))),
    ],
    ids=["turned", "moved", "hinge", "forces"],
)
def test_a_plate_on_a_finger_agrees(tmp_path, supports, loads):
    """A rigid reference point without a pressure: the largest difference is 3e-4 of the largest displacement."""
    mesh = tg.mesh(finger(1).build(), size=4 * mm)
    plate = ReferencePoint("plate", "tip", spring=(20.0, 30.0, 0.0))
    model = question(mesh, 1 * kPa)
    model = replace(model, supports=[tg.Fixed("fixed"), plate, *supports], loads=list(loads))
    file = tmp_path / "plate.inp"
    write_inp(model, file)
    run_ccx(file)
    theirs = displacements(file, len(mesh.points))[-1][1]
    ours = tg.solve(model, tg.Static(tolerance=1e-8)).states[-1].displacement
    assert np.abs(ours).max() > 0.1 * mm
    error = np.nanmax(np.abs(theirs - ours)) / np.abs(ours).max()
    assert error < 1e-3


@needs_calculix
def test_a_body_that_shrinks_on_another_one(tmp_path):
    plain = question(tg.mesh(finger(1).build(), size=4 * mm), 2 * kPa)
    model = replace(plain, loads=(*plain.loads, Shrinkage("body", 0.01), Temperature("base", "60 °C", expansion=3e-4)))
    ((ours, theirs),) = compare(model, tmp_path)
    without = tg.solve(plain).states[-1].displacement[np.unique(plain.mesh.faces["tip"])].mean(axis=0)
    assert np.linalg.norm(ours - without) > 0.3 * np.linalg.norm(ours)
    assert np.linalg.norm(ours - theirs) < 3e-3 * np.linalg.norm(ours)
