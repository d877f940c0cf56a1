"""Every key of a job is in its .inp file or named as left out; a job with another one is refused."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from refused import refused
from turgor.cli import main
from turgor.core.inp.account import InpNote
from turgor.core.meshing.settings import MeshSettings
from turgor.job.export import InpOptions, export_job
from turgor.job.output import exported_keys
from turgor.job.output.exported_keys import key_notes
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job

EXAMPLES = Path(__file__).parents[4] / "examples"

#: Examples that are written for Abaqus, and those that are refused with what has no form.
WRITTEN = ("axisymmetric_bellows", "deck_of_stages", "extender_life", "film", "grasp", "soft_arm", "two_balloons")
REFUSED = {
    "bond_peel": ("bond", "'seam'"),
    "hang_fill_press": ("stage 'fill'", "VolumeControl"),
    "one_line": ("Channel",),
    "textile_muscle": ("film",),
}


def coarse(name):
    job = read_job(EXAMPLES / f"{name}.toml")
    meshed = not hasattr(job.actuator, "file") and not hasattr(job.actuator, "bodies")
    return replace(job, mesh=MeshSettings(size=8e-3, cells=job.mesh.cells)) if meshed and name != "grasp" else job


@pytest.mark.parametrize("name", WRITTEN)
def test_every_key_of_an_example_is_accounted_for(tmp_path, name):
    job = coarse(name)
    done = export_job(job, tmp_path, ["inp"], inp=InpOptions(program="abaqus"))
    head = [line[3:] for line in done.files[0].read_text(encoding="ascii").splitlines() if line.startswith("** ")]
    assert {str(note).encode("ascii", "replace").decode() for note in done.notes} <= set(head)
    what = {note.what for note in done.notes}
    for table, content in tomllib.loads(lock_text(job, {})).items():
        if table in ("written_by", "engine") or not content:
            continue
        keys = [each["name"] for each in content] if isinstance(content, list) else content  # of stages
        by_name = table in ("materials", "fibers", "obstacles", "stages")
        assert (table in what and not by_name) or all(f"{table}.{key}" in what for key in keys), (table, what)


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_form_is_named(tmp_path, name):
    with refused(*REFUSED[name], ".inp"):
        export_job(coarse(name), tmp_path, ["inp"], inp=InpOptions(program="abaqus"))


def test_a_key_without_a_place_in_the_account_is_refused(monkeypatch):
    job = coarse("blocked_force")
    model = [InpNote(what, "written", "") for what in ("mesh", "materials.body", "materials.base", "procedure")]
    with refused("obstacles.plate"):  # the model has no note on it
        monkeypatch.setattr(exported_keys, "lock_text", lambda *_: "[obstacles.plate]\nshape = 'box'\n")
        key_notes(job, model)
    for new in ("[contact]\nwarmth = 1\n", "[weather]\nrain = 1\n", "[obstacles.plate]\nwarmth = 1\n"):
        table, key = new[1:].split("]")[0], new.split("\n")[1].split(" ")[0]
        monkeypatch.setattr(exported_keys, "lock_text", lambda *_, text=new: text)
        with refused(f"{table}.{key}"):
            key_notes(job, [*model, InpNote("obstacles.plate", "written", "")])


def test_the_command_says_what_differs(tmp_path, capsys):
    file = tmp_path / "block.toml"
    file.write_text((EXAMPLES / "stiff_film.toml").read_text(encoding="utf-8"), encoding="utf-8")
    options = ["export", str(file), "--inp", "--program", "abaqus", "--output", str(tmp_path / "out")]
    assert main(options) == 0
    said = capsys.readouterr().out
    assert said.index("left out") < said.index("approximated") < said.index("written: ")
    assert "materials.strain_limiting_layer: approximated: M3D6 with *NO COMPRESSION" in said
    assert main([*options, "--force", "--json"]) == 0
    notes = json.loads(capsys.readouterr().out)["result"]["notes"]
    assert "procedure: written: *STATIC" in notes
