"""Fibers, the forms of a strain-limiting layer and radial supports in jobs: what they become, every mistake."""

import re
import tomllib
from dataclasses import replace
from math import inf, pi
from pathlib import Path

import pytest

from refused import any_states, refused
from turgor.core.inp.write_inp import write_inp
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Woven
from turgor.core.materials.library.records import from_library
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane, Shell
from turgor.core.model.supports import Fixed, PlaneSection, Radial
from turgor.job.export import export_job
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.text.problems import JobError
from turgor.units import deg, mm

TUBE = """\
[actuator]
type = "fiber_reinforced_cylinder"
length = "40 mm"

[mesh]
size = "4 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }

[fibers.braid]
face = "outside"
library = "kevlar-fiber"
angle_from_axis = "60 deg"
spacing = "2 mm"
hand = "both"

[loads]
pressure = "20 kPa"

[output]
measures = ["tip_displacement_x"]
"""


def read(tmp_path: Path, text: str) -> Job:
    file = tmp_path / "tube.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file)


def problems(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(JobError) as caught:
        read(tmp_path, text)
    return [line.replace(f"{tmp_path}/", "") for line in caught.value.problems]


def again(tmp_path: Path, job: Job) -> Job:
    """Write the lock file of a job and read it."""
    return read(tmp_path, lock_text(job, {"turgor": "0"}))


def test_a_winding_reaches_the_job(tmp_path):
    fibers = read(tmp_path, TUBE).fibers["braid"]
    assert fibers == Fibers(
        face="outside",
        material=from_library("kevlar-fiber"),
        diameter=0.1778 * mm,  # of the record
        winding=Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="both"),
        name="braid",
    )


def test_every_key_of_a_winding_comes_back_from_the_lock_file(tmp_path):
    braid = TUBE[TUBE.index("[fibers") : TUBE.index("[loads")]
    many = """\
[fibers.rods]
face = ["outside", "tip"]
E = "5 GPa"
diameter = "0.5 mm"
angle_from_circumference = "90 deg"
starts = 12
axis = "z"
form = "discrete"
compression = 0.5
bending = true
within = { x_from = "1 mm", z_to = 0 }

[fibers.screw]
face = "outside"
E = "5 GPa"
nu = 0.1
name = "wire"
density = "7.8 g/cm³"
expansion = "12 ppm/K"
source = { text = "our own tests", doubts = ["one specimen only"] }
diameter = "0.5 mm"
pitch = "7 mm"
starts = 2
hand = "left"

[fibers.turned]
face = "outside"
E = "5 GPa"
diameter = "0.5 mm"
turns = 3.5
spacing = "3 mm"

"""
    text = TUBE.replace(braid, many).replace('"40 mm"', '"40 mm"\nsymmetric = false')
    job = read(tmp_path, text)
    assert again(tmp_path, job) == job
    rods, screw, turned = (job.fibers[name] for name in ("rods", "screw", "turned"))
    assert (rods.faces, rods.form, rods.compression, rods.bending) == (("outside", "tip"), "discrete", 0.5, True)
    assert rods.within == ((1 * mm, -inf, -inf), (inf, inf, 0.0))
    assert (rods.winding.angle_from_circumference, rods.winding.starts) == (pytest.approx(pi / 2), 12)
    assert rods.winding.axis == (0.0, 0.0, 1.0)
    assert (screw.material.law, screw.material.name) == (Hooke(E=5e9, nu=0.1), "wire")
    assert screw.material.expansion == pytest.approx(12e-6)
    assert (screw.winding.pitch, screw.winding.hand) == (7 * mm, "left")
    assert (turned.winding.turns, turned.winding.spacing) == (3.5, 3 * mm)
    stated = tomllib.loads(lock_text(job, {}))["fibers"]["screw"]
    assert (stated["pitch"], stated["compression"], stated["form"]) == ("7 mm", 0.0, "smeared")


MISTAKES = [
    # (what stands in the file, what it is changed to, what the problem states)
    ("angle_from_axis", "angle",
     [":15: fibers.braid.angle:", "'60 deg'", "angle_from_axis", "angle_from_circumference"]),
    ("angle_from_axis", "angle_from_axes",
     [":15: fibers.braid.angle_from_axes:", "'angle_from_axes'", "'angle_from_axis'"]),
    ('"60 deg"', '"100 deg"', [":15: fibers.braid.angle_from_axis:", "100 deg", "0 deg to 90 deg"]),
    ('"60 deg"', '"60 mm"', [":15: fibers.braid.angle_from_axis:", "'60 mm'", "angle"]),
    ('"60 deg"', "60", [":15: fibers.braid.angle_from_axis:", "60", "'90 deg'"]),
    ('angle_from_axis = "60 deg"', "", [":12: fibers.braid:", "direction", "angle_from_axis", "turns, pitch"]),
    ('"60 deg"', '"60 deg"\nturns = 3.0', [":12: fibers.braid:", "angle_from_axis and turns"]),
    ('spacing = "2 mm"', "", [":12: fibers.braid:", "density", "spacing, starts"]),
    ('spacing = "2 mm"', 'spacing = "-2 mm"', [":16: fibers.braid.spacing:", "-2 mm", "positive"]),
    ('spacing = "2 mm"', "starts = 0", [":16: fibers.braid.starts:", "0", "positive"]),
    ('spacing = "2 mm"', "starts = 1.5", [":16: fibers.braid.starts:", "1.5", "whole number"]),
    ('angle_from_axis = "60 deg"', 'pitch = "0.1 mm"', [":15: fibers.braid.pitch:", "0.1 mm", "0.1778 mm"]),
    ('hand = "both"', 'hand = "bot"', [":12: fibers.braid:", "'bot'", "'both'"]),
    ('face = "outside"', 'face = ["tip", "tip"]', [":13: fibers.braid.face:", "('tip', 'tip')", "'tip'", "twice"]),
    ('hand = "both"', 'hand = "left"', [":17: fibers.braid.hand:", "symmetry_y", "actuator.symmetric", '"both"']),
    ('hand = "both"', 'axis = "w"', [":17: fibers.braid.axis:", "'w'", "x, y, z"]),
    ('hand = "both"', 'form = "smered"', [":12: fibers.braid:", "'smered'", "'smeared'"]),
    ('hand = "both"', 'compression = 2', [":17: fibers.braid.compression:", "2", "0 (slack) to 1"]),
    ('hand = "both"', 'diameter = "12 mm"', [":17: fibers.braid.diameter:", "12 mm", "more than 0 up to 10 mm"]),
    ('hand = "both"', 'within = { x_form = "1 mm" }', [":17: fibers.braid.within.x_form:", "'x_form'", "'x_from'"]),
    ('hand = "both"', 'within = { x_from = "3 mm", x_to = "1 mm" }',
     [":17: fibers.braid.within:", "((0.003, -inf, -inf), (0.001, inf, inf))", "two"]),
    ('face = "outside"', 'face = "outsid"', [":13: fibers.braid.face:", "'outsid'", "'outside'"]),
    ('face = "outside"', "face = []", [":13: fibers.braid.face:", "list", "empty"]),
    ('face = "outside"', "", [":12: fibers.braid.face:", "'face'", "missing"]),
    ('"kevlar-fiber"', '"kevlar-fibre"', [":14: fibers.braid.library:", "'kevlar-fibre'", "'kevlar-fiber'"]),
    ('"kevlar-fiber"', '"kevlar-fiber"\nrecord = "connolly"',
     [":15: fibers.braid.record:", "'connolly'", "'kevlar-fiber'", "hooke-connolly-2015"]),
    ('"kevlar-fiber"', '"fiber-yarn"', [":12: fibers.braid.diameter:", "'diameter'", "'fiber-yarn'", "missing"]),
    ('"kevlar-fiber"', '"kevlar-fiber"\nE = "1 GPa"', [":12: fibers.braid:", "both library and E"]),
    ('library = "kevlar-fiber"', "", [":12: fibers.braid:", "neither library nor E"]),
    ('library = "kevlar-fiber"', 'E = "-1 GPa"\ndiameter = "1 mm"', [":14: fibers.braid.E:", "-1e+09 Pa", "positive"]),
    ('"kevlar-fiber"', '"ecoflex-00-30"\nrecord = "yeoh-elsayed-2014"',
     [":12: fibers.braid.diameter:", "'diameter'", "'ecoflex-00-30'", "missing"]),
    ('"kevlar-fiber"', '"ecoflex-00-30"\nrecord = "yeoh-elsayed-2014"\ndiameter = "1 mm"',
     [":12: fibers.braid:", "'outside'", "'Ecoflex 00-30'", "Yeoh", "Hooke"]),
    ("[fibers.braid]", "[fibers]", [":13: fibers.face:", "[fibers.winding]"]),
    ("[fibers.braid]", "[fibres.braid]", [":12: fibres:", "'fibres'", "'fibers'"]),
    ("[loads]", '[supports]\nfixed = "xyz"\noutside = "radal"\n[loads]',
     [":21: supports.outside:", "'radal'", "'xyz'", "'radial'"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "facts"), MISTAKES, ids=[f"{new}"[:40] for _, new, _ in MISTAKES])
def test_each_mistake_is_one_clear_sentence(tmp_path, old, new, facts):
    assert old in TUBE
    result = problems(tmp_path, TUBE.replace(old, new))
    assert any_states(result, facts), "\n".join(result)
    assert all(line.endswith((".", "?")) and "\n" not in line for line in result)


def test_an_unknown_hand_is_told_once(tmp_path):
    (result,) = problems(tmp_path, TUBE.replace('hand = "both"', 'hand = "Both"'))
    assert any_states([result], ["'Both'", "'both'"])


def test_windings_that_do_not_fit_the_face_are_found_before_solving(tmp_path):
    with refused("'tip'", "axis (1.0, 0.0, 0.0)"):
        prepare(read(tmp_path, TUBE.replace('face = "outside"', 'face = "tip"')))
    with refused("'outside'", "0.1 mm", "0.1778 mm"):
        prepare(read(tmp_path, TUBE.replace('"2 mm"', '"0.1 mm"')))


def test_findings_about_fibers(tmp_path):
    def codes(text):
        return {finding.code: finding.message for finding in prepare(read(tmp_path, text))[1]}

    assert not {"B04", "B05"} & set(codes(TUBE))
    assert "keep 50 % of their stiffness" in codes(TUBE.replace("hand", "compression = 0.5\nhand"))["B04"]
    assert "are 7 mm apart, with cells of 3." in codes(TUBE.replace('"2 mm"', '"7 mm"'))["B05"]
    thick = TUBE.replace('"2 mm"', '"7 mm"').replace("hand", 'form = "discrete"\nhand')
    assert "B05" not in codes(thick)


@pytest.mark.parametrize(
    ("held", "support"),
    [("radial about z", Radial("tip", (0.0, 0.0, 1.0))), ("plane section", PlaneSection("tip"))],
)
def test_supports_reach_the_job_and_come_back(tmp_path, held, support):
    text = TUBE.replace("[loads]", f'[supports]\nfixed = "xyz"\noutside = "radial"\ntip = "{held}"\n[loads]')
    job = read(tmp_path, text)
    assert job.supports == (Fixed("fixed"), Radial("outside"), support)
    assert again(tmp_path, job) == job


# --- forms of the strain-limiting layer ---------------------------------------------------------------------------

BENDER = """\
[actuator]
type = "semicircular_bender"
length = "40 mm"

[mesh]
size = "4 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }
base = { law = "neo_hooke", C10 = "0.12 MPa" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "10 kPa"
"""
LAYER = re.search("(?m)^strain_limiting_layer.*\n", BENDER)[0]
COMBINED = 'strain_limiting_layer = { library = "fiberglass", form = "combined" }\n'
SOLID = 'strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", form = "solid" }\n'


def test_forms_of_the_layer(tmp_path):
    paper = from_library("paper", record="hooke-polygerinos-2020")
    sheets = {
        "": Shell(paper, 0.1 * mm),
        ', form = "shell"': Shell(paper, 0.1 * mm),
        ', form = "membrane"': Membrane(paper, 0.1 * mm),
        ", compression = 0": Membrane(paper, 0.1 * mm, compression=0.0),
        ', bending_stiffness = "10 µN m"': Shell(replace(paper, bending_stiffness=10 * 1e-6), 0.1 * mm),
    }
    for stated, sheet in sheets.items():
        job = read(tmp_path, BENDER.replace('"0.1 mm"', f'"0.1 mm"{stated}'))
        assert job.materials["strain_limiting_layer"] == sheet
        assert f'form = "{type(sheet).__name__.lower()}"' in lock_text(job, {})
        assert again(tmp_path, job) == job


def test_a_record_says_what_its_sheet_is(tmp_path):
    fabric = """\
    name = "Woven fabric"
    kind = "sheet"
    [records.own]
    law = "hooke"
    parameters = { E = "200 MPa", nu = 0.3 }
    convention = "elastic"
    source = "own tests"
    """
    sheets = {
        'bending_stiffness = "10 µN m"': (Shell, 10 * 1e-6),
        'form = "membrane"\nbending_stiffness = "10 µN m"': (Membrane, None),
    }
    for line, (kind, stiffness) in sheets.items():
        (tmp_path / "fabric.toml").write_text(fabric + line, encoding="utf-8")
        layer = 'strain_limiting_layer = { library = "fabric.toml", thickness = "0.3 mm" }\n'
        job = read(tmp_path, BENDER.replace(LAYER, layer))
        sheet = job.materials["strain_limiting_layer"]
        assert isinstance(sheet, kind) and sheet.material.bending_stiffness == stiffness
        assert again(tmp_path, job) == job


WOVEN = (
    'strain_limiting_layer = { law = "woven", E = "400 MPa", nu = 0.2, E_weft = "150 MPa", G = "12 MPa", '
    'warp = [1, 1, 0], thickness = "0.3 mm", bending_stiffness = "10 µN m" }\n'
)


def test_a_woven_sheet_has_warp_weft_and_shear(tmp_path):
    job = read(tmp_path, BENDER.replace(LAYER, WOVEN))
    sheet = job.materials["strain_limiting_layer"]
    assert sheet.material.law == Woven(E=400e6, nu=0.2, E_weft=150e6, G=12e6)
    assert (type(sheet), sheet.warp, sheet.bending_stiffness) == (Shell, (1.0, 1.0, 0.0), pytest.approx(1e-5))
    assert again(tmp_path, job) == job


def test_a_shell_that_wrinkles_bends_too(tmp_path):
    job = read(tmp_path, BENDER.replace('"0.1 mm"', '"0.1 mm", form = "shell", compression = 0'))
    sheet = job.materials["strain_limiting_layer"]
    assert (type(sheet), sheet.compression) == (Shell, 0.0)
    assert again(tmp_path, job) == job


def test_combined_constants_go_to_the_base(tmp_path):
    text = re.sub("(?m)^base.*\n", "", BENDER.replace(LAYER, COMBINED))
    job = read(tmp_path, text)
    assert job == read(tmp_path, text.replace(', form = "combined"', ""))  # its record says so
    assert set(job.materials) == {"body", "base"}
    assert job.materials["base"] == from_library("fiberglass")
    assert again(tmp_path, job) == job


def test_a_solid_layer_has_the_moduli_of_its_material(tmp_path):
    job = read(tmp_path, BENDER.replace(LAYER, SOLID).replace('"40 mm"', '"40 mm"\nlayer = "0.5 mm"'))
    layer = job.materials["strain_limiting_layer"]
    assert layer.law == NeoHooke(C10=6.5e9 / 2.4 / 2)
    assert layer.bulk_modulus == pytest.approx(6.5e9 / 3 / 0.6)
    assert again(tmp_path, job) == job


FORMS = [
    (BENDER.replace('"0.1 mm"', '"0.1 mm", form = "shel"'),
     [":12: materials.strain_limiting_layer.form:", "'shel'", "'shell'"]),
    (BENDER.replace(LAYER, COMBINED), [":11: materials.base:", "strain_limiting_layer"]),
    (BENDER.replace(LAYER, COMBINED.replace("fiberglass", "paper\", record = \"hooke-yang-2020")),
     [":12: materials.strain_limiting_layer:", "'Paper'", "rubber"]),
    (BENDER.replace(LAYER, COMBINED.replace("form", 'thickness = "1 mm", form')),
     [":12: materials.strain_limiting_layer.thickness:", 'form = "combined"']),
    (BENDER.replace(LAYER, SOLID),
     [":12: materials.strain_limiting_layer.form:", "'strain_limiting_layer'", "thickness", "actuator.layer"]),
    (BENDER.replace('C10 = "0.12 MPa" }', 'C10 = "0.12 MPa", form = "shell" }'),
     [":10: materials.body.form:", "'body'", '"shell"']),
    (BENDER.replace('C10 = "0.12 MPa" }', 'C10 = "0.12 MPa", compression = 0 }'),
     [":10: materials.body.compression:", "sheet on a face"]),
    (BENDER.replace('"0.1 mm"', '"0.1 mm", compression = 2'),
     [":12: materials.strain_limiting_layer.compression:", "2", "0 (it wrinkles)"]),
    (BENDER.replace('"0.1 mm"', '"0.1 mm", warp = [1, 0, 0]'),
     [":12: materials.strain_limiting_layer.warp:", "Woven", "same in all directions"]),
    (BENDER.replace('C10 = "0.12 MPa" }', 'C10 = "0.12 MPa", warp = [1, 0, 0] }'),
     [":10: materials.body.warp:", "woven sheet on a face"]),
    (BENDER.replace(LAYER, WOVEN.replace("warp = [1, 1, 0], ", "")),
     [":12: materials.strain_limiting_layer.warp:", "missing", "(1, 0, 0)"]),
    (BENDER.replace(LAYER, WOVEN.replace("0.2", "1.9")),
     [":12: materials.strain_limiting_layer.nu:", "1.9", "1.63"]),
    (BENDER.replace('"0.1 mm"', '"0.1 mm", form = "membrane", bending_stiffness = "10 µN m"'),
     [":12: materials.strain_limiting_layer.bending_stiffness:", "shell"]),
    (BENDER.replace('"0.1 mm"', '"0.1 mm", bending_stiffness = "0 µN m"'),
     [":12: materials.strain_limiting_layer.bending_stiffness:", "0 N m", "positive"]),
]  # fmt: skip


@pytest.mark.parametrize(("text", "facts"), FORMS, ids=range(len(FORMS)))
def test_mistakes_with_forms(tmp_path, text, facts):
    result = problems(tmp_path, text)
    assert any_states(result, facts), "\n".join(result)


def test_what_inp_files_cannot_say_is_refused(tmp_path):
    model = prepare(read(tmp_path, TUBE))[0]
    with refused("'cavity'", "inlet_diameter"):
        export_job(read(tmp_path, TUBE), tmp_path / "files", ["mold"])
    held = [Fixed("fixed"), Radial("outside")]
    plain = Model(model.mesh, model.materials, held, model.loads)
    write_inp(plain, tmp_path / "a.inp", program="abaqus")
    assert "*EQUATION" in (tmp_path / "a.inp").read_text(encoding="utf-8")
    sheet = Shell(from_library("kevlar-fiber"), 0.1 * mm)
    bent = Model(model.mesh, {**model.materials, "outside": sheet}, [Fixed("fixed")], model.loads)
    write_inp(bent, tmp_path / "a.inp", program="abaqus")
    assert "*SHELL SECTION, ELSET=shell_outside" in (tmp_path / "a.inp").read_text(encoding="utf-8")
