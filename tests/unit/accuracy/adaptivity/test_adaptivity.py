"""Mesh errors: the indicator, the second mesh, the columns of a response, and what is said about them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.accuracy.adaptivity import mesh_error
from turgor.accuracy.adaptivity.findings import mesh_error_findings
from turgor.accuracy.adaptivity.mesh_error import find_again, path_length
from turgor.accuracy.adaptivity.second_mesh import SecondMesh
from turgor.accuracy.measure import mesh_error_of
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.meshing.quality.proximity import find_facing_walls
from turgor.core.meshing.quality.self_contact import may_meet
from turgor.core.results.error_text import with_error
from turgor.core.solvers.remeshing.indicator import error_indicator, squared_errors
from turgor.core.solvers.remeshing.refine import refined
from turgor.foundation.finding import Severity
from turgor.foundation.response import Column, Response
from turgor.units import kPa, mL, mm

SOFT = tg.Material(name="soft", law=tg.Yeoh(C10=0.11e6, C20=0.02e6), density=1000.0)
STIFF = tg.Material(name="stiff", law=tg.laws.NeoHooke(C10=2.2e6), density=1000.0)
G01 = tg.solutions.Finding(code="G01", severity=Severity.WARNING, message="One cell.", advice="Look.")


@pytest.fixture(scope="module", params=["tetrahedra", "hexahedra"])
def bent(request):
    finger = tg.FastPneuNet(chambers=2, length=20 * mm)
    mesh = tg.mesh(finger.build(), size=4 * mm, cells=request.param)
    model = tg.Model(mesh, {"body": SOFT, "base": STIFF}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 3 * kPa)])
    return tg.solve(model)


def test_shares_of_the_error_sum_to_one_and_are_finest_by_direction_in_hexahedra(bent):
    shares = error_indicator(bent.states[-1])
    directions = 3 if bent.model.mesh.cells.shape[1] == 27 else 1
    assert shares.shape == (len(bent.model.mesh.cells), directions)
    assert shares.sum() == pytest.approx(1)
    assert shares.min() >= 0


def test_the_soft_body_carries_the_error_and_the_stiff_base_next_to_nothing(bent):
    shares = error_indicator(bent.states[-1]).sum(axis=1)
    assert shares[bent.model.mesh.regions["body"]].sum() > 0.9


def test_refinement_grows_with_what_is_allowed(bent):
    mesh, shares = bent.model.mesh, error_indicator(bent.states[-1])
    little, much = refined(mesh, shares, 1.6), refined(mesh, shares, 3.0)
    assert len(mesh.cells) < len(little.mesh.cells) < len(much.mesh.cells)
    assert len(refined(mesh, shares, 8.0).mesh.cells) == 8 * len(mesh.cells)


def test_what_remains_on_the_second_mesh_scales_the_difference_more_for_stresses(bent):
    paired = find_again(bent, tg.EngineOptions(threads=1))
    first, second = bent.states[-1], paired.pairs[max(paired.pairs)]
    squared, remaining = (float(squared_errors(state).sum()) for state in (first, second))
    assert paired.remaining == pytest.approx(remaining / squared)
    assert 0.2 < paired.remaining < 1  # sharp edges: cells of half the size leave about half of the error
    factor = paired.factor(local=False)
    assert factor == pytest.approx(1 / (1 - paired.remaining))
    assert paired.factor(local=True) > 1.5 * factor
    assert replace(paired, remaining=2.0).factor(local=False) == 4  # where the indicator sees no improvement
    measure = tg.measures.von_mises_p99
    error = mesh_error_of(bent, (measure,)).errors[measure.name][-1]
    assert error >= paired.factor(local=True) * abs(measure(second) - measure(first))


def test_what_was_read_of_the_path_is_not_read_again(bent):
    read = []

    def rise(at):
        read.append(at.mesh)
        return float(at.displacement[:, 2].max())

    measure = tg.measures.Measure(name="rise", unit="mm", function=rise, definition="largest displacement along z")
    response, new = tg.measure(bent, measure, mesh_error=False), mesh_error_of(bent, (measure,))
    read.clear()
    known = mesh_error_of(bent, (measure,), known=response)
    assert read and all(mesh is not bent.model.mesh for mesh in read)
    assert known.errors["rise"] == pytest.approx(new.errors["rise"])


def test_walls_that_may_meet_are_those_of_the_first_mesh(bent, monkeypatch):
    searched, search = [], find_facing_walls

    def noted(mesh):
        searched.append(mesh)
        return search(mesh)

    monkeypatch.setattr("turgor.core.meshing.quality.self_contact.find_facing_walls", noted)
    find_again.cache_clear()
    paired = find_again(bent, tg.EngineOptions(threads=1))
    assert may_meet(paired.pairs[max(paired.pairs)].model.mesh)
    assert all(mesh is bent.model.mesh for mesh in searched)


@pytest.mark.parametrize(("growth", "again"), [(0.0, 0), (1.0, 1)])
def test_state_that_failed_is_tried_again_on_a_coarser_mesh_alone(bent, monkeypatch, growth, again):
    tried = []
    least = mesh_error._least_growth(bent)
    monkeypatch.setattr(mesh_error, "plan", lambda solution, refined_before: (1, least + growth))
    monkeypatch.setattr(SecondMesh, "solved_again", lambda mesh, state, *how, **linear: tried.append(state.load_factor))
    find_again.cache_clear()
    assert not find_again(bent, tg.EngineOptions(threads=1)).pairs
    find_again.cache_clear()
    assert tried.count(1.0) == 1 + again
    assert len(set(tried)) == 3


def test_every_measure_of_every_state_has_its_mesh_error(bent):
    response = tg.measure(bent, tg.bending_angle, tg.cavity_volume)
    assert response.names == (
        "load_factor", "pressure", "bending_angle", "bending_angle_mesh_error", "cavity_volume",
        "cavity_volume_mesh_error",
    )  # fmt: skip
    for name in ("bending_angle", "cavity_volume"):
        error = response.mesh_error(name)
        assert len(error) == len(bent.states)
        assert error[0] == 0
        assert (error[1:] > 0).all()
        assert error[-1] < 0.2 * abs(response.column(name)[-1])
    assert [column.name for column in response.quantities] == [
        "load_factor", "pressure", "bending_angle", "cavity_volume"
    ]  # fmt: skip


def test_the_estimate_can_be_switched_off(bent):
    response = tg.measure(bent, tg.bending_angle, mesh_error=False)
    assert response.names == ("load_factor", "pressure", "bending_angle")
    assert response.mesh_error("bending_angle") is None


def test_mesh_errors_come_back_from_a_file(bent, tmp_path):
    response = tg.measure(bent, tg.bending_angle)
    response.to_csv(tmp_path / "response.csv")
    again = tg.files.read_response(tmp_path / "response.csv")
    assert again.mesh_error("bending_angle") == pytest.approx(response.mesh_error("bending_angle"))
    assert "bending_angle_mesh_error_deg" in (tmp_path / "response.csv").read_text().splitlines()[0]


def test_a_mesh_error_of_an_unknown_column_is_answered_with_the_near_match(bent):
    with refused("'bending_angel'", "'bending_angle'"):
        tg.measure(bent, tg.bending_angle, mesh_error=False).mesh_error("bending_angel")


def test_a_prescribed_volume_leaves_the_error_to_the_pressure(bent):
    model = replace(bent.model, loads=())
    solution = tg.solve(model, tg.VolumeControl(volume=0.2 * mL))
    response = tg.measure(solution, tg.cavity_volume, tg.bending_angle)
    assert response.mesh_error("pressure")[-1] > 1e-4 * response.column("pressure")[-1]
    assert response.mesh_error("cavity_volume")[-1] < 1e-6 * response.column("cavity_volume")[-1]


def test_where_the_path_decides_the_mesh_error_is_unknown_and_says_so(bent):
    rubbing = replace(bent.model, contact=tg.Contact(self_contact=tg.obstacles.SelfContact(friction=0.3)))
    estimate = mesh_error_of(replace(bent, model=rubbing), (tg.bending_angle,))
    assert np.isnan(estimate.errors["bending_angle"]).all()
    assert estimate.finding.code == "N03"
    assert "friction" in estimate.finding.message


def test_states_lie_along_the_path_by_how_far_the_nodes_went(bent):
    place = path_length(bent)
    assert place[0] == 0
    assert place[-1] == 1
    assert (np.diff(place) > 0).all()


@pytest.mark.parametrize(
    ("value", "error", "unit", "text"),
    [
        (1.6196, 0.0157, "deg", "92.8 ± 0.9 deg"),
        (1.6196, 0.0018, "deg", "92.80 ± 0.10 deg"),
        (0.0123, 0.004, "mm", "12 ± 4 mm"),
        (250e3, 30e3, "kPa", "250 ± 30 kPa"),
        (1.5, 0.02, "", "1.50 ± 0.02"),
        (0.01234, float("nan"), "mm", "12.34 mm"),
        (1e-12, 1e-10, "N", "1e-12 N"),
    ],
)
def test_values_show_as_many_digits_as_their_error_allows(value, error, unit, text):
    assert with_error(value, error, unit) == text


def _response(error):
    angle = Column("bending_angle", "deg", [0.0, 1.0])
    errors = Column("bending_angle_mesh_error", "deg", [0.0, error])
    return Response(columns=(angle, errors), source=tg.laws.Source(text="cells"))


def test_a_wall_of_one_cell_is_reported_only_where_the_error_is_large():
    assert mesh_error_findings(_response(0.01), (G01,)) == ()
    codes = [finding.code for finding in mesh_error_findings(_response(0.03), (G01,))]
    assert codes == ["G01", "N02"]
    assert [finding.code for finding in mesh_error_findings(_response(np.nan), (G01,))] == ["G01"]


@pytest.mark.parametrize(("error", "severity"), [(0.03, Severity.NOTE), (0.06, Severity.WARNING)])
def test_a_large_mesh_error_is_noted_and_a_larger_one_doubted(error, severity):
    (finding,) = mesh_error_findings(_response(error), ())
    assert finding.severity is severity
    assert f"({100 * error:.2g} %)" in finding.message


@pytest.mark.parametrize(
    ("quality", "error", "codes"),
    [
        ("draft", 0.09, []),
        ("draft", 0.11, ["G01", "N02"]),
        ("normal", 0.019, []),
        ("fine", 0.004, []),
        ("fine", 0.006, ["G01", "N02"]),
    ],
)
def test_only_a_measure_that_misses_the_requested_quality_is_reported(quality, error, codes):
    findings = mesh_error_findings(_response(error), (G01,), quality)
    assert [finding.code for finding in findings] == codes


def test_the_advice_names_the_next_quality_and_the_requested_error():
    (draft,) = mesh_error_findings(_response(0.26), (), "draft")
    assert draft.severity is Severity.WARNING
    assert "above 10 %" in draft.message
    assert 'quality = "normal"' in draft.advice
    assert 'target = "10 %"' in draft.advice
    (fine,) = mesh_error_findings(_response(0.011), (), "fine")
    assert fine.severity is Severity.NOTE
    assert "quality =" not in fine.advice
    assert "hexahedra" in fine.advice
    (has_them,) = mesh_error_findings(_response(0.26), (), "draft", hexahedra=True)
    assert "hexahedra" not in has_them.advice
    assert "Use a better quality" in has_them.advice
    assert 'target = "0.5 %"' in fine.advice


def test_a_mesh_is_refined_until_the_target_is_met(bent):
    if bent.model.mesh.cells.shape[1] == 27:
        pytest.skip("whole sheets grow fast: a minute, for the same lines")
    first = tg.measure(bent, tg.bending_angle)
    before = first.mesh_error("bending_angle")[-1] / first.column("bending_angle")[-1]
    result = tg.mesh_to(bent.model, tg.bending_angle, 0.5 * before)
    assert result.reached
    assert result.rounds[0].relative == pytest.approx(before, rel=1e-6)
    assert result.rounds[-1].relative <= 0.5 * before
    assert result.rounds[-1].unknowns > result.rounds[0].unknowns
    assert len(result.solution.states) == len(bent.states)
    assert result.finding.code == "N04"
    assert "body" in result.finding.message
    anew = tg.solve(result.solution.model)
    value = tg.measure(anew, tg.bending_angle, mesh_error=False).column("bending_angle")[-1]
    assert result.rounds[-1].value == pytest.approx(value, rel=1e-5)


def test_refinement_stops_at_the_limit_and_says_so(bent):
    result = tg.mesh_to(bent.model, tg.bending_angle, 1e-4, most_unknowns=bent.model.mesh.unknown_count + 1)
    assert not result.reached
    assert result.finding.severity is Severity.WARNING
    assert "unknowns" in result.finding.message
    assert "most_unknowns" in result.finding.advice


@pytest.mark.parametrize("target", [0.0, 2.0, -0.1, float("nan")])
def test_a_target_that_is_no_share_is_refused(bent, target):
    with refused(f"{100 * target:g} %", "0.01 % to 50 %"):
        tg.mesh_to(bent.model, tg.bending_angle, target)


JOB = """
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
[mesh]
size = "4 mm"
{mesh}
[materials]
body = {{ law = "yeoh", C10 = "0.11 MPa", C20 = "0.02 MPa", name = "soft" }}
base = {{ law = "neo_hooke", C10 = "2.2 MPa", name = "stiff" }}
[loads]
pressure = "3 kPa"
[output]
measures = ["bending_angle"]
fields = false
pictures = false
{output}
"""


def _job(tmp_path: Path, mesh: str = "", output: str = "") -> Path:
    path = tmp_path / "job.toml"
    path.write_text(JOB.format(mesh=mesh, output=output))
    return path


def test_a_job_states_errors_everywhere_and_repeats_its_target(tmp_path):
    job = tg.jobs.read_job(_job(tmp_path, 'target = "4 %"'))
    outcome = tg.jobs.run_job(job, tmp_path / "out")
    assert outcome.response.mesh_error("bending_angle")[-1] <= 0.04 * outcome.response.column("bending_angle")[-1]
    assert "N04" in [finding.code for finding in outcome.findings]
    assert "±" in (tmp_path / "out" / "report.html").read_text()
    assert "bending_angle_mesh_error_deg" in (tmp_path / "out" / "response.csv").read_text()
    again = tg.jobs.read_job(tmp_path / "out" / "job.lock.toml")
    assert (again.mesh_target, again.mesh_most_unknowns) == (0.04, 200_000)


def test_a_job_can_do_without_the_estimate(tmp_path):
    outcome = tg.jobs.run_job(tg.jobs.read_job(_job(tmp_path, output="mesh_error = false")), tmp_path / "out")
    assert outcome.response.mesh_error("bending_angle") is None
    assert "±" not in (tmp_path / "out" / "report.html").read_text()


@pytest.mark.parametrize(
    ("line", "facts"),
    [
        ('target = "200 %"', ["mesh.target", "200 %", "0.01 % to 50 %"]),
        ('target = "two"', ["mesh.target", "'two'", "'2 %'"]),
        ("target = 0.02", ["mesh.target", 0.02, "'2 %'"]),
        ('target_measure = "bending_angel"', ["mesh.target_measure", "'bending_angel'", "'bending_angle'"]),
        ('targt = "2 %"', ["mesh.targt", "'target'"]),
    ],
)
def test_a_wrong_target_in_a_job_is_one_sentence(tmp_path, line, facts):
    with refused(*facts):
        tg.jobs.read_job(_job(tmp_path, line))


def test_threads_that_go_slack_do_not_make_the_estimate_dear(monkeypatch):
    """Old factors fail where threads go slack; the estimate takes few new ones, and not as many as the solve."""
    helix = tg.Fibers(
        face="outside",
        material=tg.from_library("kevlar-fiber"),
        diameter=0.1778 * mm,
        winding=tg.Winding(angle_from_axis=np.radians(60), spacing=2 * mm, hand="right"),
    )
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    mesh = tg.mesh(tg.actuators.TwistingTube(length=40 * mm).build(), size=4 * mm, cells="tetrahedra")
    loads = [tg.Pressure("cavity", 20 * kPa)]
    solution = tg.solve(tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed")], loads, reinforcements=[helix]))
    made, factor = [], Tangent.factor

    def counted(self, *args):
        made.append(self)
        return factor(self, *args)

    monkeypatch.setattr(Tangent, "factor", counted)
    estimate = mesh_error_of(solution, (tg.measures.twist_angle,))
    assert estimate.errors["twist_angle"][-1] == pytest.approx(np.radians(0.17), rel=0.3)
    assert 1 < len(made) <= solution.timing.factorizations / 3


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_a_body_that_stays_at_rest_has_moved_by_no_share():
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=6 * mm)
    model = tg.Model(mesh, {"body": SOFT, "base": STIFF}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 0.0)])
    still = tg.solve(model, tg.Static(first_step=1.0, max_step=1.0))
    paired = find_again(still, tg.EngineOptions(threads=1))
    assert set(paired.moved.values()) == {0.0}
