"""Synthetic tests from known constants give these back, for every law; with noise, within the stated errors."""

import numpy as np
import pytest

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.law_specs import law_spec

KNOWN = {
    "neo-hooke": [0.12e6],
    "mooney-rivlin": [0.10e6, 0.02e6],
    "yeoh-2": [0.11e6, 0.02e6],
    "yeoh": [12.7e3, 423.0, 1.46],
    "yeoh-4": [20e3, -300.0, 8.0, 0.2],
    "rivlin-2": [80e3, 20e3, 2e3, 300.0, 100.0],
    "gent": [0.1e6, 60.0],
    "arruda-boyce": [0.1e6, 3.0],
    "extended-tube": [0.1e6, 0.15e6, 0.08, 0.3],
    "ogden-1": [50e3, 3.0],
    "ogden-2": [-8e3, 200e3, -2.5, 1.6],
    "ogden-3": [-0.01e6, 0.63e6, 0.0012e6, -2.0, 1.3, 5.0],
}
NOISE = 0.01
REPEATS = 8


def law_of(name):
    spec, values = law_spec(name), KNOWN[name]
    count = len(spec.coefficients)
    return spec.make(values[:count], values[count:])


def synthetic(name, random=None):
    """Three modes, 40 points each; noise of the same size everywhere."""
    exact = []
    for mode, upto in (("uniaxial", 5.0), ("equibiaxial", 3.5), ("planar", 4.0)):
        stretch = np.linspace(1.05, upto, 40)
        blank = MaterialTest(mode=mode, stretch=stretch, nominal_stress=stretch, name=mode)
        exact.append(blank.predicted(law_of(name)))
    size = NOISE * max(np.abs(stress).max() for stress in exact) if random is not None else 0.0
    results = []
    for (mode, upto), stress in zip((("uniaxial", 5.0), ("equibiaxial", 3.5), ("planar", 4.0)), exact, strict=True):
        noise = random.normal(0.0, size, len(stress)) if random is not None else 0.0
        stretch = np.linspace(1.05, upto, 40)
        results.append(MaterialTest(mode=mode, stretch=stretch, nominal_stress=stress + noise, name=mode))
    return results


@pytest.mark.parametrize("name", KNOWN)
def test_exact_data_return_the_constants(name):
    result = fit(name, synthetic(name))
    assert list(result.values.values()) == pytest.approx(KNOWN[name], rel=1e-8)
    assert result.bounds_hit == ()
    assert result.relative < 1e-8


@pytest.mark.parametrize("name", KNOWN)
def test_noisy_data_return_them_within_the_stated_error(name):
    """Eight draws: every constant within 3.5 standard errors, and the errors neither boasted nor hidden."""
    deviations = []
    for seed in range(REPEATS):
        result = fit(name, synthetic(name, np.random.default_rng(seed)), weights="absolute", starts=8)
        off = np.array(list(result.values.values())) - KNOWN[name]
        deviations.append(off / np.array(list(result.errors.values())))
    assert np.abs(deviations).max() < 3.5
    assert 0.4 < np.sqrt(np.mean(np.square(deviations))) < 1.6
