"""Stages in jobs: what they become, every mistake with its line, the lock file, and what a run writes about them."""

import csv
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import results_cases as cases

from refused import any_states, refused
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.model.history import over_time
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.model.supports import Displacement, Fixed, Shift
from turgor.core.results.drive import stage_column
from turgor.core.results.files.response_csv import read_response
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.sealed import Sealed
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.core.solvers.progress.progress import Course, describe
from turgor.core.solvers.solution import Iteration
from turgor.core.solvers.solve import solve
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.job.export import InpOptions, export_job
from turgor.job.job import Job, Output
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.run import run_job
from turgor.job.tables.stages import StageTable
from turgor.job.text.lines import key_lines
from turgor.job.text.problems import JobError
from turgor.units import kPa, mL, mm
from turgor.views.pictures.state_picture import picture_title
from turgor.views.plots.response_plots import response_figure

GUIDE = Path(__file__).parents[3] / "docs" / "howto" / "stages.md"

BAR = """\
[obstacles.bar]
shape = "cylinder"
center = ["8 mm", 0, "-5.02 mm"]
axis = "+y"
radius = "5 mm"
friction = 0.4
"""

HEAD = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "neo_hooke", C10 = "50 kPa", density = "1000 kg/m³" }
base = { law = "neo_hooke", C10 = "50 kPa", density = "1000 kg/m³" }

[supports]
fixed = "xyz"
tip = "x"

[obstacles.plate]
shape = "plane"
point = [0, 0, "-3 mm"]
normal = "+z"

[output]
measures = ["cavity_volume", "plate_force"]
pictures = false
"""

STAGED = """
[[stages]]
name = "hang"
loads = { gravity = "-z" }

[[stages]]
name = "fill"
procedure = { type = "volume_control", volume = "0.1 mL", at = [0.5] }

[[stages]]
name = "press"
moves = { plate = [0, 0, "2.9 mm"] }
displacements = { tip = ["-0.2 mm", 0, 0] }

[stages.procedure]
type = "sealed"
cavities = "cavity"
max_step = 0.5

[[stages]]
name = "let go"
loads.pressure = "0 kPa"
loads.gravity = { direction = "-z", acceleration = "0 m/s²" }
"""

SWING = """
[[stages]]
name = "inflate"
loads.cavity = { pressure = "2 kPa", history = [[0, 0], [0.5, 1], [1, 0.5]] }

[[stages]]
name = "swing"
procedure = { type = "dynamic", duration = "10 ms" }
loads.cavity = { pressure = "1 kPa", history_over_time = "sin(2*pi*t/0.01)" }
"""


def read(tmp_path: Path, text: str) -> Job:
    file = tmp_path / "job.toml"
    file.write_text(text, encoding="utf-8")
    return read_job(file)


def problems(tmp_path: Path, text: str) -> tuple[str, ...]:
    with pytest.raises(JobError) as error:
        read(tmp_path, text)
    return error.value.problems


def test_stages_are_read(tmp_path: Path) -> None:
    job = read(tmp_path, HEAD + STAGED)
    assert job.loads == ()
    assert job.supports == (Fixed("fixed", "xyz"), Fixed("tip", "x"))
    assert job.procedure == Stages(
        [
            Stage("hang", loads=[Gravity((0.0, 0.0, -1.0))]),
            Stage("fill", VolumeControl(volume=0.1 * mL, at=(0.5,))),
            Stage(
                "press",
                Sealed(cavities="cavity", max_step=0.5),
                displacements=[Displacement("tip", Shift((-0.2 * mm, 0.0, 0.0)), "x")],
                moves={"plate": (0.0, 0.0, 2.9 * mm)},
            ),
            Stage("let go", loads=[Pressure("cavity", 0.0), Gravity((0.0, 0.0, -1.0), 0.0)]),
        ]
    )


@pytest.mark.parametrize("stages", [STAGED, SWING])
def test_the_lock_file_repeats_them(tmp_path: Path, stages: str) -> None:
    job = read(tmp_path, HEAD + stages)
    text = lock_text(job, {})
    assert "[[stages]]" in text
    assert "[procedure]" not in text
    assert read(tmp_path, text).procedure == job.procedure


def test_histories_go_over_the_time_of_their_stage(tmp_path: Path) -> None:
    inflate, swing = read(tmp_path, HEAD + SWING).procedure.stages
    assert inflate.loads[0].history == ((0.0, 0.0), (0.5, 1.0), (1.0, 0.5))
    assert swing.procedure == Dynamic(duration=0.01)
    assert swing.loads[0].history == over_time("sin(2*pi*t/0.01)", 0.01)
    weight = '[loads.gravity]\ndirection = "-z"\nhistory_over_time = [[0, 0], [1, 1]]\n'
    timed = SWING.replace('name = "inflate"', 'name = "inflate"\nprocedure = { type = "static", duration = "1 s" }')
    job = read(tmp_path, HEAD + weight + timed)
    assert job.loads == (Gravity((0.0, 0.0, -1.0)),)  # which acts in the first stage, over its time


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('name = "fill"', "", [":30: stages.2.name:", "'name'", "missing"]),
        ('name = "fill"', 'name = "hang"', [":31: stages.2.name:", "'hang'"]),
        ('name = "fill"', "name = 3", [":31: stages.2.name:", "3", "text"]),
        ('name = "fill"', 'name = " "', [":30: stages.2:", "'fill'"]),
        ('"0.1 mL"', '"0.1 mm"', [":32: stages.fill.procedure.volume:", "'0.1 mm'", "volume"]),
        ("volume_control", "volume_contro",
         [":32: stages.fill.procedure.type:", "'volume_contro'", "'volume_control'"]),
        ("[0.5]", '["2 kPa"]', [":32: stages.fill.procedure.at:", "stage", "load factors"]),
        ("moves =", "move =", [":36: stages.press.move:", "'move'", "'moves'"]),
        ("plate = [0, 0,", "plat = [0, 0,", [":36: stages.press.moves.plat:", "'plat'", "'plate'"]),
        ('"2.9 mm"', "2.9", [":36: stages.press.moves.plate:", "2.9", "'1.5 mm'"]),
        ("tip = [", "tp = [", [":37: stages.press.displacements.tp:", "'tp'", "'tip'"]),
        ("tip = [", "outside = [",
         [":37: stages.press.displacements.outside:", "'outside'", "[supports]", "fixed, tip"]),
        ('"-0.2 mm", 0, 0', '0, 0, "1 mm"', [":37: stages.press.displacements.tip:", "along z", "'tip'", "in x"]),
        ('"sealed"', '"auto"', [":41: stages.press.procedure.cavities:", "'cavities'", "past, max_stretch"]),
        ('cavities = "cavity"', "cavities = 1", [":41: stages.press.procedure.cavities:", "1", "name", "list"]),
        ("max_step = 0.5", "max_step = 5.0", [":42: stages.press.procedure.max_step:", "5", "more than 0 up to 1"]),
        ("max_step = 0.5", 'volume = "1 mL"',
         [":42: stages.press.procedure.volume:", "'volume'", "duration, cavities"]),
        ('"0 kPa"', '"0 mm"', [":46: stages.let go.loads.pressure:", "'0 mm'", "pressure"]),
        ('"0 m/s²"', "0", [":47: stages.let go.loads.gravity.acceleration:", "0", "'9.81 m/s²'"]),
        ('"-z" }\n', '"up" }\n', [":28: stages.hang.loads.gravity:", "'up'", "+x, +y"]),
        ("[[stages]]\nname = \"hang\"", "[procedure]\ntype = 'static'\n[[stages]]\nname = \"hang\"",
         [":26: procedure:", "stage"]),
        ('type = "sealed"\ncavities = "cavity"', 'type = "blocked_force"',
         [":39: stages.press.procedure:", "'press'", "blocked_force"]),
        ('type = "sealed"\ncavities = "cavity"', 'type = "grasp"\npull_distance = "1 mm"',
         [":39: stages.press.procedure:", "'press'", "grasp"]),
    ],
)  # fmt: skip
def test_every_mistake_has_its_sentence(tmp_path: Path, old: str, new: str, facts: list[str]) -> None:
    text = HEAD + STAGED
    assert old in text
    result = problems(tmp_path, text.replace(old, new, 1))
    assert any_states(result, facts), "\n".join(result)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("stages = 3", [":1: stages:", "3", "[[stages]]"]),
        ("stages = []", [":1: stages:", "[]", "[[stages]]"]),
        ("stages = [1]", [":1: stages.1:", "1", "[[stages]]"]),
        (
            'stages = [\n{ name = "a" },\n{ name = "b", procedur = {} }]',
            [":3: stages.b.procedur:", "'procedur'", "'procedure'"],
        ),
        ('stages = [{ name = "a" }, { name = {} }]', [":1: stages.2.name:", "table", "text"]),
        ('stages = [{ name = "a" }, { name = "b" }]', [":1: stages:", "loads", "moves", "volume"]),
        (
            'stages = [{ name = "a", procedure = "static" }]',
            [":1: stages.a.procedure:", "'static'", "[stages.procedure]"],
        ),
    ],
)
def test_a_list_that_is_none_is_refused(tmp_path: Path, text: str, facts: list[str]) -> None:
    result = problems(tmp_path, f"{text}\n{HEAD}")
    assert any_states(result, facts), "\n".join(result)


def test_lines_of_arrays_of_tables_are_numbered() -> None:
    text = "[[a]]\nb = 1\n[a.c]\nd = 2\n[[a]]\nb = 3\n[a.c]\nd = 4\n[e]\nf = [{ g = 1 },\n{ g = 2 }]\n"
    assert {".".join(key): line for key, line in key_lines(text).items()} == {
        "a": 1, "a.1": 1, "a.1.b": 2, "a.1.c": 3, "a.1.c.d": 4, "a.2": 5, "a.2.b": 6, "a.2.c": 7, "a.2.c.d": 8,
        "e": 9, "e.f": 10, "e.f.1": 10, "e.f.1.g": 10, "e.f.2": 11, "e.f.2.g": 11,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('cavities = "cavity"', 'cavities = "cavty"', ["'press'", "procedure.cavities", "'cavty'", "'cavity'"]),
        ('moves = {', 'loads.pressure = "1 kPa"\nmoves = {', ["'press'", "cavity", "procedure.cavities"]),
        ('fixed = "xyz"', 'fixed = "xy"', ["1 of 6", "B01", "'plate'"]),
    ],
)  # fmt: skip
def test_what_the_mesh_decides_is_refused_before_the_solve(
    tmp_path: Path, old: str, new: str, facts: list[str]
) -> None:
    text = HEAD + STAGED
    assert old in text
    with refused(*facts):
        prepare(read(tmp_path, text.replace(old, new)))


def test_a_run_names_the_stages_everywhere(tmp_path: Path) -> None:
    job = read(tmp_path, HEAD + STAGED)
    outcome = run_job(job, tmp_path / "out", threads=1)
    names = ["hang", "fill", "press", "let go"]
    states = outcome.solution.states
    assert list(dict.fromkeys(state.stage for state in states)) == names
    response = read_response(tmp_path / "out" / "response.csv")
    assert response.names[:3] == ("load_factor", "stage", "pressure")
    assert (np.diff(response.column("stage")) > 0).all()
    assert set(range(5)) <= set(response.column("stage").tolist())
    with (tmp_path / "out" / "steps.csv").open(encoding="utf-8") as stream:
        steps = list(csv.DictReader(stream))
    assert [row["stage"] for row in steps] == [step.stage for step in outcome.solution.steps]
    assert list(dict.fromkeys(row["stage"] for row in steps)) == names
    report = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    for said in (
        "Loads from the first stage on", "<td>let go</td>", "VolumeControl (volume 0.1 mL, at 0.5)",
        "tip moves to (-0.2, 0, 0) mm from where it was at first", "plate moves to (0, 0, 2.9) mm",
        "Sealed (max step 0.5, cavities cavity)", "press: Reached a volume ", "mL larger than at rest at",
    ):  # fmt: skip
        assert said in report
    listed = (tmp_path / "out" / "vtu" / "state.pvd").read_text(encoding="utf-8")
    assert "timestep is the number of finished stages and the load factor of the next one" in listed
    assert re.findall('timestep="(.*?)"', listed) == [f"{value:.12g}" for value in response.column("stage")]
    last = (tmp_path / "out" / "vtu" / f"state_{len(states) - 1:04d}.vtu").read_text(encoding="utf-8")
    assert 'Name="stage:let go"' in last
    # what the stages say is so: the tip was moved, the volume kept, and in the end nothing acts
    pressed, end = [state for state in states if state.stage == "press"][-1], states[-1]
    tip = pressed.model.mesh.face_nodes("tip")
    assert pressed.displacement[tip, 0] == pytest.approx(-0.2 * mm)
    assert end.displacement[tip, 0] == pytest.approx(-0.2 * mm)
    assert end.pressures["cavity"] == 0.0
    assert not any(load.at(1.0) if isinstance(load, Pressure) else load.acceleration * load.share(1.0)
                   for load in end.model.loads)  # fmt: skip


def test_axes_and_titles_name_stages() -> None:
    columns = (
        Column("load_factor", "", [0, 0.5, 1, 0.5, 1]), Column("stage", "", [0, 0.5, 1, 1.5, 2]),
        Column("pressure", "kPa", [0, 1e3, 2e3, 3e3, 4e3]), Column("cavity_volume", "mL", [1, 2, 3, 4, 5]),
    )  # fmt: skip
    stages = ("fill", "fill", "fill", "press", "press")
    response = Response(columns=columns, source=Source(text="a gauge"), stages=stages)
    (axes, *_) = response_figure(response).axes
    assert [label.get_text() for label in axes.get_xticklabels(minor=True)] == ["fill", "press"]
    assert axes.get_xticks().tolist() == [0, 1, 2]
    assert picture_title(response, -1, "tube") == "tube · press · 4 kPa"
    assert picture_title(response, 0, "tube") == "tube · 0 kPa"
    with refused("1 stages", "5 rows"):
        Response(columns=columns, source=Source(text="a gauge"), stages=("fill",))


def test_the_order_of_stages_and_their_loads_is_that_of_the_file(tmp_path: Path) -> None:
    """Weight then pressure ends where both end together."""
    one = '[[stages]]\nname = "weight"\nloads.gravity = "-z"\n[[stages]]\nname = "air"\nloads.pressure = "1 kPa"\n'
    both = '[loads]\ngravity = "-z"\npressure = "1 kPa"\n'
    ends = []
    for text in (one, both):
        job = read(tmp_path, HEAD + text)
        assert isinstance(job.procedure, Static | Stages)
        ends.append(solve(prepare(job)[0], job.procedure))
    first, second = (solution.states[-1].displacement for solution in ends)
    assert np.abs(first - second).max() < 1e-5 * np.abs(second).max()
    assert len(stage_column(ends[0])) == 1
    assert stage_column(ends[1]) == ()


def test_what_cannot_have_stages_says_so_and_check_lists_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    job = read(tmp_path, HEAD.replace('tip = "x"\n', "") + SWING)
    (file,) = export_job(job, tmp_path / "inp", ["inp"], inp=InpOptions(poisson=0.45)).files
    assert "** stage swing\n*STEP, NLGEOM, INC=1000\n" in file.read_text(encoding="ascii")
    assert "\n*DYNAMIC, ALPHA=-0.111111\n1e-05, 0.01, " in file.read_text(encoding="ascii")
    assert main(["check", str(tmp_path / "job.toml")]) == DONE
    told = capsys.readouterr().out
    said = (
        "Stage 'inflate': Static; Gauge pressure 2 kPa on cavity, following the surface, its share of the way over the "
    )
    assert f"{said}load factor: 0 at 0, 1 at 0.5, 0.5 at 1." in told
    assert "Stage 'swing': Dynamic (duration 0.01 s); " in told
    assert main(["check", str(tmp_path / "no.toml")]) == BAD_INPUT
    assert 2 * kPa == job.procedure.stages[0].loads[0].pressure


def test_the_guide_says_what_is_so(tmp_path: Path) -> None:
    """Its jobs are read, and its table lists the keys of a stage."""
    text = GUIDE.read_text(encoding="utf-8")
    first, grasp, timed = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    head = HEAD[: HEAD.index("[obstacles.plate]")]
    bar = '[obstacles.bar]\nshape = "cylinder"\ncenter = ["8 mm", 0, "-9 mm"]\naxis = "+y"\nradius = "5 mm"\n'
    for block, names in ((first, ["hang", "fill", "press", "open"]), (bar + grasp, ["close", "pull"]),
                         (timed, ["fill", "wait"])):  # fmt: skip
        assert [stage.name for stage in read(tmp_path, head + block).procedure.stages] == names
    assert set(re.findall(r"(?m)^\| `(\w+)` \| [wtfo]", text.split("## What stays")[0])) == set(StageTable.model_fields)


def test_a_grasp_is_two_stages(tmp_path: Path) -> None:
    """As messages say that refuse a grasp among stages: the same states in the same steps."""
    head = HEAD.replace('tip = "x"\n', "").replace("[output]", BAR + "\n[output]")
    one = '[procedure]\ntype = "grasp"\nobject = "bar"\npull_distance = "1 mm"\nmax_step = 0.25\n'
    two = """
[obstacles.middle]
shape = "plane"
point = [0, 0, "-5.02 mm"]
normal = "+z"

[[stages]]
name = "close"
loads.pressure = "10 kPa"
procedure = { type = "static", first_step = 0.1, max_step = 0.5 }

[[stages]]
name = "pull"
procedure = { type = "static", first_step = 0.1, max_step = 0.5 }
moves = { bar = ["1 mm", 0, 0] }
"""
    head = head.replace(HEAD[HEAD.index("[obstacles.plate]") : HEAD.index("[output]")], "")
    jobs = [read(tmp_path, text) for text in (head + '[loads]\npressure = "10 kPa"\n' + one, head + two)]
    grasped, staged = (
        solve(prepare(replace(job, output=Output(measures=("cavity_volume",))))[0], job.procedure).states[-1]
        for job in jobs
    )
    force = staged.touches["bar"].force.sum(axis=0)
    assert force[2] > 1e-3
    assert force == pytest.approx(grasped.touches["bar"].force.sum(axis=0), abs=1e-5 * force[2])


def test_progress_names_the_stage() -> None:
    question, course, said = cases.model(cases.body()), Course(), []
    fill, press = [("fill", 0.2 * k) for k in range(1, 6)], [("press", 0.1), ("press", 0.2)]
    for number, (stage, factor) in enumerate([*fill, *press], start=1):
        at = replace(cases.state(question, load_factor=factor), stage=stage)
        doing = Iteration(step=number, iteration=2, load_factor=factor, residual=1e-9, correction=0.0, step_length=1.0)
        course.follow(at)
        said.append(describe(doing, at))
        assert course.stage == stage
    assert said[5].startswith("press, step 6: load factor 0.1000")
    assert course.seconds_left is not None  # counted from the beginning of this stage


def test_a_cavity_may_be_sealed_in_a_job_without_stages(tmp_path: Path) -> None:
    job = read(tmp_path, HEAD + '[loads]\ngravity = "-z"\n[procedure]\ntype = "sealed"\nduration = "2 s"\n')
    assert job.procedure == Sealed(duration=2.0)
    assert read(tmp_path, lock_text(job, {})).procedure == job.procedure
    assert any_states(problems(tmp_path, HEAD + '[procedure]\ntype = "sealed"\n'), ["loads:", "[loads]", "missing"])
