"""Job files: what they become, everything wrong with them in one go, and the lock file that repeats them."""

import re
import runpy
import tomllib
from dataclasses import dataclass, field, fields
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomlkit
from hypothesis import given
from hypothesis import strategies as st

import turgor
import turgor.job.job
from refused import any_states, refused
from turgor.core.engine.warmup.needs import Needs
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Yeoh
from turgor.core.materials.library.records import from_library
from turgor.core.materials.material import Material
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.model.model import Model
from turgor.core.model.sheets import Shell
from turgor.core.model.supports import Fixed, Symmetry
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.source import Source
from turgor.job.job import Job
from turgor.job.kernel_needs import kernel_needs
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.text.lines import key_lines
from turgor.job.text.problems import JobError
from turgor.job.text.quantities import dataclass_table
from turgor.units import deg, kPa, mm

EXAMPLE = Path(__file__).parents[3] / "examples" / "fast_pneunet.toml"

SMALL = """\
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
gap = "1 mm"

[mesh]
size = "3 mm"

[materials]
body = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }

[loads]
pressure = "20 kPa"

[procedure]
type = "static"

[output]
measures = ["bending_angle"]
"""


def read(tmp_path: Path, text: str) -> Job:
    file = tmp_path / "small.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file)


def problems(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(JobError) as error:
        read(tmp_path, text)
    return [problem.removeprefix(str(tmp_path) + "/") for problem in error.value.problems]


def test_the_example_is_the_published_design() -> None:
    job = read_job(EXAMPLE)
    assert job.name == "fast_pneunet"
    assert job.actuator == FastPneuNet()
    assert job.materials["body"] == from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    assert job.materials["strain_limiting_layer"] == Shell(
        from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm
    )
    assert job.supports == (Fixed("fixed"),)
    assert job.procedure == Static()


def test_the_example_script_asks_the_same_question(monkeypatch: pytest.MonkeyPatch) -> None:
    """``fast_pneunet.py`` says in Python what ``fast_pneunet.toml`` says: compared where the solve would begin."""
    job, asked = read_job(EXAMPLE), {}

    def mesh_coarsely(geometry: Geometry, *, size: float) -> Mesh:
        asked["size"] = size
        return mesh(geometry, size=4 * mm)

    def stop_at_solve(model: Model, procedure: Static) -> None:
        asked.update(model=model, procedure=procedure)
        raise InterruptedError

    monkeypatch.setattr(turgor, "mesh", mesh_coarsely)
    monkeypatch.setattr(turgor, "solve", stop_at_solve)
    with pytest.raises(InterruptedError):
        runpy.run_path(str(EXAMPLE.with_suffix(".py")))
    assert asked["size"] == job.mesh_size
    assert asked["procedure"] == job.procedure
    assert asked["model"].materials == job.materials
    assert asked["model"].loads == job.loads
    assert asked["model"].supports == (*job.supports, Symmetry("symmetry_y"))
    assert asked["model"].mesh.name == job.actuator.build().name


def test_every_section_reaches_the_job(tmp_path: Path) -> None:
    text = SMALL.replace('pressure = "20 kPa"', 'pressure = "-20 kPa"\ngravity = "-x"')
    text = text.replace('type = "static"', 'type = "static"\nat = ["-5 kPa", 0.75]\nmax_step = 0.1\nmax_iterations = 9')
    text = text.replace('measures = ["bending_angle"]', 'measures = ["reaction", "bending_angle"]\npictures = false')
    text = 'name = "vacuum"\n' + text.replace("[loads]", '[supports]\nfixed = "xyz"\ntip = "z"\n\n[loads]')
    text = text.replace(', thickness = "0.1 mm"', ', thickness = "0.1 mm", density = "800 kg/m³"')
    job = read(tmp_path, text + "\n[engine]\nthreads = 3\n")
    assert job.name == "vacuum"
    assert job.actuator == FastPneuNet(chambers=2, length=20 * mm)
    assert job.loads == (Pressure("cavity", -20 * kPa), Gravity((-1.0, 0.0, 0.0)))
    assert job.supports == (Fixed("fixed", "xyz"), Fixed("tip", "z"))
    assert job.procedure == Static(at=(0.25, 0.75), max_step=0.1, max_iterations=9)
    assert job.output.measures == ("reaction", "bending_angle")
    assert not job.output.pictures
    assert job.output.report
    assert job.threads == 3
    assert job.materials["strain_limiting_layer"].material.density == 800


@pytest.mark.parametrize("name", ["neo_hooke", "neo-hooke", "Neo Hooke"])
def test_a_law_is_spelled_in_a_job_as_on_the_command_line(tmp_path: Path, name: str) -> None:
    text = re.sub("(?m)^body = .*", f'body = {{ law = "{name}", C10 = "120 kPa" }}', SMALL)
    job = read(tmp_path, text)
    assert job.materials["body"].law == NeoHooke(C10=120e3)
    assert 'law = "neo_hooke"' in lock_text(job, {"turgor": "0.0"})


def test_a_sheet_is_stated_by_youngs_modulus_and_poissons_ratio(tmp_path: Path) -> None:
    job = read(tmp_path, SMALL.replace('library = "paper", record = "hooke-polygerinos-2020"', HOOKE))
    sheet = job.materials["strain_limiting_layer"]
    assert isinstance(sheet, Shell) and sheet.material.law == Hooke(E=6.5e9, nu=0.2)


def test_a_pressure_acts_on_a_face_that_is_no_cavity(tmp_path: Path) -> None:
    job = read(tmp_path, SMALL.replace('"20 kPa"', '"20 kPa"\n[loads.tip]\npressure = "300 mbar"\nhistory = "s"'))
    assert [(load.face, load.pressure) for load in job.loads] == [("cavity", 20e3), ("tip", 30e3)]
    again = tmp_path / "again.toml"
    again.write_text(lock_text(job, {"turgor": "0.0"}), encoding="utf-8")
    assert read_job(again).loads == job.loads


def test_a_material_can_be_stated_by_its_law(tmp_path: Path) -> None:
    stated = '{ law = "neo_hooke", C10 = "120 kPa", bulk_modulus = "1 GPa", density = "1.1 g/cm³", name = "mine", \
stretch_range = [0.5, 3.0], source = { text = "our own tests", doubts = ["one specimen only"] } }'
    text = re.sub("(?m)^body = .*", f"body = {stated}", SMALL)
    text = re.sub("(?m)^base = .*", 'base = { law = "yeoh", C10 = "0.11 MPa", C20 = "0.02 MPa" }', text)
    job = read(tmp_path, text)
    assert job.materials["body"] == Material(
        name="mine",
        law=NeoHooke(C10=120 * kPa),
        bulk_modulus=1e9,
        density=1.1e3,
        stretch_range=(0.5, 3.0),
        source=Source(text="our own tests", doubts=("one specimen only",)),
    )
    base = job.materials["base"]
    assert isinstance(base, Material)
    assert (base.law, base.bulk_modulus, base.density) == (Yeoh(C10=0.11e6, C20=0.02e6), inf, None)
    assert "small.toml" in base.source.text


HOOKE = 'law = "hooke", E = "6.5 GPa", nu = 0.2'

CHANGES = [
    # (what stands in the file, what it is changed to, what the problem states)
    ('gap = "1 mm"', 'gab = "1 mm"', [":5: actuator.gab:", "'gab'", "'gap'"]),
    ('gap = "1 mm"', 'gap = "1 m m"', [":5: actuator.gap:", "'m m'", "'1 m m'", "'mm'"]),
    ('gap = "1 mm"', "gap = 1.5", [":5: actuator.gap:", "1.5", "'1.5 mm'"]),
    ('gap = "1 mm"', 'gap = "1.5"', [":5: actuator.gap:", "'1.5'", "'1.5 mm'"]),
    ('gap = "1 mm"', 'gap = "-1 mm"', [":5: actuator.gap:", "-1 mm", "0.01 mm to 19.94 mm"]),
    ('gap = "1 mm"', 'gap = "nan mm"', [":5: actuator.gap:", "'nan mm'", "'1.5 mm'"]),
    ('gap = "1 mm"', 'side_wall = "11 mm"', [":5: actuator.side_wall:", "11 mm", "0.01 mm to 9.995 mm"]),
    ("chambers = 2", "chambers = 2.5", [":3: actuator.chambers:", "2.5", "whole number"]),
    ("chambers = 2", "chambers = true", [":3: actuator.chambers:", "true", "whole number"]),
    ("chambers = 2", "chambers = 0", [":3: actuator.chambers:", "0", "1 to 100", "whole number"]),
    ("chambers = 2", 'symmetric = "no"', [":3: actuator.symmetric:", "'no'", "true", "false"]),
    ('"fast_pneunet"', '"fast_pneumat"', [":2: actuator.type:", "'fast_pneumat'", "'fast_pneunet'"]),
    ('type = "fast_pneunet"', "", [":1: actuator.type:", "'type'", "missing", "bidirectional_bender"]),
    ('size = "3 mm"', 'size = "0 mm"', [":8: mesh.size:", "0 mm", "0.291 mm to 20 mm"]),
    ('size = "3 mm"', 'size = "-3 mm"', [":8: mesh.size:", "-3 mm", "0.291 mm to 20 mm"]),
    ('size = "3 mm"', 'size = "99 mm"', [":8: mesh.size:", "99 mm", "0.291 mm to 20 mm"]),
    ('size = "3 mm"', 'wall_cells = 5', [":8: mesh.wall_cells:", "5", "1", "4"]),
    ('size = "3 mm"', 'cells = "hexa"', [":8: mesh.cells:", "'hexa'", "'hexahedra'"]),
    ('size = "3 mm"', 'cells = "hexahedra"\nface_sizes = { cavity = "4 mm" }',
     [":9: mesh.face_sizes:", "'cavity'", "4 mm", "0.067 mm to 2.5 mm"]),
    ('size = "3 mm"', 'wall_cells = 1.5', [":8: mesh.wall_cells:", "1.5", "whole number"]),
    ('size = "3 mm"', 'face_sizes = { cavty = "1 mm" }', [":8: mesh.face_sizes:", "'cavty'", "'cavity'"]),
    ('size = "3 mm"', 'face_sizes = { cavity = "3 mm" }',
     [":8: mesh.face_sizes:", "'cavity'", "3 mm", "0.067 mm to 2 mm"]),
    ('size = "3 mm"', 'face_sizes = "1 mm"', [":8: mesh.face_sizes:", "'1 mm'", "table"]),
    ('size = "3 mm"', 'face_sizes = { cavity = 2 }', [":8: mesh.face_sizes.cavity:", "2", "'1.5 mm'"]),
    ('size = "3 mm"', 'size = "3 mm"\ngrading = 7.0', [":9: mesh.grading:", "7.0", "0.1 to 1"]),
    ('body = { library = "elastosil-m4601"', 'body = { library = "elastosil"',
     [":11: materials.body.library:", "'elastosil'", "'elastosil-m4601'"]),
    ("hooke-polygerinos-2020", "hooke-2020",
     [":13: materials.strain_limiting_layer.record:", "'hooke-2020'", "'paper'", "'hooke-yang-2020'"]),
    (', record = "hooke-polygerinos-2020"', "",
     [":13: materials.strain_limiting_layer.record:", "'paper'", "3 records", "hooke-yang-2020"]),
    ("\nbase = {", "\nbas = {", [":12: materials.bas:", "'bas'", "'base'"]),
    ("\nbase = {", "\nbas = {", [":10: materials:", "base"]),
    (', thickness = "0.1 mm"', "",
     [":13: materials.strain_limiting_layer.thickness:", "'thickness'", "'strain_limiting_layer'", "missing"]),
    ('"0.1 mm"', '"20 mm"', [":13: materials.strain_limiting_layer.thickness:", "20 mm", "more than 0 up to 10 mm"]),
    ('"0.1 mm"', '"5 kPa"', [":13: materials.strain_limiting_layer.thickness:", "'5 kPa'", "length"]),
    ('"20 kPa"', '"20 kP"', [":16: loads.pressure:", "'kP'", "'20 kP'", "'kPa'"]),
    ('"20 kPa"', '"30 mm"', [":16: loads.pressure:", "'30 mm'", "pressure"]),
    ('pressure = "20 kPa"', "", [":15: loads:", "pressure", "gravity"]),
    ('"20 kPa"', '"20 kPa"\ngravity = "z"', [":17: loads.gravity:", "'z'", "'-z'"]),
    ('"20 kPa"', '"20 kPa"\ngravity = "-y"', [":17: loads.gravity:", "gravity", "normal to y", "actuator.symmetric"]),
    ("[loads]", '[supports]\nfixt = "xyz"\n[loads]', [":16: supports.fixt:", "'fixt'", "'fixed'"]),
    ("[loads]", '[supports]\ntip = "xw"\n[loads]', [":16: supports.tip:", "'xw'", "'xyz'", "'radial'"]),
    ('"static"', '"static"\nfirst_step = 2', [":20: procedure.first_step:", "2", "more than 0 up to 1"]),
    ('"static"', '"static"\nfirst_step = nan', [":20: procedure.first_step:", "nan", "finite"]),
    ('"static"', '"static"\nat = ["30 kPa"]', [":20: procedure.at:", "30 kPa", "0", "loads.pressure", "20 kPa"]),
    ('"static"', '"static"\nat = [0.0]', [":20: procedure.at:", "0", "(0, 1]"]),
    ('"static"', '"statik"', [":19: procedure.type:", "'statik'", "'static'"]),
    ('"bending_angle"', '"bending"', [":22: output.measures:", "'bending'", "'bending_angle'"]),
    ('["bending_angle"]', '"bending_angle"', [":22: output.measures:", "'bending_angle'", "list"]),
    ("[output]", "[outptu]", [":21: outptu:", "'outptu'", "'output'"]),
    ("[actuator]", 'name = "a/b"\n[actuator]', [":1: name:", "'a/b'", "letters", "'-'"]),
    ("[loads]\npressure", "pressure", [": loads:", "[loads]", "missing"]),
    ("[output]", "[engine]\nthreads = 0\n[output]", [":22: engine.threads:", "0", "1 or more"]),
    ("[mesh]\nsize", "mesh", [":7: actuator.mesh:", "'mesh'", "gap, side_wall"]),
    ('"static"', '"riks"', [":19: procedure.type:", "'riks'", "'arc_length'"]),
    ('"bending_angle"', '"angle"', [":22: output.measures:", "'angle'", "'bending_angle'"]),
    ('body = { library = "elastosil-m4601"', 'body = { library = "ecoflex"',
     [":11: materials.body.library:", "'ecoflex'", "'ecoflex-00-10'", "'ecoflex-00-30'", "'ecoflex-00-50'"]),
    ('library = "paper", record = "hooke-polygerinos-2020"', 'E = "6.5 GPa", nu = 0.2',
     [":13: materials.strain_limiting_layer:", "'law'", "missing", "E and nu", '"hooke"']),
    ('pressure = "20 kPa"', '[loads.tipp]\npressure = "1 kPa"', [":16: loads.tipp:", "'tipp'", "'tip'"]),
    ('pressure = "20 kPa"', 'tip = "1 kPa"', [":16: loads.tip:", "'1 kPa'", "[loads.tip]"]),
    ('size = "3 mm"', "size = 3 mm", [":8:", '"3 mm"']),
    ("[loads]", "[loads", [":15:", "TOML", "']'"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "facts"), CHANGES, ids=[f"{new}"[:40] for _, new, _ in CHANGES])
def test_each_mistake_is_one_clear_sentence(tmp_path: Path, old: str, new: str, facts: list[str]) -> None:
    assert old in SMALL
    result = problems(tmp_path, SMALL.replace(old, new))
    assert any_states(result, facts), "\n".join(result)
    assert all(line.endswith((".", "?")) and "\n" not in line for line in result)


JUNK = (7, -0.5, True, "junk", "", "1 mm", "1 kPa", [], ["junk"], [1, 2], {}, {"junk": 1})


def places(table: dict[str, Any], *above: str) -> list[tuple[str, ...]]:
    """Keys of all values and tables of a document."""
    below = [place for key, value in table.items() if isinstance(value, dict) for place in places(value, *above, key)]
    return [*((*above, key) for key in table), *below]


@pytest.mark.parametrize("place", places(tomllib.loads(SMALL)), ids=".".join)
def test_junk_anywhere_is_answered_with_a_sentence(tmp_path: Path, place: tuple[str, ...]) -> None:
    """Whatever stands at a key, it is either a valid job or a sentence that names the table; nothing else is raised."""
    for junk in JUNK:
        content = tomllib.loads(SMALL)
        table = content
        for key in place[:-1]:
            table = table[key]
        table[place[-1]] = junk
        result: tuple[str, ...] = ()
        try:
            read(tmp_path, tomlkit.dumps(content))
        except JobError as error:
            result = error.problems
        assert not result or any(f": {place[0]}" in problem for problem in result), result


def test_stated_materials_are_checked(tmp_path: Path) -> None:
    text = re.sub("(?m)^body = .*", 'body = { law = "yoeh", C10 = "0.1 MPa" }', SMALL)
    text = re.sub("(?m)^base = .*", 'base = { law = "yeoh", C10 = "-0.1 MPa", C20 = "0 MPa", C03 = "1 MPa" }', text)
    text += "\n[materials.tip]\nlaw = 'hooke'\nE = '1 GPa'\nnu = 0.6\nthickness = '1 mm'\n"
    result = problems(tmp_path, text)
    assert any_states(result[:1], ["small.toml:11: materials.body.law:", "'yoeh'", "'yeoh'"])
    assert any_states(result[1:2], ["small.toml:12: materials.base.C03:", "'C03'", "'C30'"])
    assert any_states(result[2:3], ["small.toml:27: materials.tip.nu:", "0.6", "-1 and 0.5"])
    text = text.replace('C03 = "1 MPa"', "stretch_range = [2, 1]").replace("yoeh", "yeoh")
    result = problems(tmp_path, text)
    assert any_states(result[:1], ["small.toml:11: materials.body.C20:", "'C20'", "missing"])
    assert any_states(
        result[1:2], ["small.toml:12: materials.base.stretch_range:", "[2.0, 1.0]", "[smallest, largest]"]
    )
    result = problems(tmp_path, text.replace("stretch_range = [2, 1]", 'bulk_modulus = "-1 MPa"'))
    assert any_states(result[1:2], ["small.toml:12: materials.base:", "Yeoh", "-200000 Pa"])


def test_a_linear_elastic_region_and_a_rubber_sheet_are_refused(tmp_path: Path) -> None:
    text = SMALL.replace(
        ', record = "yeoh-mosadegh-2014" }\nbase', ', record = "yeoh-mosadegh-2014", thickness = "1 mm" }\nbase'
    )
    facts = ["small.toml:11: materials.body.thickness:", "'body'", 'form = "solid"', "cavity"]
    assert any_states(problems(tmp_path, text)[:1], facts)
    text = re.sub("(?m)^body = .*", 'body = { law = "hooke", E = "1 GPa", nu = 0.3 }', SMALL)
    assert any_states(problems(tmp_path, text)[:1], ["small.toml:11: materials.body:", "'body'", "sheets"])
    text = SMALL.replace('library = "paper", record = "hooke-polygerinos-2020"', 'law = "neo_hooke", C10 = "1 MPa"')
    assert any_states(problems(tmp_path, text)[:1], ["shell", "Hooke"])


def test_the_settings_of_the_mesh_reach_the_job_and_come_back_from_the_lock_file(tmp_path: Path) -> None:
    job = read(tmp_path, SMALL.replace('size = "3 mm"', 'face_sizes = { cavity = "1.3 mm" }\nwall_cells = 2'))
    assert job.mesh_size == 2 * mm  # twice the wall
    assert job.mesh.face_sizes == {"cavity": 1.3 * mm}
    assert job.mesh.wall_cells == 2
    assert read(tmp_path, lock(job)) == job
    free = read(tmp_path, SMALL.replace('[mesh]\nsize = "3 mm"', ""))
    assert (free.mesh_size, free.mesh.cells) == (2.5 * mm, "hexahedra")
    swept = read(tmp_path, SMALL.replace('size = "3 mm"', 'cells = "hexahedra"'))
    assert (swept.mesh.cells, swept.mesh_size) == ("hexahedra", 2.5 * mm)  # an eighth of the length
    assert read(tmp_path, lock(swept)) == swept


def test_gravity_needs_a_density(tmp_path: Path) -> None:
    text = SMALL.replace('"20 kPa"', '"20 kPa"\ngravity = "-z"')
    assert read(tmp_path, text).loads[1] == Gravity((0.0, 0.0, -1.0))
    text = re.sub("(?m)^base = .*", 'base = { law = "neo_hooke", C10 = "0.12 MPa" }', text)
    (problem,) = problems(tmp_path, text)
    assert any_states([problem], ["small.toml:12: materials.base:", "density", "gravity", "'1100 kg/m³'"])


def test_all_problems_are_reported_together_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = SMALL.replace('gap = "1 mm"', 'gab = "1 mm"').replace('"20 kPa"', '"20 kP"').replace('"static"', '"statik"')
    places = [line.split(": ")[:2] for line in problems(tmp_path, text.replace("[mesh]\nsize", "[mash]\nsize"))]
    assert places == [
        ["small.toml:5", "actuator.gab"],
        ["small.toml:7", "mash"],
        ["small.toml:16", "loads.pressure"],
        ["small.toml:19", "procedure.type"],
    ]


def test_a_file_that_is_not_there_is_answered_with_the_near_match(tmp_path: Path) -> None:
    (tmp_path / "small.toml").write_text(SMALL)
    with refused(tmp_path / "smal.toml", "'small.toml'"):
        read_job(tmp_path / "smal.toml")
    with refused(tmp_path, tmp_path / "job.toml"):
        read_job(tmp_path)
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with refused(tmp_path / "binary.toml", "UTF-8"):
        read_job(tmp_path / "binary.toml")


def test_windows_line_ends_and_a_byte_order_mark_are_read(tmp_path: Path) -> None:
    (tmp_path / "small.toml").write_bytes(b"\xef\xbb\xbf" + SMALL.replace("\n", "\r\n").encode())
    assert read_job(tmp_path / "small.toml") == read(tmp_path, SMALL)


# --- lock file ---------------------------------------------------------------------------------------------------


def lock(job: Job) -> str:
    return lock_text(job, {"turgor": "0.0"})


def test_the_lock_file_gives_an_equal_job(tmp_path: Path) -> None:
    for text in (
        SMALL,
        'name = "x"\n' + SMALL.replace('"static"', '"static"\nat = ["3.3 kPa", "7 kPa", 0.777]'),
        SMALL.replace('"20 kPa"', '"14.7 psi"\ngravity = "-x"').replace("[mesh]", 'wall = "0.0393701 in"\n[mesh]'),
        re.sub("(?m)^body = .*", 'body = { law = "neo_hooke", C10 = "17 psi", bulk_modulus = "0.3 GPa" }', SMALL),
    ):
        job = read(tmp_path, text)
        (tmp_path / "job.lock.toml").write_text(lock(job), encoding="utf-8")
        again = read_job(tmp_path / "job.lock.toml")
        assert again == job
        assert lock(again) == lock(job)


def test_the_lock_file_states_every_default_with_its_unit(tmp_path: Path) -> None:
    content = tomllib.loads(lock(read(tmp_path, SMALL)))
    assert set(content["actuator"]) == {"type", *(item.name for item in fields(FastPneuNet))}
    assert content["actuator"]["wall"] == "1 mm"
    stated = {item.name for item in fields(Static) if item.default is not None}  # TOML has no word for nothing
    assert set(content["procedure"]) == {"type", *stated}
    assert content["mesh"] == {"size": "3 mm", "grading": 0.5, "face_sizes": {}, "wall_cells": 1, "cells": "tetrahedra"}
    assert content["materials"]["body"]["C10"] == "0.11 MPa"
    assert "Mosadegh" in content["materials"]["body"]["source"]["text"]
    assert content["materials"]["body"]["bulk_modulus"] == "incompressible"
    assert content["supports"] == {"fixed": "xyz"}
    written = {"fields": True, "pictures": True, "report": True, "mesh_error": True}
    assert content["output"] == {"measures": ["bending_angle"], **written}
    assert content["written_by"] == {"turgor": "0.0"}


def test_the_way_to_the_mesh_error_is_read_and_kept(tmp_path: Path) -> None:
    measures = 'measures = ["bending_angle"]'
    job = read(tmp_path, SMALL.replace(measures, f'{measures}\nmesh_error = "linear"'))
    assert job.output.mesh_error == "linear"
    assert tomllib.loads(lock(job))["output"]["mesh_error"] == "linear"
    with refused("small.toml:23", "output.mesh_error", "'adjoint'", "'linear'"):
        read(tmp_path, SMALL.replace(measures, f'{measures}\nmesh_error = "adjoint"'))


def test_requested_pressures_stay_pressures_in_the_lock_file(tmp_path: Path) -> None:
    job = read(tmp_path, SMALL.replace('"static"', '"static"\nat = ["3.3 kPa", "7 kPa"]'))
    assert tomllib.loads(lock(job))["procedure"]["at"] == ["3.3 kPa", "7 kPa"]


def test_a_new_family_needs_no_schema_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keys, units and defaults of [actuator] are the fields of the dataclass, angles and plain numbers included."""

    @dataclass(frozen=True, kw_only=True)
    class Tilted(FastPneuNet):
        tilt: float = field(default=45 * deg, metadata={"dimension": "angle"})
        ratio: float = field(default=0.5, metadata={"dimension": "number"})

    monkeypatch.setattr(turgor.job.job, "ACTUATORS", {"tilted": Tilted})
    monkeypatch.setattr("turgor.job.tables.bodies.body_tables.ACTUATORS", {"tilted": Tilted})
    job = read(tmp_path, SMALL.replace('"fast_pneunet"', '"tilted"\ntilt = "30 deg"\nratio = 0.25'))
    assert (job.actuator.tilt, job.actuator.ratio) == (30 * deg, 0.25)
    assert set(dataclass_table(Tilted).model_fields) == {"type", *(item.name for item in fields(Tilted))}
    content = tomllib.loads(lock(job))["actuator"]
    assert (content["type"], content["tilt"], content["ratio"]) == ("tilted", "30 deg", 0.25)
    result = problems(tmp_path, SMALL.replace('"fast_pneunet"', '"tilted"\ntilt = "30 mm"\nratio = "1 mm"'))
    assert any_states(result[:1], ["'30 mm'", "an angle"])
    assert any_states(result[1:2], ["'1 mm'", "a number"])


# --- line numbers ------------------------------------------------------------------------------------------------


def test_lines_of_every_way_to_write_a_key() -> None:
    text = '''\
# [comment]
title = """several # lines
[not.a.table]
"""
'quoted key' = "#]"

[ a . b ]  # spaces
c.d = [ "]", # comment ]
  { e = 1 },
]
f = { g = { h = 1.5e3 }, i = 1979-05-27T07:32:00 }
[[t]]
j = 1
'''
    assert {".".join(key): line for key, line in key_lines(text).items()} == {
        "title": 2, "quoted key": 5, "a": 7, "a.b": 7, "a.b.c": 8, "a.b.c.d": 8, "a.b.c.d.1": 9, "a.b.c.d.1.e": 9,
        "a.b.f": 11,
        "a.b.f.g": 11, "a.b.f.g.h": 11, "a.b.f.i": 11, "t": 12, "t.1": 12, "t.1.j": 13,
    }  # fmt: skip


@given(text=st.text(alphabet="ab=.[]{}\"',#\n 1", max_size=60))
def test_lines_are_found_or_not_but_never_hang(text: str) -> None:
    """Any text ends; for valid TOML every key that tomllib finds at the top has a line."""
    lines = key_lines(text)
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return
    assert {key for key in content if key} <= {path[0] for path in lines}


def test_hooke_has_no_bulk_modulus(tmp_path: Path) -> None:
    """A sheet is described by E and nu alone: a bulk modulus beside them could contradict them."""
    text = SMALL.replace('library = "paper", record = "hooke-polygerinos-2020"',
                         'law = "hooke", E = "1 GPa", nu = 0.2, bulk_modulus = "1 GPa"')  # fmt: skip
    assert any_states(problems(tmp_path, text)[:1], ["'bulk_modulus'", "E, nu"])
    job = read(tmp_path, text.replace(', bulk_modulus = "1 GPa"', ""))
    assert job.materials["strain_limiting_layer"].material.law == Hooke(E=1e9, nu=0.2)


def test_jobs_of_one_actuator_and_equal_settings_share_a_mesh(tmp_path: Path) -> None:
    first, other, finer = (
        prepare(read(tmp_path, text))[0].mesh
        for text in (SMALL, SMALL.replace("20 kPa", "10 kPa"), SMALL.replace('"3 mm"', '"2.5 mm"'))
    )
    assert other is first
    assert len(finer.cells) > len(first.cells)
    longer = prepare(read(tmp_path, SMALL.replace('"20 mm"', '"21 mm"')))[0].mesh
    assert np.ptp(longer.points[:, 0]) > np.ptp(first.points[:, 0])


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", ""),
        ('size = "3 mm"', 'size = "5 mm"\ncells = "hexahedra"'),  # rows of finer cells have 20 nodes
        ("[loads]", "[contact]\nself_contact = false\n\n[loads]"),
        (
            'base = { library = "elastosil-m4601", record = "yeoh-mosadegh-2014" }',
            'base = { law = "ogden", mu = ["0.1 MPa"], alpha = [2.0] }',
        ),
    ],
)
def test_what_is_compiled_ahead_is_what_the_model_needs(before: str, after: str, tmp_path: Path) -> None:
    job = read(tmp_path, SMALL.replace(before, after))
    assert kernel_needs(job) == Needs.of(prepare(job)[0])
