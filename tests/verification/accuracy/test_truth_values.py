"""Default meshes give angle, extension, twist and volume within 2 % of values that two discretizations confirm.

Problem: loaded actuators of the truth set (`benchmarks/truth/truth_cases`), meshed without a size: a fast PneuNet on a
base 20 times as stiff, a slow one, cylinders with a skin around hoops and helices, a tube with a helix of one hand, a
closed tube. Without a size these families get hexahedra.
Reference: `benchmarks/truth/truth_values.json`, graded hexahedra or NGSolve with elements of third order
(docs/truth.md).
Tolerance: 2 %, what a default mesh promises; 2.5 % for the tip of a bender, whose bending angle is promised. The
formulation "continuous" misses it on the stiff base, where its mean stress cannot jump: this shows that the test can
fail.
"""

import json
import sys
from pathlib import Path

import pytest

import problems
import turgor as tg

ROOT = Path(__file__).parents[3]
sys.path.append(str(ROOT))

from benchmarks.truth.truth_cases import CASES  # noqa: E402

VALUES = json.loads((ROOT / "benchmarks" / "truth" / "truth_values.json").read_text("utf-8"))
FAST = ("fast_pneunet_stiff_base", "slow_pneunet", "held_cylinder", "wound_cylinder", "twisting_tube", "closed_tube")
STIFF_BASE = FAST[0]
#: Cases whose two discretizations agree within 0.3 % in every measure; a star marks the others in docs/truth.md.
AGREED = (
    "fast_pneunet_paper",
    "slow_pneunet",
    "held_cylinder",
    "wound_cylinder",
    "wound_bender",
    "twisting_tube",
    "closed_tube",
    "tube_between_plates",
    "omnidirectional_circles",
    "omnidirectional_sectors",
    "bellows",
    "revolute_joint",
)


def _errors(name, formulation="mixed", cells=None):
    case = next(case for case in CASES if case.name == name)
    solution = problems.solve(case.model(tg.mesh(case.actuator.build(), cells=cells), formulation))
    response = tg.measure(solution, *case.measures, mesh_error=False)
    got = {each.name: float(response.find(each.name).in_unit[-1]) for each in case.measures}
    return case, got, {key: got[key] / truth - 1 for key, truth in VALUES[name]["value"].items()}


@pytest.mark.parametrize("name", FAST)
def test_default_mesh_is_within_two_percent(name, record_verification):
    case, got, errors = _errors(name)
    units = ", ".join(f"{each.name.replace('_', ' ')} [{each.unit}]" for each in case.measures)
    record_verification(
        claim=f"{case.title}, default mesh: {units}",
        source="truth set (docs/truth.md)",
        expected=[VALUES[name]["value"][each.name] for each in case.measures],
        got=[got[each.name] for each in case.measures],
        tolerance="2 %",
    )
    beside = errors.pop("tip_displacement", 0.0)  # shown beside the bending angle, not promised
    assert errors == pytest.approx(dict.fromkeys(errors, 0.0), abs=0.02)
    assert abs(beside) < 0.025


def test_a_mean_stress_that_cannot_jump_misses():
    _, _, errors = _errors(STIFF_BASE, "continuous", "tetrahedra")
    assert errors["bending_angle"] > 0.1


@pytest.mark.parametrize("name", AGREED)
def test_both_discretizations_agree(name):
    """The stored values of the truth set agree within 0.3 %; without that they are no reference for an error of 2 %."""
    first, second = (each["values"] for each in VALUES[name]["witnesses"])
    assert second == pytest.approx(first, rel=0.003)
