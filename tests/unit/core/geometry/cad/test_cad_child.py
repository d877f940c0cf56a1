"""Files that kill the CAD kernel or the mesh generator end a child process, and one sentence tells of it."""

import os
import pickle
import signal
import subprocess
import sys
import time

import cad_cases as cases
import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.cad.files import load_file
from turgor.core.geometry.cad.inspection import inspect_cad
from turgor.core.geometry.cad.read import read_cad
from turgor.core.geometry.child_process import Work, in_child
from turgor.core.geometry.silenced_output import captured_output
from turgor.units import mm

WORK = Work(who="the CAD kernel", doing="reading 'a.step'", advice="Export it again.", limit=60.0)


def damaged(folder):
    """A STEP file that ends the kernel with a segmentation fault: a bound of a face has lost its loop."""
    text = (cases.DATA / "cup_and_plate.step").read_text(encoding="ascii")
    whole = "#493 = FACE_BOUND('',#494,.F.);"
    assert whole in text
    path = folder / "damaged part.step"
    path.write_text(text.replace(whole, "#493 = FACE_BOUND(.F.);"), encoding="ascii")
    return path


def test_a_damaged_step_file_is_a_sentence_and_not_the_end_of_the_process(tmp_path, capfd):
    path = damaged(tmp_path)
    with captured_output(), refused(path, "died", "damaged", "STEP (AP214)", "BREP"):
        read_cad(path)
    with refused(path, "died"):
        inspect_cad(path)
    assert capfd.readouterr() == ("", "")


def test_a_script_without_a_main_guard_reads_files(tmp_path):
    cases.written(tmp_path, cases.tube())
    script = tmp_path / "script.py"
    script.write_text(
        "import turgor as tg\nprint('once')\npart = tg.cad.read_cad('part.step')\n"
        "print(len(tg.mesh(part, size=7e-3).regions))\n",
        encoding="utf-8",
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, script.name], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "once\n1\n", "")


def test_the_part_is_the_same_as_without_a_child(tmp_path):
    path = cases.written(tmp_path, cases.finger_with_inlet())
    part = read_cad(path)
    assert part.cavity_volume / mm**3 == pytest.approx(
        (cases.FINGER.cavity_volume / mm**3) + 2 * np.pi * 1.2**2, rel=1e-6
    )
    assert part.file == str(path)
    assert {face.name for face in part.shape.faces} == set(part.faces)
    assert [finding.code for finding in part.findings] == ["D02", "D05"]


@pytest.mark.skipif(sys.platform == "win32", reason="signals end processes otherwise there")
@pytest.mark.parametrize(
    ("task", "given", "fact"),
    [
        (os.abort, (), "(signal 6, SIGABRT)"),
        (signal.raise_signal, (signal.SIGSEGV,), "(signal 11, SIGSEGV)"),
        (os._exit, (134,), "(exit code 134)"),
        (sys.exit, ("no memory",), "(exit code 1: no memory)"),
    ],
)
def test_every_death_is_a_sentence(task, given, fact):
    with refused("a.step", fact):
        in_child(WORK, task, *given)


def test_what_hangs_is_stopped():
    started = time.perf_counter()
    with refused("a.step", "2 s"):
        in_child(Work(who=WORK.who, doing=WORK.doing, advice=WORK.advice, limit=2.0), time.sleep, 60)
    assert time.perf_counter() - started < 20


def test_errors_of_the_task_come_through():
    with refused("unit", "milli", "m, cm, mm"):
        in_child(WORK, load_file, cases.DATA / "cup_and_plate.step", "milli")


def test_a_geometry_can_be_pickled():
    geometry = FastPneuNet(chambers=2, length=20 * mm).build()
    again = pickle.loads(pickle.dumps(geometry))
    assert repr(again) == repr(geometry)
    assert again.bounds == geometry.bounds
    there, here = (tg.mesh(each, size=4 * mm, cells="tetrahedra") for each in (again, geometry))
    assert sorted(there.faces) == sorted(here.faces)
