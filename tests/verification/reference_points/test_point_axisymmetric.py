"""Reference points and plane sections on an axisymmetric mesh move as on the quarter that it stands for.

Problem: a tube with ends under pressure, with a plate on its end: a weight hangs from it, a spring holds it, its mass
has a weight, or it is moved along the axis. The same mesh is solved with and without its rings.
Expected: the same, but for the two parabolas around the untied quarter, which leave 0.6 % of its displacement (see
`test_axisymmetric.py`). Tolerance: 1 %. A rigid end and a plane section stay plane to round-off, the reaction is the
force that the stretched tube needs: that of the work, dW/dL, within the truncation of central differences, 1e-5.
"""

from dataclasses import replace

import numpy as np
import pytest
from netgen.occ import Cylinder, Pnt, X
from turgor.cad import WithNormal, read_cad
from turgor.loads import Force, Gravity, Hanging
from turgor.supports import PlaneSection, ReferencePoint, Rotation, Shift

import problems
import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.units import MPa, kPa, mm

LAW = tg.laws.NeoHooke(C10=0.12 * MPa)
COUPLINGS = ("rigid", "averaging")


@pytest.fixture(scope="module")
def tube(tmp_path_factory):
    path = tmp_path_factory.mktemp("tube") / "tube.step"
    body = Cylinder(Pnt(0, 0, 0), X, r=8, h=20) - Cylinder(Pnt(3, 0, 0), X, r=6, h=14)
    body.WriteStep(str(path))
    ends = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
    return tg.mesh(read_cad(path, symmetry="yz", faces=ends), size=3 * mm, cells="axisymmetric")


def _solved(mesh, supports, loads):
    rubber = replace(problems.rubber(LAW), density=1000.0)
    model = tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed"), *supports], [tg.Pressure("cavity", 15 * kPa), *loads])
    return problems.solve(model, tg.Static(tolerance=1e-9)).states[-1]


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_a_plate_moves_as_on_the_quarter(tube, coupling, record_verification):
    plate = ReferencePoint("plate", "tip", coupling=coupling, mass=0.2, spring=50.0)
    loads = [Hanging("plate", 0.1, direction=(-1, 0, 0)), Force("plate", (4.0, 0, 0)), Gravity((1, 0, 0))]
    tied, free = (_solved(mesh, [plate], loads).points["plate"] for mesh in (tube, replace(tube, revolved="")))
    claim = f"plate on an axisymmetric tube, {coupling}: displacement [mm]"
    record_verification(claim, "quarter", free.displacement[0] / mm, tied.displacement[0] / mm, "1 %")
    assert free.displacement[0] > 0.5 * mm
    assert tied.displacement == pytest.approx(free.displacement, rel=1e-2, abs=1e-15)
    assert tied.rotation == pytest.approx(np.eye(3), abs=1e-12)
    assert tied.force == pytest.approx([-50.0 * tied.displacement[0], 0, 0], abs=1e-9)


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_a_moved_plate_needs_the_force_of_the_work(tube, coupling):
    moved = [
        _solved(tube, [ReferencePoint("plate", "tip", coupling=coupling), held, Rotation("plate")], [])
        for held in (tg.Displacement("plate", Shift((shift, 0, 0)), "x") for shift in (2.99 * mm, 3 * mm, 3.01 * mm))
    ]
    # at a given pressure the potential is the stored energy less pressure times volume
    potential = [
        4 * problems.energy(state) - 15 * kPa * cavity_volume(tube, "cavity", state.displacement) for state in moved
    ]
    force = (potential[2] - potential[0]) / (0.02 * mm)
    assert moved[1].points["plate"].displacement[0] == pytest.approx(3 * mm)
    assert moved[1].points["plate"].force[0] == pytest.approx(force, rel=1e-5)


def test_a_section_stays_plane(tube):
    nodes = tube.face_nodes("tip")
    section = _solved(tube, [PlaneSection("tip")], []).displacement[nodes]
    plate = _solved(tube, [ReferencePoint("plate", "tip")], []).displacement[nodes]
    bare = _solved(tube, [], []).displacement[nodes]
    assert np.ptp(bare[:, 0]) > 0.05 * mm
    for plane in (section, plate):
        assert plane[:, 0].mean() > 0.1 * mm
        assert np.ptp(plane[:, 0]) < 1e-12
    rim = np.hypot(*tube.points[nodes, 1:].T) > 7.9 * mm
    assert np.abs(section[rim, 1:]).max() > 1e-3 * mm  # within the section the points are free
    assert np.abs(plate[:, 1:]).max() < 1e-15
    free = _solved(replace(tube, revolved=""), [PlaneSection("tip")], []).displacement[nodes]
    assert section[:, 0] == pytest.approx(free[:, 0], rel=1e-2)


def test_a_plate_cannot_leave_the_axis(tube):
    plate = ReferencePoint("plate", "tip")
    with refused("'plate'", "1 mm", "along y", "mirror plane"):
        _solved(tube, [plate, tg.Displacement("plate", Shift((1e-3, 1e-3, 0)))], [])
    with refused("'plate'", "at", "1 mm", "along y"):
        _solved(tube, [replace(plate, at=(0.02, 0.001, 0))], [])
