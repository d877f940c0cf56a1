"""The .inp file of a model holds all of it: read back, it is the same mesh; what has no form is refused."""

import re

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.cells import cell_faces
from turgor.core.inp.materials import material_lines
from turgor.core.inp.write_inp import write_inp
from turgor.core.materials.laws.laws import ArrudaBoyce, GeneralizedRivlin, Gent, Ogden, YeohN
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.model.loads import BodyForce
from turgor.core.model.supports import Displacement, Shift
from turgor.units import kPa, mm

FINGER = tg.FastPneuNet(chambers=2, length=20 * mm)
RUBBER = tg.Material(name="soft, blue rubber", law=tg.Yeoh(C10=0.05e6, C20=1e3), bulk_modulus=2e6, density=1070.0)
PAPER = tg.Membrane(tg.Material(name="paper", law=tg.laws.Hooke(E=1e9, nu=0.2)), thickness=0.1 * mm)


def question(mesh, **changed):
    given = {
        "materials": {"body": RUBBER, "base": RUBBER, "strain_limiting_layer": PAPER},
        "supports": [tg.Fixed("fixed", "xz")],
        "loads": [tg.Pressure("cavity", 5 * kPa), tg.Gravity()],
    }
    return tg.Model(mesh, **(given | changed))


@pytest.fixture(scope="module", params=["tetrahedra", "hexahedra"])
def mesh(request):
    return tg.mesh(FINGER.build(), size=4 * mm, cells=request.param)


def section(text, keyword):
    """Data lines below the first keyword line that begins so."""
    lines = text.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(keyword)) + 1
    end = next((i for i in range(start, len(lines)) if lines[i].startswith("*")), len(lines))
    return lines[start:end]


def test_mesh_is_read_back(tmp_path, mesh):
    file = tmp_path / "finger.inp"
    write_inp(question(mesh), file)
    again = read_mesh(file)
    width = 10 if mesh.cells.shape[1] == 10 else 20
    assert again.cells.shape == mesh.cells.shape
    assert again.points[again.cells[:, :width]] == pytest.approx(mesh.points[mesh.cells[:, :width]], abs=1e-13)
    assert {n: r.tolist() for n, r in again.regions.items()} == {n: r.tolist() for n, r in mesh.regions.items()}
    assert set(again.faces) - set(mesh.faces) == {
        "membrane_strain_limiting_layer", "contact_outside", "wall_outside_1", "wall_outside_2",
    }  # fmt: skip
    for name, sides in mesh.faces.items():
        corners = [
            np.sort(m.points[s[:, :3]].sum(axis=1), axis=0) for m, s in ((mesh, sides), (again, again.faces[name]))
        ]
        assert corners[0] == pytest.approx(corners[1], abs=1e-12), name
    assert [finding for finding in again.findings if finding.code == "G22"] == []


def test_faces_of_cells_are_those_of_the_manual(mesh):
    corners = {4: {1: (1, 2, 3), 2: (1, 4, 2), 3: (2, 4, 3), 4: (3, 4, 1)}, 8: {1: (1, 2, 3, 4), 6: (4, 8, 5, 1)}}
    table = corners[mesh.cell_type.corners]
    result = cell_faces(mesh, "cavity")
    checked = 0
    for (cell, face), side in zip(result, mesh.faces["cavity"], strict=True):
        if face in table:
            assert set(mesh.cells[cell, np.array(table[face]) - 1]) == set(side[: len(table[face])])
            checked += 1
    assert checked


def test_numbers_are_in_mm_and_mpa(tmp_path, mesh):
    file = tmp_path / "finger.inp"
    write_inp(question(mesh), file, at=(0.25, 1.0))
    text = file.read_text()
    assert "units: mm, N, MPa, tonne" in text
    assert section(text, "*HYPERELASTIC, YEOH") == ["0.05, 0.001, 0, 1, 0, 0"]
    assert section(text, "*DENSITY") == ["1.07e-09"]
    assert section(text, "*DSLOAD") == ["cavity, P, 0.005"]
    assert section(text, "*DLOAD") == ["Eall, GRAV, 9806.65, 0, 0, -1"]
    assert section(text, "*BOUNDARY") == ["fixed, 1", "fixed, 3", "symmetry_y, 2"]
    assert section(text, "*MEMBRANE SECTION") == ["0.1"]
    assert len(re.findall(r"^\*STEP", text, re.MULTILINE)) == 2
    assert [float(line.split(", ")[1]) for line in re.findall(r"^\*STATIC\n(.*)", text, re.MULTILINE)] == [0.25, 0.75]
    assert max(len(line) for line in text.splitlines()) < 256
    assert max(line.count(",") for line in text.splitlines() if line[0].isdigit()) <= 16


def test_histories_become_amplitudes(tmp_path, mesh):
    pressure = tg.Pressure("cavity", 5 * kPa, history=[(0, 0), (0.5, 1), (1, 0.25)])
    file = tmp_path / "finger.inp"
    write_inp(question(mesh, loads=[pressure]), file)
    assert section(file.read_text(), "*AMPLITUDE, NAME=history_1") == ["0, 0", "0.5, 1", "1, 0.25"]
    first = tg.Gravity((0, 0, -1), history=[(0, 0), (0.2, 1), (1, 1)])
    swelling = tg.Pressure("cavity", 5 * kPa, history="s**2")
    write_inp(question(mesh, loads=[tg.Gravity(), swelling, first]), file)
    text = file.read_text()
    both = section(text, "*AMPLITUDE, NAME=history_1")  # what acts on the same adds up
    assert both == ["0, 0", "0.2, 0.6", "1, 1"]
    assert section(text, "*DLOAD, AMPLITUDE=history_1") == ["Eall, GRAV, 19613.3, 0, 0, -1"]
    assert section(text, "*AMPLITUDE, NAME=history_2")[100] == "0.5, 0.25"
    assert "*DSLOAD, AMPLITUDE=history_2" in text
    assert "ramp" not in text and "history_3" not in text


def test_cells_for_each_program(tmp_path, mesh):
    kinds = {}
    for program, reduced in (("calculix", True), ("calculix", False), ("abaqus", True)):
        file = tmp_path / "finger.inp"
        write_inp(question(mesh), file, program=program, reduced=reduced)
        kinds[program, reduced] = re.search(r"TYPE=(\w+), ELSET=body", file.read_text())[1]
    expected = ["C3D10", "C3D10", "C3D10H"] if mesh.cells.shape[1] == 10 else ["C3D20R", "C3D20", "C3D20RH"]
    assert list(kinds.values()) == expected


def _line(law):
    return material_lines("m", tg.Material(name="m", law=law, bulk_modulus=4e6), "calculix")[1:]


def test_laws_in_their_conventions():
    assert _line(tg.laws.MooneyRivlin(C10=1e5, C01=2e4)) == ["*HYPERELASTIC, MOONEY-RIVLIN", "0.1, 0.02, 0.5"]
    assert _line(Ogden(mu=(30200.0,), alpha=(5.0,))) == ["*HYPERELASTIC, OGDEN, N=1", "0.0755, 5, 0.5"]
    assert _line(YeohN(coefficients=(1e5, 1e3))) == ["*HYPERELASTIC, REDUCED POLYNOMIAL, N=2", "0.1, 0.001, 0.5, 0"]
    rivlin = GeneralizedRivlin.from_names({"C10": 1e5, "C11": 3e3})
    assert _line(rivlin) == ["*HYPERELASTIC, POLYNOMIAL, N=2", "0.1, 0, 0, 0.003, 0, 0.5, 0"]
    cubic = GeneralizedRivlin.from_names({"C10": 1e5, "C03": 1e3})
    assert _line(cubic)[1:] == ["0.1, 0, 0, 0, 0, 0, 0, 0", "0.001, 0.5, 0, 0"]
    assert _line(ArrudaBoyce(mu=8e4, locking_stretch=4.0)) == ["*HYPERELASTIC, ARRUDA-BOYCE", "0.08, 4, 0.5"]


def test_incompressible_only_for_abaqus():
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6))
    assert material_lines("body", rubber, "abaqus")[-1] == "0.05, 0"
    with refused("materials.body", "rubber", "CalculiX", "1.967 MPa"):
        material_lines("body", rubber, "calculix")


@pytest.mark.parametrize(
    ("changed", "facts"),
    [
        ({"loads": [BodyForce(lambda x: x)]}, ("BodyForce",)),
        ({"supports": [Displacement("fixed", lambda x, _: x)]}, ("displacement", "'fixed'", "a function")),
        (
            {
                "materials": {
                    "body": tg.Material(name="g", law=Gent(mu=1e5, Jm=50.0), bulk_modulus=2e6, density=1.0),
                    "base": RUBBER,
                }
            },
            ("materials.body", "Gent", "NeoHooke, MooneyRivlin, Yeoh"),
        ),
    ],
)
def test_what_has_no_form_is_refused(tmp_path, mesh, changed, facts):
    with refused(*facts):
        write_inp(question(mesh, **changed), tmp_path / "finger.inp")
    assert not (tmp_path / "finger.inp").exists()


def test_a_face_that_is_moved_by_lengths(tmp_path, mesh):
    moved = Displacement("fixed", Shift((1e-3, 0, 2e-3), [(0, 0), (0.5, 1), (1, 0)]))
    write_inp(question(mesh, supports=[moved]), tmp_path / "finger.inp")
    text = (tmp_path / "finger.inp").read_text()
    there_and_back = re.search(r"NAME=(\w+), TIME=TOTAL TIME\n0, 0\n0.5, 1\n1, 0\n", text)[1]
    assert section(text, f"*BOUNDARY, AMPLITUDE={there_and_back}") == ["fixed, 1, 1, 1", "fixed, 3, 3, 2"]
    assert section(text, "*BOUNDARY, AMPLITUDE=ramp") == ["fixed, 2, 2, 0"]


def test_wrong_settings(tmp_path, mesh):
    with refused("ansys", "abaqus, calculix"):
        write_inp(question(mesh), tmp_path / "a.inp", program="ansys")
    with refused("at is (0.5, 0.5)", "more than 0", "to 1"):
        write_inp(question(mesh), tmp_path / "a.inp", at=(0.5, 0.5))
