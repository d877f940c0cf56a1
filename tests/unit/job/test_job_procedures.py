"""Blocked force and grasp in jobs: what they become, every mistake, and the way back."""

import re
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import any_states, refused
from turgor.core.setups.setup_values import BlockedForce, Grasp
from turgor.core.solvers.procedures.static import Static
from turgor.job.export import export_job
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.run import run_job
from turgor.job.text.problems import JobError
from turgor.units import deg, mm

GUIDE = Path(__file__).parents[3] / "docs" / "howto" / "blocked-force.md"

FINGER = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa", bulk_modulus = "10 MPa" }
base = { law = "neo_hooke", C10 = "0.12 MPa", bulk_modulus = "10 MPa" }

[loads]
pressure = "10 kPa"

[obstacles.bar]
shape = "cylinder"
center = ["8 mm", 0, "-7 mm"]
axis = "+y"
radius = "5 mm"
friction = 0.4

[output]
measures = ["bending_angle"]

[procedure]
"""

BLOCKED = f"""{FINGER}type = "blocked_force"
distance = "1.5 mm"
direction = "-z"
friction = 0.2
at = ["4 kPa"]
"""

GRASP = f"""{FINGER}type = "grasp"
object = "bar"
pull_distance = "8 mm"
closing = 0.6
at = [0.3]
"""


def read(tmp_path: Path, text: str) -> Job:
    file = tmp_path / "job.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file)


def problems(tmp_path: Path, text: str) -> tuple[str, ...]:
    with pytest.raises(JobError) as error:
        read(tmp_path, text)
    return error.value.problems


def test_blocked_force_is_read(tmp_path: Path) -> None:
    job = read(tmp_path, BLOCKED)
    assert job.setup == BlockedForce(distance=1.5 * mm, direction="-z", friction=0.2)
    assert job.procedure == Static(at=(0.4,))


def test_a_grasp_is_read(tmp_path: Path) -> None:
    job = read(tmp_path, GRASP)
    assert job.setup == Grasp(object="bar", pull_distance=8 * mm, closing=0.6)
    assert job.procedure == Static(at=(0.3,), max_step=0.1)


def test_a_tab_that_turns_is_read(tmp_path: Path) -> None:
    job = read(tmp_path, f'{FINGER}type = "blocked_force"\nhold = "zy"\nrotational_spring = "680 N mm/rad"\n')
    assert job.setup == BlockedForce(hold="yz", rotational_spring=0.68)
    assert read(tmp_path, lock_text(job, {})).setup == job.setup


@pytest.mark.parametrize(
    "text", [BLOCKED, BLOCKED.replace('distance = "1.5 mm"', "").replace("friction = 0.2", ""), GRASP]
)
def test_the_lock_file_repeats_them(tmp_path: Path, text: str) -> None:
    job = read(tmp_path, text)
    again = read(tmp_path, lock_text(job, {}))
    assert (again.setup, again.procedure) == (job.setup, job.procedure)
    assert again.setup is not None


@pytest.mark.parametrize(
    ("text", "old", "new", "facts"),
    [
        (BLOCKED, '"1.5 mm"', "1.5", [":28: procedure.distance:", "1.5", "'1.5 mm'"]),
        (BLOCKED, '"1.5 mm"', '"1.5 mm"\ntilt = "80 deg"', [":29: procedure.tilt:", "80 deg", "-60 to 60 deg"]),
        (
            BLOCKED,
            'direction = "-z"',
            'position = "-1 mm"',
            [":29: procedure.position:", "-1 mm", "distance is 1.5 mm"],
        ),
        (
            BLOCKED,
            'distance = "1.5 mm"\ndirection = "-z"',
            'position = "-1 mm"',
            [":28: procedure.position:", "-1 mm", "'free'", "'-z'"],
        ),
        (
            BLOCKED,
            "friction = 0.2",
            'rotational_spring = "1 N m/rad"',
            [":26: procedure:", "rotational_spring", "hold = 'yz'", "'plate'"],
        ),
        (BLOCKED, "distance", "distanc", [":28: procedure.distanc:", "'distanc'", "'distance'"]),
        (BLOCKED, '"-z"', '"down"', [":26: procedure:", "'down'", "-z, free"]),
        (BLOCKED, '"blocked_force"', '"blocked"', [":27: procedure.type:", "'blocked'", "'blocked_force'"]),
        (GRASP, 'pull_distance = "8 mm"\n', "", [":26: procedure.pull_distance:", "'pull_distance'", "missing"]),
        (GRASP, "closing = 0.6", "closing = 1.0", [":30: procedure.closing:", "1", "0 and 1"]),
        (GRASP, "[0.3]", '["4 kPa"]', [":31: procedure.at:", "grasp", "load factors"]),
    ],
)
def test_every_mistake_has_its_sentence(tmp_path: Path, text: str, old: str, new: str, facts: list[str]) -> None:
    assert text.count(old) == 1
    result = problems(tmp_path, text.replace(old, new))
    assert any_states(result, facts), "\n".join(result)


TUBE = """\
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "6 mm"
cells = "hexahedra"

[materials]
body = { name = "rubber", law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "10 kPa"

[output]
fields = false
pictures = false
report = false
mesh_error = false

[procedure]
type = "blocked_force"
distance = "0.02 mm"
"""


def test_the_lock_file_of_a_run_states_what_was_chosen(tmp_path: Path) -> None:
    job = read(tmp_path, TUBE)
    outcome = run_job(job, tmp_path / "run")
    assert outcome.job.setup == BlockedForce(direction="+x", position=20.02 * mm)
    lock = tmp_path / "run" / "job.lock.toml"
    assert 'direction = "+x"\n' in lock.read_text("utf-8")
    assert 'position = "20.02 mm"\n' in lock.read_text("utf-8")
    again = run_job(read_job(lock), tmp_path / "again")
    assert again.solution.model.contact == outcome.solution.model.contact
    for name in outcome.response.names:
        assert np.array_equal(again.response.column(name), outcome.response.column(name), equal_nan=True), name
    assert outcome.response.column("blocked_force")[-1] > 0
    assert tg.measures.bearing_distance(outcome.solution.states[-1]) == 0
    assert run_job(job, tmp_path / "run", resume=True).solution.converged
    with refused("procedure.position", "20.04 mm", "20.02 mm"):
        run_job(read(tmp_path, TUBE.replace("0.02 mm", "0.04 mm")), tmp_path / "run", resume=True)


def test_the_guide_says_what_is_so(tmp_path: Path) -> None:
    """Its jobs are read, and its tables list the keys that each procedure has beyond those of all."""
    text = GUIDE.read_text(encoding="utf-8")
    blocks = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    start = FINGER[: FINGER.index("[obstacles.bar]")]
    asked = [read(tmp_path, start + block).setup for block in blocks]
    tab = BlockedForce(hold="yz", rotational_spring=0.68)
    rig = BlockedForce(direction="-z", distance=-0.3 * mm, tilt=5 * deg, spring=200.0)
    assert asked == [BlockedForce(distance=1 * mm), rig, tab, Grasp(object="bar", pull_distance=3 * mm)]
    keys = [set(re.findall(r"(?m)^\| `(\w+)` \|", table)) for table in text.split("## How firmly")]
    assert keys[0] == {item.name for item in fields(BlockedForce)}
    assert keys[1] == {item.name for item in fields(Grasp)} | {"max_step"}


def test_what_the_mesh_decides_is_refused_before_the_solve(tmp_path: Path) -> None:
    with refused("'ba'", "'bar'"):
        prepare(read(tmp_path, GRASP.replace('object = "bar"', 'object = "ba"')))
    with refused("'tp'", "'tip'"):
        prepare(read(tmp_path, BLOCKED + 'face = "tp"\n'))


def test_their_measures_can_be_asked_for_by_name(tmp_path: Path) -> None:
    wanted = '["blocked_force", "plate_force", "bar_contact_area"]'
    prepare(read(tmp_path, BLOCKED.replace('["bending_angle"]', wanted)))
    prepare(read(tmp_path, GRASP.replace('["bending_angle"]', '["holding_force", "between_fingers_force"]')))
    with refused("'holding_force'", "setups.grasp"):
        prepare(read(tmp_path, BLOCKED.replace("bending_angle", "holding_force")))


def test_the_model_is_exported_with_what_stops_the_tip(tmp_path: Path) -> None:
    held = BLOCKED.replace('distance = "1.5 mm"\n', 'hold = "z"\n').replace("friction = 0.2\n", "")
    bar = held[held.index("[obstacles.bar]") : held.index("[output]")]
    (file,) = export_job(read(tmp_path, held.replace(bar, "")), tmp_path / "held", ["inp"]).files
    assert "\ntip, 3\n" in file.read_text(encoding="ascii")
    (file,) = export_job(read(tmp_path, BLOCKED.replace(bar, "")), tmp_path / "blocked", ["inp"]).files
    assert "*RIGID BODY, ELSET=rigid_plate" in file.read_text(encoding="ascii")


def test_static_jobs_are_what_they_were(tmp_path: Path) -> None:
    assert read(tmp_path, f'{FINGER}type = "static"\n').procedure == Static()
