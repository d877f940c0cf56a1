"""The example jobs of actuators that work by vacuum solve: they get shorter, columns buckle, an origami tube twists."""

import numpy as np
import pytest
from run_example import run_example

from turgor.units import deg, mm


@pytest.mark.slow
def test_a_buckling_muscle_shortens_faster_once_its_columns_buckle() -> None:
    response = run_example("buckling_muscle")
    vacuum, way = -response.column("pressure"), -response.column("tip_displacement_x")
    assert way[-1] == pytest.approx(2.1 * mm, rel=0.05)
    slope = np.diff(way) / np.diff(vacuum)
    assert slope.max() > 2.5 * slope[0]


@pytest.mark.slow
def test_a_kresling_tube_twists_as_it_shortens() -> None:
    response = run_example("kresling_tube")
    assert response.column("tip_displacement_x")[-1] == pytest.approx(-1.87 * mm, rel=0.05)
    assert abs(response.column("twist_angle")[-1]) == pytest.approx(11.9 * deg, rel=0.05)


@pytest.mark.slow
def test_a_miura_tube_folds_along_its_length() -> None:
    response = run_example("miura_tube")
    assert response.column("tip_displacement_x")[-1] == pytest.approx(-2.5 * mm, rel=0.05)
    assert response.column("cavity_volume")[-1] < 0.9 * response.column("cavity_volume")[0]


@pytest.mark.slow
def test_a_yoshimura_bellows_shortens_without_a_twist() -> None:
    response = run_example("yoshimura_bellows")
    assert response.column("tip_displacement_x")[-1] == pytest.approx(-2.248 * mm, rel=0.01)  # sides of 2 mm
    volume = response.column("cavity_volume")
    assert volume[-1] / volume[0] == pytest.approx(0.916, abs=0.005)
