"""The examples with contact run as they stand."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from turgor.units import N, mL

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.mark.slow
def test_two_fingers_press_on_a_bar_between_them(capsys):
    ran = runpy.run_path(str(EXAMPLES / "two_fingers.py"))
    response, mesh, state = ran["response"], ran["mesh"], ran["solution"].states[-1]
    squeeze = response.column("squeeze")
    assert squeeze[-1] / N == pytest.approx(0.105, rel=0.03)  # cells of 2 mm: 0.106
    assert np.all(squeeze[response.column("pressure") < 3.6e3] == 0)  # not yet touched
    # what one finger presses down, the mirror plane in the middle of the bar holds up
    middle = np.intersect1d(mesh.face_nodes("symmetry_z"), mesh.cells[mesh.region("body_bar")])
    assert 2 * state.nodal_force[middle, 2].sum() == pytest.approx(squeeze[-1], rel=1e-4)
    # the volume of both fingers, twins included
    assert response.column("cavity_volume")[0] / mL == pytest.approx(2 * 2 * 1.449, rel=1e-3)
    assert "Each finger presses with 0.10" in capsys.readouterr().out
