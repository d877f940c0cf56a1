"""A job can start from a CAD file: mistakes are told with their key, and the lock file repeats the run."""

import re
import tomllib
from pathlib import Path

import cad_cases as cases
import numpy as np
import pytest

import turgor as tg
from refused import any_states, refused
from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.cad.selectors import ByName, InBox, NearestTo, WithNormal
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.model.supports import Fixed
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.text.problems import JobError
from turgor.units import kPa, mm

JOB = """
[actuator]
type = "cad_file"
file = "finger.step"

[actuator.faces]
fixed = { normal = "-x" }
tip = { near = ["38 mm", 0, "1.5 mm"] }

[actuator.split]
thickness = "2 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa" }
base = { law = "neo_hooke", C10 = "0.3 MPa" }

[loads]
pressure = "2 kPa"
"""


@pytest.fixture
def folder(tmp_path):
    cases.written(tmp_path, cases.finger_with_inlet(), "finger.step")
    return tmp_path


def read(folder, text=JOB):
    path = folder / "job.toml"
    path.write_text(text, encoding="utf-8")
    return tg.jobs.read_job(path)


def problems(folder, old, new):
    assert old in JOB
    with pytest.raises(JobError) as caught:
        read(folder, JOB.replace(old, new))
    return caught.value.problems


def test_the_actuator_is_the_file_with_its_selectors(folder, monkeypatch):
    job = read(folder)
    assert job.actuator == CadFile(
        file=(folder / "finger.step").resolve(),
        faces={"fixed": WithNormal("-x"), "tip": NearestTo((38 * mm, 0.0, 1.5 * mm))},
        split=SplitPlane(thickness=2 * mm),
    )
    monkeypatch.chdir("/")
    assert job.actuator.build().regions == ("body", "base")


def test_a_part_without_a_face_fixed_needs_no_empty_supports(folder):
    """Mirror planes, points or inertia may hold it; where nothing does, the check of the supports says so."""
    job = read(folder, JOB.replace('fixed = { normal = "-x" }\n', ""))
    assert job.supports == ()
    assert read(folder, JOB).supports == (Fixed("fixed"),)


def test_the_lock_file_gives_an_equal_job(folder, tmp_path_factory):
    more = JOB.replace(
        "[actuator.split]",
        'strain_limiting_layer = { box = [[0, "-10 mm", "1.9 mm"], ["38 mm", "10 mm", "2.1 mm"]] }\n'
        '[actuator.regions]\nbody = { near = [0, 0, 0] }\n[actuator.split]\ninterface = "between"\n',
    ).replace('file = "finger.step"', 'file = "finger.step"\nunit = "mm"')
    job = read(folder, more)
    lock = tmp_path_factory.mktemp("elsewhere") / "job.lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    again = tg.jobs.read_job(lock)
    assert again == job
    assert job.actuator.sha256 in lock.read_text(encoding="utf-8")
    assert isinstance(again.actuator.faces["strain_limiting_layer"], InBox)
    cases.written(folder, cases.finger(), "finger.step")
    with refused("actuator.sha256", job.actuator.sha256[:12] + "…", folder / "finger.step", error=JobError):
        tg.jobs.read_job(lock)


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('"finger.step"', '"finge.step"', [":4: actuator.file:", "finge.step", "'finger.step'"]),
        ('"cad_file"', '"cad_fil"', [":3: actuator.type:", "'cad_fil'", "'cad_file'"]),
        ("thickness", "thicknes", [":11: actuator.split.thicknes:", "'thicknes'", "'thickness'"]),
        ('"2 mm"', '"2"', [":11: actuator.split.thickness:", "'2'", "m, cm, mm"]),
        ("{ normal =", "{ norm =", [":7: actuator.faces.fixed.norm:", "'norm'", "'normal'"]),
        ('"-x" }', '"-x", color = "red" }', [":7: actuator.faces.fixed:", "name, color, near, box, normal"]),
        ('{ normal = "-x" }', '{ box = [[0, 0, 0]] }', [":7: actuator.faces.fixed:", "1 corners", "two"]),
        ('"-x" }', '"left" }', ["normal", "'left'", "'+x'"]),
        ('0, "1.5 mm"]', '0]', ["(0.038, 0.0)", "three"]),
        ('0, "1.5 mm"]', '1, "1.5 mm"]', [":8: actuator.faces.tip.near:", "1", "m, cm, mm"]),
        ('{ normal = "-x" }', '{ name = "clamp" }', ["'fixed'", "'clamp'", "no names"]),
        ('"2 mm"', '"20 mm"', ["thickness", "20 mm", "0 and 15 mm"]),
        ('base = {', 'bottom = {', ["materials.bottom:", "'bottom'"]),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_key(folder, old, new, facts):
    result = problems(folder, old, new)
    assert any_states(result, facts), "\n".join(result)


def test_the_job_solves_and_bends_towards_its_stiffer_bottom(folder):
    model, findings = prepare(read(folder))
    assert {finding.code for finding in findings} >= {"D01", "D02"}
    solution = tg.solve(model, tg.Static())
    response = tg.measure(solution, tg.bending_angle, tg.cavity_volume)
    assert response.column("pressure")[-1] == pytest.approx(2 * kPa)
    angle, volume = response.column("bending_angle"), response.column("cavity_volume")
    assert (np.diff(angle) > 0).all()
    assert np.rad2deg(angle[-1]) > 5
    assert volume[0] / mm**3 == pytest.approx(cases.FINGER.cavity_volume / mm**3 + 2 * np.pi * 1.44, rel=1e-4)
    assert (np.diff(volume) > 0).all()


def test_a_given_name_of_the_file_selects_a_face(tmp_path):
    cases.written(tmp_path, cases.FINGER.build().shape, "finger.step")
    text = JOB.replace('fixed = { normal = "-x" }', 'fixed = { name = "fixed" }').replace(
        '[actuator.split]\nthickness = "2 mm"', ""
    )
    assert read(tmp_path, text).actuator.faces["fixed"] == ByName("fixed")


def test_the_page_shows_the_example():
    root = Path(__file__).parents[3]
    page, example = (
        (root / name).read_text(encoding="utf-8") for name in ("docs/howto/cad.md", "examples/cad_file.toml")
    )
    blocks, (code, _) = (re.findall(rf"```{kind}\n(.*?)```", page, re.DOTALL) for kind in ("toml", "python"))
    shown, _, _, split, _, drawn, _, _ = blocks
    stated = tomllib.loads(example)
    assert tomllib.loads(shown)["actuator"] == stated["actuator"]
    assert set(tomllib.loads(split)["actuator"]["split"]) == {"thickness"}
    finger = tomllib.loads((root / "examples" / "drawn_finger.toml").read_text(encoding="utf-8"))["actuator"]
    assert {"symmetry": "automatic", **tomllib.loads(drawn)["actuator"]} == {"function": "build", **finger}
    job = tg.jobs.read_job(root / "examples" / "cad_file.toml")
    names: dict = {}
    exec(code.replace('"examples/', f'"{root.as_posix()}/examples/').replace("mesh = ", "made = lambda: "), names)
    part = names["part"]
    assert (part.faces, part.regions) == (job.actuator.build().faces, ("body", "base"))
