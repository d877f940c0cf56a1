"""Several cavities: histories, what acts when, what is said about it, and how job files ask for it."""

import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import results_cases as cases
from hypothesis import given
from hypothesis import strategies as st

import turgor.job.job
from refused import refused
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.solids import box, cut, face_names, name_plane, name_rest
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.proximity import find_facing_walls, smallest_gap
from turgor.core.meshing.surface import check_surface
from turgor.core.model.contact import Contact
from turgor.core.model.drive import common_pressure, drive_text, kinks, pressed_together, pressures_at
from turgor.core.model.loads import Channel, Gravity, Load, Pressure
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.results.files.vtu import write_series
from turgor.core.results.measures.measures import find_measure, measure
from turgor.core.results.measures.standard_measures import cavity_volume
from turgor.core.solvers.checks.contact import meeting_walls
from turgor.core.solvers.checks.materials import laws_beyond_their_tests
from turgor.core.solvers.checks.supports import unloaded_cavities
from turgor.core.solvers.continuation import load_control as static_run
from turgor.core.solvers.continuation.predictor import predicted
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.procedure import with_contact_within
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.core.solvers.solution import Solution
from turgor.core.solvers.solve import solve
from turgor.job.job import Job
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.job.text.problems import JobError
from turgor.units import kPa, mL, mm
from turgor.views.pictures.state_picture import picture_title
from turgor.views.plots.response_plots import response_figure
from turgor.views.report import describe
from turgor.views.report.page import Report, write_report

UP_AND_DOWN = ((0, 0), (0.5, 1), (1, 0.5))
LATE = ((0, 0), (0.25, 0), (1, 1))


@dataclass(frozen=True, kw_only=True)
class Twin:
    """A bar of 24 × 10 × 16 mm with two voids of 16 × 6 × 4 mm above each other."""

    wall: float = 2 * mm

    def build(self) -> Geometry:
        voids = {name: box((4 * mm, 20 * mm), (2 * mm, 8 * mm), z) for name, z in _VOIDS.items()}
        for name, void in voids.items():
            void.faces.name = name
        shape = cut(box((0, 24 * mm), (0, 10 * mm), (0, 16 * mm)), list(voids.values()))
        shape.mat("body")
        name_plane(shape, 0, 0.0, "fixed")
        name_plane(shape, 0, 24 * mm, "tip")
        name_rest(shape, "outside")
        one = 16 * 6 * 4 * mm**3
        return Geometry(
            name="twin", smallest_wall=self.wall, cavity_volumes=dict.fromkeys(_VOIDS, one),
            solid_volume=24 * 10 * 16 * mm**3 - 2 * one, regions=("body",), faces=face_names(shape), shape=shape,
        )  # fmt: skip


_VOIDS = {"cavity_1": (3 * mm, 7 * mm), "cavity_2": (9 * mm, 13 * mm)}


@pytest.fixture(scope="module")
def twin() -> Mesh:
    return mesh(Twin().build(), size=8 * mm)


def model(of: Mesh, *loads: Load) -> Model:
    return Model(of, {"body": cases.RUBBER}, [Fixed("fixed")], loads)


@pytest.fixture(scope="module")
def driven(twin: Mesh) -> Solution:
    """Up and half-way down in one cavity, late in the other."""
    loads = (Pressure("cavity_1", 20 * kPa, UP_AND_DOWN), Pressure("cavity_2", 8 * kPa, LATE))
    return solve(model(twin, *loads), Static(first_step=0.25))


# --- histories ---------------------------------------------------------------------------------------------------


def test_a_pressure_grows_in_proportion_unless_told_otherwise() -> None:
    assert Pressure("cavity", 3.0).at(0.1) == 0.1 * 3.0
    assert Pressure("cavity", 3.0) == Pressure("cavity", 3.0, [[0, 0], [1, 1]])
    up = Pressure("cavity", 20.0, [[0, 0], [0.5, 1], [1, -0.5]])
    assert [up.at(f) for f in (0.0, 0.25, 0.5, 0.75, 1.0)] == [0, 10, 20, 5, -10]
    assert hash(up) == hash(Pressure("cavity", 20.0, ((0.0, 0.0), (0.5, 1.0), (1.0, -0.5))))


@given(st.lists(st.floats(0.01, 0.99), max_size=4, unique=True).flatmap(
    lambda factors: st.tuples(st.just(sorted(factors)), st.lists(st.floats(-1, 1), min_size=len(factors) + 1,
                                                                 max_size=len(factors) + 1))))  # fmt: skip
def test_a_history_passes_through_its_points_exactly(drawn: tuple[list[float], list[float]]) -> None:
    points = [(0.0, 0.0), *zip([*drawn[0], 1.0], drawn[1], strict=True)]
    load = Pressure("cavity", 7e3, tuple(points))
    assert [load.share(factor) for factor, _ in points] == [share for _, share in points]


@pytest.mark.parametrize(
    ("history", "facts"),
    [
        ([], ("history is []", "load factor")),
        ([(0, 0)], ("history is [(0, 0)]", "0 to 1")),
        ([(0.1, 0.5), (1, 1)], ("history is [(0.1, 0.5), (1, 1)]", "load factor 0")),
        ([(0, 0), (0.5, 1)], ("history is [(0, 0), (0.5, 1)]", "0 to 1")),
        ([(0, 0), (0.5, 1), (0.5, 0), (1, 1)], ("history is [(0, 0), (0.5, 1), (0.5, 0), (1, 1)]", "0 to 1")),
        ([(0, 0), (float("nan"), 1), (1, 1)], ("history is [(0, 0), (nan, 1), (1, 1)]", "load factor")),
        ([(0, 0), (1, 1.5)], ("history is [(0, 0), (1, 1.5)]", "-1 and 1")),
        ([(0, 0), (1, float("nan"))], ("history is [(0, 0), (1, nan)]", "load factor")),
        ([0, 1], ("history is [0, 1]", "[[0, 0], [0.5, 1], [1, 0.5]]")),
        ([(0, 0), (0.5, 1, 2), (1, 1)], ("history is [(0, 0), (0.5, 1, 2), (1, 1)]", "load factor")),
        ("ramp", ("history is 'ramp'", "'ramp'", "pi, s")),
        (None, ("history is None", "load factor")),
    ],
)
def test_a_wrong_history_is_one_clear_sentence(history: Any, facts: tuple) -> None:
    with refused(*facts):
        Pressure("cavity_1", 1e3, history)


def test_every_point_of_a_history_is_a_state(driven: Solution) -> None:
    assert kinks(driven.model) == (0.25, 0.5)
    factors = [state.load_factor for state in driven.states]
    assert {0.25, 0.5, 1.0} <= set(factors)
    assert driven.message.startswith("Reached cavity_1 10 kPa, cavity_2 8 kPa (load factor 1) in ")


def test_steps_start_anew_at_a_kink_and_a_request_beside_one_is_that_one() -> None:
    control = StepControl.of(Static(first_step=0.4, max_step=0.4, at=(0.1 + 0.2, 0.7)), kinks=(0.3,))
    assert control.targets == (0.3, 0.7, 1.0)
    assert control.next_load(0.0) == 0.3
    assert control.turned(0.1).length == 0.1
    assert control.turned(0.9).length == 0.4


def test_beyond_a_kink_the_path_starts_anew(twin: Mesh, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the predictor knows and how long a step is, after a kink as at the start."""
    known: dict[float, int] = {}

    def watched(constraint: Any, tangent: Any, history: Any, load: float, how: Any) -> Any:
        known[history[-1].parameter] = len(history)
        return predicted(constraint, tangent, history, load, how)

    monkeypatch.setattr(static_run, "predicted", watched)
    loads = (Pressure("cavity_1", 1 * kPa, ((0, 0), (0.5, 1), (1, 0))),)
    steps = solve(model(twin, *loads), Static(first_step=0.125, max_step=0.5)).steps
    assert [step.load_factor for step in steps[:3]] == [0.125, 0.375, 0.5]
    assert steps[3].increment == 0.125
    assert [known[factor] for factor in (0.0, 0.125, 0.375, 0.5, 0.625)] == [1, 2, 3, 1, 2]


# --- what acts, and what is said about it ------------------------------------------------------------------------


def test_what_acts_in_each_cavity(twin: Mesh) -> None:
    two = model(twin, Pressure("cavity_2", 8 * kPa, LATE), Pressure("cavity_1", 20 * kPa))
    assert list(pressures_at(two, 0.25).items()) == [("cavity_1", 5 * kPa), ("cavity_2", 0.0)]
    assert common_pressure(two.loads) is None
    assert drive_text(two, 0.25) == "cavity_1 5 kPa, cavity_2 0 kPa"
    same = model(twin, Pressure("cavity_1", 6 * kPa), Pressure("cavity_2", 6 * kPa))
    assert common_pressure(same.loads) == Pressure("cavity_1", 6 * kPa)
    assert drive_text(same, 0.5) == "3 kPa"
    assert drive_text(model(twin), 0.5) == ""
    twice = model(twin, Pressure("cavity_1", 6 * kPa), Pressure("cavity_1", 1 * kPa))
    assert pressures_at(twice, 1.0) == {"cavity_1": 7 * kPa, "cavity_2": 0.0}


def test_response_has_each_pressure_and_each_volume(driven: Solution) -> None:
    response = measure(driven, cavity_volume)
    assert response.names == ("load_factor", "cavity_1_pressure", "cavity_2_pressure", "cavity_volume",
                              "cavity_1_volume", "cavity_2_volume")  # fmt: skip
    one, two = (response.column(f"cavity_{n}_pressure") for n in (1, 2))
    factors = response.column("load_factor")
    np.testing.assert_allclose(one, 20 * kPa * np.interp(factors, [0, 0.5, 1], [0, 1, 0.5]))
    np.testing.assert_allclose(two, 8 * kPa * np.interp(factors, [0, 0.25, 1], [0, 0, 1]))
    volumes = [response.column(f"cavity_{n}_volume") for n in (1, 2)]
    np.testing.assert_allclose(volumes[0] + volumes[1], response.column("cavity_volume"), rtol=1e-12)
    assert volumes[0][0] / mL == pytest.approx(0.384)
    assert volumes[0].argmax() == one.argmax()
    assert volumes[1][list(factors).index(0.5)] < volumes[1][-1]


def test_one_pressure_stays_one_column(twin: Mesh) -> None:
    both = model(twin, Pressure("cavity_1", 2 * kPa), Pressure("cavity_2", 2 * kPa))
    rest = cases.solution([cases.state(both, None, f) for f in (0.0, 1.0)])
    assert measure(rest, cavity_volume).names == ("load_factor", "pressure", "cavity_volume", "cavity_1_volume",
                                                  "cavity_2_volume")  # fmt: skip


def test_the_volume_of_one_cavity_is_a_measure_by_name(driven: Solution) -> None:
    both = measure(driven, cavity_volume, find_measure("cavity_2_volume"))
    assert both.names.count("cavity_2_volume") == 1
    alone = measure(driven, find_measure("cavity_2_volume"))
    assert alone.names[-1] == "cavity_2_volume"
    with refused("cavity_3_volume", "cavity_3", "cavity_2"):
        measure(driven, find_measure("cavity_3_volume"))
    with refused("cavity_volum", "cavity_volume"):
        find_measure("cavity_volum")


def test_plot_draws_the_pressures_in_a_panel_of_their_own(driven: Solution) -> None:
    figure = response_figure(measure(driven, cavity_volume))
    first, second = figure.axes
    assert (first.get_xlabel(), first.get_ylabel()) == ("load factor", "pressure [kPa]")
    assert [text.get_text() for text in first.get_legend().get_texts()] == ["cavity 1", "cavity 2"]
    assert (second.get_xlabel(), second.get_ylabel()) == ("load factor", "cavity volume [mL]")
    assert [text.get_text() for text in second.get_legend().get_texts()] == ["all", "cavity 1", "cavity 2"]


def test_report_and_title_show_every_cavity(driven: Solution, tmp_path: Path) -> None:
    response = measure(driven, cavity_volume)
    write_report(tmp_path / "r.html", Report(title="Twin", solution=driven, response=response))
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    for fact in ("<b>10 kPa</b><span>cavity 1 pressure", "<b>8 kPa</b><span>cavity 2 pressure",
                 "cavity 2 volume</span>", "current volume enclosed by the face cavity_1, whole actuator"):  # fmt: skip
        assert fact in text, fact
    assert picture_title(response, -1, "twin") == "twin · cavity_1 10 kPa, cavity_2 8 kPa"
    assert describe.loads(driven.model) == [
        "Gauge pressure 10 kPa on cavity_1, following the surface, after 0 kPa at load factor 0, 20 kPa at load "
        "factor 0.5.",
        "Gauge pressure 8 kPa on cavity_2, following the surface, after 0 kPa at load factor 0, 0 kPa at load "
        "factor 0.25.",
    ]


def test_files_for_paraview_go_by_the_load_factor(driven: Solution, tmp_path: Path) -> None:
    text = write_series(tmp_path, driven).read_text(encoding="utf-8")
    assert "timestep is the load factor" in text
    assert 'timestep="0.5"' in text


# --- checks ------------------------------------------------------------------------------------------------------


def test_an_open_cavity_is_named(twin: Mesh) -> None:
    assert [finding.code for finding in check_surface(twin) if finding.code == "G02"] == []
    walls = twin.face("cavity_2")  # torn across all four walls, not cut by a plane as an inlet is
    faces = {**twin.faces, "cavity_2": walls[twin.points[walls[:, :3], 0].mean(axis=1) > 11 * mm]}
    opened = Mesh(points=twin.points, cells=twin.cells, regions=twin.regions, faces=faces)
    (finding,) = (each for each in check_surface(opened) if each.code == "G02")
    assert finding.message.startswith("Face 'cavity_2' is not closed: ")


def test_a_cavity_without_pressure_is_noted(twin: Mesh) -> None:
    (result,) = unloaded_cavities(model(twin, Pressure("cavity_1", 1 * kPa)))
    assert str(result).startswith("B03 note: No pressure is stated for cavity_2: it stays open to the air, at 0 kPa.")
    assert unloaded_cavities(model(twin)) == ()
    assert unloaded_cavities(model(twin, Pressure("cavity_1", 1 * kPa), Pressure("cavity_2", 0.0))) == ()
    channel = Channel(between=("cavity_1", "cavity_2"), resistance=1e9)
    assert unloaded_cavities(model(twin, Pressure("cavity_1", 1 * kPa), channel)) == ()


def test_which_cavities_can_be_pressed_together(twin: Mesh) -> None:
    one, two = Pressure("cavity_1", 2 * kPa, UP_AND_DOWN), Pressure("cavity_2", 1 * kPa)
    assert pressed_together(model(twin, one, two)) == ("cavity_2",)
    assert pressed_together(model(twin, one, Pressure("cavity_2", 2 * kPa))) == ("cavity_1", "cavity_2")
    assert pressed_together(model(twin, Pressure("cavity_1", 2 * kPa), Pressure("cavity_2", 2 * kPa))) == ()
    assert pressed_together(model(twin, Pressure("cavity_1", -2 * kPa))) == ("cavity_1",)
    assert pressed_together(model(twin)) == ()


def test_which_cavities_a_procedure_may_press_together(twin: Mesh) -> None:
    channel, three = (
        Channel(between=("cavity_1", "cavity_2"), resistance=1e9),
        VolumeControl(volume={"cavity_2": 3 * mL}),
    )
    for loads, procedure, names in (
        ((), Static(), ()),
        ((), three, ("cavity_2",)),
        ((Pressure("cavity_1", -2 * kPa),), Stages([Stage("fill", three), Stage("hold")]), ("cavity_1", "cavity_2")),
        ((Pressure("cavity_1", -2 * kPa), channel), Static(duration=1.0), ("cavity_1", "cavity_2")),
        ((), GasMass(mass_ratio={"cavity_1": 0.5}), ("cavity_1",)),
    ):
        guarded = with_contact_within(model(twin, *loads), procedure)
        assert pressed_together(guarded) == names
        moved = replace(guarded, contact=guarded.contact.with_obstacles(()))
        assert pressed_together(moved) == names


def test_walls_of_a_cavity_that_is_pressed_flat_are_found(twin: Mesh) -> None:
    """The lower wall of cavity_2 is moved up through the upper one by formula, its rim held: at 4 mm they touch."""
    assert smallest_gap(find_facing_walls(twin, cavity="cavity_2")) == pytest.approx(4 * mm)
    assert all(twin.points[wall, 2].min() > 8.9 * mm for wall in find_facing_walls(twin, cavity="cavity_2").walls)
    assert not np.isfinite(smallest_gap(find_facing_walls(twin)))
    loads = (Pressure("cavity_1", 2 * kPa), Pressure("cavity_2", 1 * kPa))

    def in_wall(points: np.ndarray) -> np.ndarray:
        return np.all(np.abs(points - [12 * mm, 5 * mm, 9 * mm]) < [7.9 * mm, 2.9 * mm, 1e-9], axis=1)

    def lifted(height: float) -> Any:
        return lambda points: points + np.outer(in_wall(points), [0, 0, height])

    states = [cases.state(model(twin, *loads), lifted(5 * mm * f), f) for f in (0.0, 0.5, 1.0)]
    assert meeting_walls(model(twin, *loads), states) == ()  # contact looks after what is pressed together
    alone = Model(twin, {"body": cases.RUBBER}, [Fixed("fixed")], loads, contact=Contact(self_contact=False))
    (result,) = meeting_walls(alone, states)
    assert result.message.startswith("Walls of cavity_2 met at load factor 0.8 (cavity_1 1.6 kPa, cavity_2 0.8 kPa);")
    pressures = [Pressure(name, 2 * kPa) for name in _VOIDS]
    even = Model(twin, {"body": cases.RUBBER}, [Fixed("fixed")], pressures, contact=Contact(self_contact=False))
    assert meeting_walls(even, states) == ()


def test_a_law_used_beyond_its_tests_on_the_way_is_told(twin: Mesh) -> None:
    """The largest stretch is where the pressure turns; at the end nothing is stretched any more."""
    tested = replace(cases.RUBBER, stretch_range=(1.0, 1.1))
    there_and_back = Pressure("cavity_1", 20 * kPa, ((0, 0), (0.5, 1), (1, 0)))
    question = Model(twin, {"body": tested}, [Fixed("fixed")], [there_and_back])
    states = [cases.state(question, cases.stretched(s), f) for s, f in ((1.0, 0.0), (1.3, 0.5), (1.0, 1.0))]
    (finding,) = laws_beyond_their_tests(question, states)
    assert finding.code == "M01"
    assert laws_beyond_their_tests(question, [states[0], states[2]]) == ()


# --- job files ---------------------------------------------------------------------------------------------------

JOB = """\
[actuator]
type = "twin"

[mesh]
size = "8 mm"

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa", density = "1100 kg/m³" }

[loads]
{loads}

[procedure]
type = "static"
at = [0.1]
"""

EACH = """\
gravity = "-z"
[loads.cavity_2]
pressure = "8 kPa"
[loads.cavity_1]
pressure = "20 kPa"
history = [[0, 0], [0.5, 1], [1, 0.5]]
"""


@pytest.fixture
def family(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turgor.job.job, "ACTUATORS", {"twin": Twin})
    monkeypatch.setattr("turgor.job.tables.bodies.body_tables.ACTUATORS", {"twin": Twin})


def read(folder: Path, loads: str, at: str = "0.1") -> Job:
    (folder / "twin.toml").write_text(
        JOB.replace("{loads}", loads).replace("at = [0.1]", f"at = [{at}]"), encoding="utf-8"
    )
    return read_job(folder / "twin.toml")


@pytest.mark.usefixtures("family")
def test_one_pressure_acts_in_all_cavities(tmp_path: Path) -> None:
    assert read(tmp_path, 'pressure = "60 kPa"').loads == (Pressure("cavity_1", 60e3), Pressure("cavity_2", 60e3))
    assert read(tmp_path, 'pressure = "60 kPa"', '"30 kPa"').procedure.at == (0.5,)
    some = read(tmp_path, 'pressure = "60 kPa"\n[loads.cavity_1]\npressure = "0 kPa"')
    assert some.loads == (Pressure("cavity_1", 0.0), Pressure("cavity_2", 60e3))


@pytest.mark.usefixtures("family")
def test_each_cavity_has_its_own_pressure_and_history(tmp_path: Path) -> None:
    job = read(tmp_path, EACH)
    assert job.loads == (Pressure("cavity_1", 20e3, UP_AND_DOWN), Pressure("cavity_2", 8e3), Gravity((0.0, 0.0, -1.0)))


@pytest.mark.usefixtures("family")
@pytest.mark.parametrize("loads", ['pressure = "60 kPa"', EACH, '[loads.cavity_2]\npressure = "14.7 psi"'])
def test_the_lock_file_gives_the_same_loads(tmp_path: Path, loads: str) -> None:
    job = read(tmp_path, loads)
    text = lock_text(job, {})
    (tmp_path / "job.lock.toml").write_text(text, encoding="utf-8")
    again = read_job(tmp_path / "job.lock.toml")
    assert again == job
    assert lock_text(again, {}) == text
    assert "history" not in tomllib.loads(text)["loads"]["cavity_2"]


MISTAKES = [
    # (loads, at, line, key, what else is stated)
    ('[loads.cavty_1]\npressure = "1 kPa"', "0.1", 11, "loads.cavty_1", ("'cavty_1'", "'cavity_1'", "outside, tip")),
    ('[loads.cavity]\npressure = "1 kPa"', "0.1", 11, "loads.cavity", ("'cavity'", "cavity_1, cavity_2")),
    ('cavity_2 = "20 kPa"', "0.1", 11, "loads.cavity_2", ("'20 kPa'", "[loads.cavity_2]")),
    ('cavity_3 = "20 kPa"', "0.1", 11, "loads.cavity_3", ("'cavity_3'", "cavity_1, cavity_2")),
    ("[loads.cavity_1]", "0.1", 11, "loads.cavity_1.pressure", ("'pressure'", "missing")),
    ('[loads.cavity_1]\npressure = "1 kPa"\nhistroy = []', "0.1", 13, "loads.cavity_1.histroy",
     ("'histroy'", "'history'", "history_over_time")),
    ('[loads.cavity_1]\npressure = "1 kPa"\nhistory = [[0, 0], [0.5, 1]]', "0.1", 13, "loads.cavity_1.history",
     ("[[0, 0], [0.5, 1]]", "0 to 1")),
    ('[loads.cavity_1]\npressure = "1 kPa"\nhistory = [[0], [1]]', "0.1", 13, "loads.cavity_1.history",
     ("[[0], [1]]",)),
    ('[loads.cavity_1]\npressure = "1 kPa"\nhistory = "ramp"', "0.1", 13, "loads.cavity_1.history",
     ("'ramp'", "[[0, 0], [0.5, 1], [1, 0.5]]", "pi, s")),
    ('pressure = "1 kPa"\nhistory = [[0, 0], [1, 1]]', "0.1", 12, "loads.history", ("[loads.cavity_1]",)),
    (EACH.replace("gravity", 'pressure = "2 kPa"\ngravity'), "0.1", 11, "loads.pressure", ("2 kPa", "every cavity")),
    (EACH, '"5 kPa"', 21, "procedure.at", ("cavities", "load factors", 0.5)),
    ('[loads.cavity_1]\npressure = "20 kPa"\nhistory = [[0, 0], [0.5, 1], [1, 0.5]]', '"5 kPa"', 17, "procedure.at",
     ("a history", "load factors")),
]  # fmt: skip


@pytest.mark.usefixtures("family")
@pytest.mark.parametrize(("loads", "at", "line", "key", "facts"), MISTAKES)
def test_each_mistake_is_one_clear_sentence(
    tmp_path: Path, loads: str, at: str, line: int, key: str, facts: tuple
) -> None:
    with refused(f"twin.toml:{line}: {key}:", *facts, error=JobError) as error:
        read(tmp_path, loads, at)
    assert len(error.value.problems) == 1
