"""Sheets on sections whose cells follow no grid: a paper layer under a half round."""

import numpy as np
import pytest

import turgor as tg
from turgor.cli import main
from turgor.core.results.files.response_csv import read_response
from turgor.units import MPa, kPa, mm

RADIUS, THICKNESS = 8 * mm, 0.4 * mm
RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6))
BODY = 6 * 0.1e6  # Young's modulus of the rubber
FILM = tg.laws.Hooke(E=50 * MPa, nu=0.4999)
WHOLE = tg.sections.Sketch(areas={"body": tg.sections.half_disc(RADIUS)}, lines={"sheet": ("z", 0.0)})


def backed(bending, size=2 * mm, shape=WHOLE):
    """A half disc of rubber on a film."""
    film = (tg.Shell if bending else tg.Membrane)(tg.Material(name="film", law=FILM), thickness=THICKNESS)
    return tg.Section(shape, {"body": RUBBER, "sheet": film}, size=size)


@pytest.mark.parametrize("bending", [False, True])
def test_integrals_over_a_sheet_are_exact(bending):
    """Stiffness of the film alone, all points fixed in the section: its area and its second moments."""
    equations = backed(bending)._equations
    own = np.zeros((4, 4))
    for sheet in equations.sheets:
        t = sheet.vectors.at(equations.rest.y, equations.rest.strains)
        P, A = sheet.response(t)
        B = sheet.vectors.derivatives(equations.rest.y, equations.rest.strains)
        own += sheet.vectors.hessian(B, P, A).sum(axis=0)[-4:, -4:]
    for bend in equations.bending:
        own += bend.derivatives(equations.rest.y, equations.rest.strains)[1].sum(axis=0)[-4:, -4:]
    plane = equations.plane
    moduli, width = FILM.E / (1 - FILM.nu**2) / equations.stress * THICKNESS / plane.length, 2 * RADIUS / plane.length
    below, plate = plane.origin[2] / plane.length, (THICKNESS / plane.length) ** 2 / 12 * bending
    assert own[0, 0] == pytest.approx(moduli * width, rel=1e-9)
    assert own[0, 2] == pytest.approx(-moduli * width * below, rel=1e-9)
    assert own[2, 2] == pytest.approx(moduli * width * (below**2 + plate), rel=1e-9)
    assert own[3, 3] == pytest.approx(moduli * width**3 / 12, rel=1e-9)


@pytest.mark.parametrize("bending", [False, True])
def test_a_backed_half_disc_bends_as_a_composite_beam(bending):
    """Exact for equal Poisson ratios: Saint-Venant's bending of both parts fits together."""
    area, film = np.pi * RADIUS**2 / 2, FILM.E * THICKNESS * 2 * RADIUS
    axial = BODY * area + film
    middle = BODY * 2 * RADIUS**3 / 3 / axial
    about_y = BODY * np.pi * RADIUS**4 / 8 + film * bending * THICKNESS**2 / 12 - axial * middle**2
    about_z = BODY * np.pi * RADIUS**4 / 8 + film * (2 * RADIUS) ** 2 / 12
    section = backed(bending)
    stiffness = section.solve(0.0).stiffness()
    along = stiffness.matrix[0, 0] - stiffness.matrix[0, 2] ** 2 / stiffness.matrix[2, 2]
    assert stiffness.bending == pytest.approx((about_y, about_z), rel=2e-3)
    assert 1 / along == pytest.approx(1 / axial + (middle - stiffness.point[2]) ** 2 / about_y, rel=2e-3)


PAPER = tg.from_library("paper", record="hooke-polygerinos-2020")
ELASTOSIL = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")

JOB = """
[actuator]
type = "semicircular_bender"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm", form = "shell" }

[loads]
pressure = "50 kPa"
"""


def test_a_half_round_on_paper_bends_as_the_whole_actuator(tmp_path, monkeypatch):
    """The middle of a long actuator of finite elements turns by 8.55° per 100 mm at 50 kPa; so does a rod of it.

    Small cells at the corners of the chamber make it 8.43°, at every size of the others.
    """
    paper = tg.Shell(PAPER, thickness=0.1 * mm)
    materials = {"body": ELASTOSIL, "base": ELASTOSIL, "strain_limiting_layer": paper}
    solution = tg.Section(tg.actuators.SemicircularBender(), materials).solve(np.array([0, 50]) * kPa, mesh_error=False)
    assert np.rad2deg(solution.response["curvature_y"][-1] * 0.1) == pytest.approx(8.5, rel=0.012)
    table = tg.sections.rod_section(solution).chambers[0].table
    assert np.rad2deg(table.strain_at(50 * kPa)[4] * 0.1) == pytest.approx(8.5, rel=0.012)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    assert main(["section", "finger.toml", "--rows", "1"]) == 0
    printed = read_response(tmp_path / "finger-section" / "section.csv")
    assert np.rad2deg(printed["curvature_y"][-1] * 0.1) == pytest.approx(8.5, rel=0.012)
