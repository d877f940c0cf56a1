"""Section: what it is made from, what it refuses, and what its solution says."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.units import kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
THREAD = tg.Material(name="thread", law=tg.laws.Hooke(E=1e9, nu=0.3))
TUBE = tg.sections.Sketch(areas={"body": tg.sections.disc(8 * mm), "cavity": tg.sections.disc(6 * mm)})


def wound(**direction):
    winding = tg.Winding(spacing=2 * mm, **direction)
    return tg.Fibers(face="outside", material=THREAD, diameter=0.2 * mm, winding=winding)


def test_sketch_actuator_and_mesh_give_the_same_section():
    actuator = tg.actuators.ExtendingCylinder(inner_radius=6 * mm, wall=2 * mm, length=60 * mm, symmetric=False)
    mesh = tg.mesh(actuator.build(), size=2 * mm, cells="hexahedra")
    results = [tg.Section(each, {"body": RUBBER}).solve(10 * kPa).response for each in (TUBE, actuator, mesh)]
    for response in results[1:]:
        assert response["stretch"] == pytest.approx(results[0]["stretch"], rel=1e-5)
        assert response["cavity_ballooning"] == pytest.approx(results[0]["cavity_ballooning"], rel=1e-4)


@pytest.mark.parametrize(
    ("made", "facts"),
    [
        (lambda: tg.Section(tg.FastPneuNet(), {}), ["'fast PneuNet, 11 chambers, half'", "7.091 mm", "110 mm"]),
        (lambda: tg.Section(tg.actuators.BellowsOfRevolution(), {}), ["4 folds, quarter", "along x"]),
        (lambda: tg.Section(tg.actuators.ThreeExtenders(), {"body": RUBBER}), ["three extenders", "3 pieces"]),
        (lambda: tg.Section("tube", {}), ["'tube'", "Geometry", "Mesh", "Sketch"]),
        (lambda: tg.Section(TUBE, {"body": RUBBER}, ends="shut"), ["ends", "'shut'", "closed, open"]),
        (lambda: tg.Section(TUBE, {"bdy": RUBBER}), ["region", "'bdy'", "'body'"]),
        (
            lambda: tg.Section(TUBE, {"body": RUBBER}, reinforcements=[wound(turns=10)]),
            ["'outside'", "turns", 10, "pitch", "angle"],
        ),
        (lambda: tg.Section(TUBE, {"body": RUBBER}, supports=[tg.Fixed("outside")]), ["Fixed", "'outside'", "Radial"]),
        (lambda: tg.sections.Sketch(areas={"cavity": tg.sections.disc(1 * mm)}), ["sketch", "region", "cavity"]),
    ],
)
def test_what_has_no_section_is_refused_with_advice(made, facts):
    with refused(*facts):
        made()


@pytest.mark.parametrize(
    ("asked", "facts"),
    [
        ({"pressure": {"cavty": 1e3}}, ["'cavty'", "'cavity'"]),
        ({"prescribed": {"curvature": 1.0}}, ["'curvature'", "'curvature_z'"]),
        ({"forces": {"moment": 1.0}}, ["'moment'", "'moment_z'"]),
        ({"prescribed": {"twist": 1.0}, "forces": {"torque": 1.0}}, ["twist", "torque"]),
        ({"pressure": [1e3, 2e3], "prescribed": {"twist": [1.0, 2.0, 3.0]}}, ["pressure cavity", "2 values", 3]),
        ({"pressure": np.nan}, ["pressure cavity", "1 values", "finite"]),
    ],
)
def test_wrong_questions_are_answered_in_sentences(asked, facts):
    section = tg.Section(TUBE, {"body": RUBBER}, size=4 * mm)
    with refused(*facts):
        section.solve(**asked)


def test_mirror_planes_hold_what_they_must():
    half = tg.Section(tg.actuators.EccentricBender(), {"body": RUBBER}, size=4 * mm)
    with refused("twist", "mirror plane", "symmetric = false"):
        half.solve(prescribed={"twist": 1.0})


def test_path_beyond_the_limit_point_says_so_and_keeps_what_it_has():
    """A closed tube of neo-Hookean rubber has a limit point; this one bursts below 60 kPa."""
    section = tg.Section(TUBE, {"body": RUBBER}, size=3 * mm)
    with refused("51.72 kPa", "row 3", error=tg.sections.SectionError) as caught:
        section.solve([20 * kPa, 40 * kPa, 200 * kPa])
    reached = caught.value.solution
    assert reached.response["pressure"] == pytest.approx([20e3, 40e3])
    assert reached.response.status == "step_too_small"
    assert section.solve([20 * kPa, 40 * kPa, 200 * kPa], throw=False).response.message == str(caught.value)


def test_stiffness_is_the_derivative_of_the_forces():
    """At a bent, stretched and twisted state under pressure, against differences of solved states."""
    areas = {"body": tg.sections.disc(8 * mm), "cavity": tg.sections.disc(4 * mm, (1 * mm, 2 * mm))}
    section = tg.Section(tg.sections.Sketch(areas=areas), {"body": RUBBER}, size=3 * mm)
    names = ("stretch", "twist", "curvature_y", "curvature_z")
    forces = ("axial_force", "torque", "moment_y", "moment_z")
    at = dict(zip(names, (1.05, 8.0, 5.0, -3.0), strict=True))
    stiffness = section.solve(20 * kPa, prescribed=at).stiffness()
    result = section.solve(20 * kPa, prescribed=at).response
    assert [result[name][0] for name in forces] == pytest.approx(stiffness.forces, rel=1e-12)
    for i, (name, step) in enumerate(zip(names, (1e-4, 1e-2, 1e-2, 1e-2), strict=True)):
        two = [section.solve(20 * kPa, prescribed=at | {name: at[name] + sign * step}).response for sign in (1, -1)]
        slope = [(two[0][force][0] - two[1][force][0]) / (2 * step) for force in forces]
        assert slope == pytest.approx(stiffness.matrix[:, i], rel=1e-4, abs=1e-5 * np.abs(stiffness.matrix[:, i]).max())
    two = [section.solve(p, prescribed=at).response for p in (20.1 * kPa, 19.9 * kPa)]
    slope = [(two[0][force][0] - two[1][force][0]) / 200 for force in forces]
    assert slope == pytest.approx(stiffness.by_pressure[:, 0], rel=1e-4)
    assert pytest.approx(stiffness.matrix.T, rel=1e-9, abs=1e-12) == stiffness.matrix


def test_ends_open_leaves_out_the_thrust():
    held = {"stretch": 1.0}
    closed, opened = (tg.Section(TUBE, {"body": RUBBER}, ends=ends, size=2 * mm) for ends in ("closed", "open"))
    a, b = (each.solve(20 * kPa, prescribed=held).response for each in (closed, opened))
    area = a["cavity_volume_per_length"][0]
    assert b["axial_force"][0] - a["axial_force"][0] == pytest.approx(20e3 * area, rel=1e-9)
    assert closed.solve(20 * kPa).response["stretch"][0] > 1 > opened.solve(20 * kPa).response["stretch"][0]


def test_a_given_moment_is_met_by_the_curvature_that_it_holds():
    section = tg.Section(tg.sections.Sketch(areas={"body": tg.sections.disc(5 * mm)}), {"body": RUBBER}, size=3 * mm)
    held = section.solve(prescribed={"curvature_y": 20.0}).response
    free = section.solve(forces={"moment_y": held["moment_y"][0]}).response
    assert free["curvature_y"] == pytest.approx(held["curvature_y"], rel=1e-9)
    assert held["axial_force"] == pytest.approx(0.0, abs=1e-9)


def test_discrete_threads_are_smeared():
    smeared = wound(angle_from_circumference=0.0)
    a, b = (
        tg.Section(TUBE, {"body": RUBBER}, reinforcements=[each], size=3 * mm).solve(20 * kPa).response
        for each in (smeared, replace(smeared, form="discrete"))
    )
    assert a["stretch"] == pytest.approx(b["stretch"], rel=1e-12)
    assert a["stretch"][0] > 1.02


def test_what_a_section_and_its_solution_say():
    section = tg.Section(TUBE, {"body": RUBBER}, size=4 * mm)
    solution = section.solve([5 * kPa, 10 * kPa])
    assert repr(section).startswith("Section(")
    assert repr(solution).startswith("SectionSolution(2 states, converged, pressure, curvature, ")
    assert solution.stable == (True, True)
    assert solution.positions(None).shape == solution.positions().shape
    assert solution.outline().shape[1:] == (3, 3)
    assert np.linalg.norm(solution.outline()[..., 1:], axis=-1).max() == pytest.approx(
        8 * mm * solution.response["outside_ballooning"][-1], rel=1e-5
    )
    with refused("row", 2, "0 to 1"):
        solution.stiffness(2)


def test_cut_of_a_cad_part_is_the_section_of_its_family(tmp_path):
    """Through a STEP file: outlines, regions and names of faces come back from the cut."""
    actuator = tg.actuators.FiberReinforcedBender(length=60 * mm)
    geometry = actuator.build()
    parts = {"body": RUBBER, "skin": RUBBER, "strain_limiting_layer": tg.Membrane(THREAD, 0.01 * mm)}
    hoops = tg.Fibers(
        face="winding", material=THREAD, diameter=0.1 * mm, compression=1.0,
        winding=tg.Winding(angle_from_circumference=0.0, spacing=2 * mm),
    )  # fmt: skip
    cut = tg.sections.cut(geometry, at=20 * mm)
    assert cut.regions == ("skin", "body") or cut.regions == ("body", "skin")
    a, b = (tg.Section(each, parts, reinforcements=[hoops], size=2 * mm).solve(5 * kPa) for each in (actuator, cut))
    for name in ("curvature_y", "stretch", "cavity_volume_per_length"):
        assert a.response[name] == pytest.approx(b.response[name], rel=2e-2)
    with refused("x = 70 mm", "bender, half", "60 mm"):
        tg.sections.cut(geometry, at=70 * mm)


def test_cut_of_a_mesh_where_nothing_is_or_of_tetrahedra_is_refused():
    actuator = tg.actuators.ExtendingCylinder(length=40 * mm)
    mesh = tg.mesh(actuator.build(), size=4 * mm, cells="hexahedra")
    with refused("x = 90 mm", "'extending cylinder", "0 mm to 40 mm"):
        tg.sections.cut(mesh, at=90 * mm)
    with refused("size", "2 mm", "'extending cylinder"):
        tg.Section(mesh, {"body": RUBBER}, size=2 * mm)
    cells = tg.mesh(actuator.build(), size=6 * mm, cells="tetrahedra")
    with refused("ten-node tetrahedrons", "27-node hexahedra"):
        tg.sections.cut(cells)


def test_step_file_is_cut_in_its_middle(tmp_path):
    """A CAD file does not tell how its part was made: it is cut, and its faces keep their names."""
    actuator = tg.actuators.EccentricBender(length=60 * mm)
    tg.cad.write_step(actuator.build(), tmp_path / "finger.step")
    part = tg.cad.read_cad(tmp_path / "finger.step")
    (region,) = part.regions
    a, b = (
        tg.Section(shape, {name: RUBBER}, size=2 * mm).solve(20 * kPa).response
        for shape, name in ((actuator, "body"), (part, region))
    )
    assert b["curvature_y"] == pytest.approx(a["curvature_y"], rel=1e-2)
    assert b["cavity_ballooning"] == pytest.approx(a["cavity_ballooning"], rel=1e-4)


@pytest.mark.parametrize("ends", ["closed", "open"])
def test_a_volume_is_held_by_the_pressure_that_gives_it(ends):
    section = tg.Section(
        tg.actuators.OmnidirectionalActuator(symmetric=False), {"body": RUBBER}, ends=ends, size=4 * mm
    )
    given = {"cavity_1": [2 * kPa, 4 * kPa], "cavity_2": [1 * kPa, 1 * kPa]}
    by_pressure = section.solve(given, prescribed={"twist": 0.0})
    rest = section.volume_at_rest
    sizes = [_volumes(section, by_pressure, row)["cavity_1"] for row in (0, 1)]
    assert rest["cavity_1"] < sizes[0] < sizes[1]
    again = section.solve({"cavity_2": 1 * kPa}, volume={"cavity_1": sizes}, prescribed={"twist": 0.0}).response
    assert again["cavity_1_pressure"] == pytest.approx(given["cavity_1"], rel=1e-6)
    for name in ("curvature_y", "curvature_z", "stretch"):
        assert again[name] == pytest.approx(by_pressure.response[name], rel=1e-6)


def _volumes(section, solution, row):
    """Volumes of the cavities for each length, by Stokes' theorem around their outlines."""
    equations = section._equations
    sizes = equations.volumes(solution._point(row).unknowns) * equations.copies * equations.plane.length**2
    return dict(zip(section.cavities, sizes, strict=True))


@pytest.mark.parametrize(
    ("asked", "facts"),
    [
        ({"volume": {"cavty": 1e-4}}, ["'cavty'", "'cavity'"]),
        ({"pressure": 1e3, "volume": {"cavity": 1e-4}}, ["pressure", "volume", "cavity", "name"]),
        ({"pressure": {"cavity": 1e3}, "volume": {"cavity": 1e-4}}, ["cavity", "pressure", "volume", "both"]),
        (
            {"volume": {"cavity": [1e-4, 2e-4]}, "prescribed": {"stretch": [1.0, 1.1, 1.2]}},
            ["volume cavity", "2 values", 3],
        ),
    ],
)
def test_volumes_that_cannot_be_held_are_refused(asked, facts):
    section = tg.Section(tg.actuators.ExtendingCylinder(), {"body": RUBBER}, size=4 * mm)
    with refused(*facts):
        section.solve(**asked)
