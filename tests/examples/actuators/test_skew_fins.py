"""The example job of a wedge: skew fins twist a tube, and a marker outside the modeled sector turns with its tip."""

import numpy as np
import pytest
from run_example import JOBS

import turgor as tg
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.units import deg, mm


def test_skew_fins_twist_a_tube_under_pressure() -> None:
    job = read_job(JOBS.parent / "skew_fins.toml")
    model, _ = prepare(job)
    assert model.mesh.wedge is not None
    dot = tg.measures.marker("dot", job.output.markers["dot"])
    result = tg.measure(tg.solve(model, job.procedure), tg.measures.twist_angle, *dot, mesh_error=False)
    twist = result.column("twist_angle")[-1]
    assert twist / deg == pytest.approx(0.62, rel=0.05)  # with cells of 1.4 mm
    assert result.column("dot_y")[0] == pytest.approx(0.0, abs=1e-6 * mm)
    assert result.column("dot_y")[-1] == pytest.approx(8 * mm * np.sin(twist), rel=0.1)  # 2 mm before the tip
