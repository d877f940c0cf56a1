"""``coarse_size`` of a job file: what is refused, and what a run with it writes."""

from pathlib import Path

import pytest

import turgor as tg
from turgor.units import mm

JOB = """
[actuator]
type = "fast_pneunet"
chambers = 2
length = "20 mm"
[mesh]
size = "2.5 mm"
coarse_size = "{coarse}"
[materials]
body = {{ law = "neo_hooke", C10 = "0.11 MPa", name = "soft" }}
base = {{ law = "neo_hooke", C10 = "0.2 MPa", name = "stiff" }}
[loads]
pressure = "3 kPa"
[procedure]
{procedure}
[output]
measures = ["bending_angle"]
fields = false
pictures = false
report = false
"""

STATIC = 'type = "static"\nat = [0.5]\nmax_step = 1.0'


def written(folder: Path, coarse: str = "6 mm", procedure: str = STATIC) -> Path:
    path = folder / "job.toml"
    path.write_text(JOB.format(coarse=coarse, procedure=procedure))
    return path


def test_a_run_with_a_coarse_size_states_its_mesh_error_and_repeats(tmp_path: Path) -> None:
    outcome = tg.jobs.run_job(tg.jobs.read_job(written(tmp_path)), tmp_path / "out")
    assert "The path on a coarse mesh of" in outcome.solution.message
    assert [state.load_factor for state in outcome.solution.states] == [0.0, 0.5, 1.0]
    estimate = outcome.response.mesh_error("bending_angle")
    assert estimate is not None
    assert 0 < estimate[-1] < 0.5 * outcome.response.column("bending_angle")[-1]
    assert tg.jobs.read_job(tmp_path / "out" / "job.lock.toml").mesh_coarse == pytest.approx(6 * mm)


@pytest.mark.parametrize(
    ("coarse", "procedure", "said"),
    [
        ("2.5 mm", STATIC, r"coarse_size: is 2.5 mm; it must be larger than size, 2.5 mm"),
        ("6 mm", 'type = "arc_length"', r"coarse_size: leads the steps of Static .* is ArcLength"),
        ("6 mm", 'type = "static"\nduration = "2 s"', r"coarse_size: leads the steps of Static without a duration"),
        ("six", STATIC, r"coarse_size"),
    ],
)
def test_coarse_sizes_that_cannot_lead_are_refused(tmp_path: Path, coarse: str, procedure: str, said: str) -> None:
    with pytest.raises(tg.TurgorError, match=said):
        tg.jobs.read_job(written(tmp_path, coarse, procedure))
