"""A rigid body of a job file moves as mechanics says: it slides, sticks, rolls, and rests on what is soft.

Problems: a block of 4 g on a plane of 30° with friction, in motion: a = g (sin α − µ cos α) for µ < tan α, at rest
above it; a solid bar rolls down without slipping at a = 2/3 g sin α and turns by s / R; a ball comes to rest on a soft
block, which it presses with its weight. Source: exact. Tolerances: 3 % of the way, because weight ramps up and friction
has an elastic slip; 3 % of the rolling, because the bar's curved sides are quadratic and its steps are even; 0.1 % of
the weight, because viscous forces fade.
"""

from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.units import mm

G, SLOPE, TIME = 9.80665, np.radians(30), 0.04
BLOCK = """
[bodies.box]
type = "block"
length = "20 mm"
width = "20 mm"
height = "10 mm"
size = "20 mm"
mass = "4 g"
origin = ["-2.5 mm", 0, "4.330127 mm"]
rotation = [0, "-30 deg", 0]
"""
BAR = """
[bodies.box]
type = "round_bar"
radius = "10 mm"
length = "10 mm"
size = "10 mm"
mass = "4 g"
origin = ["-5 mm", 0, "8.660254 mm"]
rotation = [0, 0, "90 deg"]
"""
DYNAMIC = """
[mesh]
cells = "hexahedra"

[loads]
gravity = {{ direction = "-z", history_over_time = [[0, 0], [1e-4, 1], [0.04, 1]] }}

[obstacles.slope]
shape = "plane"
point = [0, 0, 0]
normal = [-0.5, 0, 0.8660254]
friction = {friction}
elastic_slip = "2 um"

[procedure]
type = "dynamic"
duration = "0.04 s"
first_step = "0.4 ms"
adaptive = false
spectral_radius = 0.0
"""
RESTING = """
[bodies.ball]
type = "ball"
radius = "8 mm"
size = "12 mm"
mass = "20 g"
origin = [0, 0, "18 mm"]

[bodies.cradle]
type = "block"
length = "20 mm"
width = "20 mm"
height = "10 mm"
size = "10 mm"
origin = [0, 0, "5 mm"]

[materials]
cradle = { law = "neo_hooke", C10 = "0.05 MPa", density = "1000 kg/m³" }

[supports]
ends_cradle = "xyz"

[contact]
friction = 0.5

[loads]
gravity = "-z"

[procedure]
type = "stabilized"
"""


def _solved(folder: Path, text: str) -> tg.Solution:
    file = folder / "loose.toml"
    file.write_text(text, encoding="utf-8")
    job = read_job(file)
    return tg.solve(prepare(job)[0], job.procedure)


def _way(solution: tg.Solution) -> float:
    down = np.array([-np.cos(SLOPE), 0, -np.sin(SLOPE)])
    return float(solution.states[-1].points["box"].displacement @ down)


@pytest.mark.parametrize("friction", [0.2, 0.7])
def test_a_block_slides_where_the_slope_is_steeper_than_friction(friction, tmp_path, record_verification):
    got = _way(_solved(tmp_path, BLOCK + DYNAMIC.format(friction=friction)))
    expected = max(0.0, 0.5 * G * (np.sin(SLOPE) - friction * np.cos(SLOPE)) * TIME**2)
    record_verification(
        claim=f"rigid block on a slope of 30° with friction {friction}: how far it slides in 40 ms [mm]",
        source="exact",
        expected=expected / mm,
        got=got / mm,
        tolerance="3 %, or 0.02 mm",
    )
    assert got == pytest.approx(expected, rel=0.03, abs=0.02 * mm)


def test_a_bar_rolls(tmp_path, record_verification):
    solution = _solved(tmp_path, BAR + DYNAMIC.format(friction=0.7))
    got, expected = _way(solution), G * np.sin(SLOPE) / 3 * TIME**2
    record_verification(
        claim="rigid bar that rolls down a slope of 30°: its way in 40 ms [mm]",
        source="exact, a = 2/3 g sin α",
        expected=expected / mm,
        got=got / mm,
        tolerance="3 %",
    )
    assert got == pytest.approx(expected, rel=0.03)
    turn = solution.states[-1].points["box"].rotation
    assert np.arctan2(turn[0, 2], turn[0, 0]) == pytest.approx(-got / (10 * mm), rel=0.03)


def test_a_ball_rests_on_a_soft_block_with_its_weight(tmp_path, record_verification):
    solution = _solved(tmp_path, RESTING)
    response = tg.measure(
        solution, tg.measures.contact_force("ball"), tg.measures.of_point("ball", "displacement", "z")
    )
    got = response.column("ball_contact_force")[-1]
    record_verification(
        claim="rigid ball of 20 g on a soft block: force of the contact [N]",
        source="exact, its weight",
        expected=0.020 * G,
        got=got,
        tolerance="0.1 %",
    )
    assert got == pytest.approx(0.020 * G, rel=1e-3)
    assert -1 * mm < response.column("ball_displacement_z")[-1] < 0  # it sinks in, and does not roll off
