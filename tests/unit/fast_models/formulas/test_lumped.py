"""Lumped dynamics: what was put in comes out, with honest uncertainties."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.fast_models.formulas import identify_step, identify_sweep
from turgor.fast_models.formulas.lumped import step_shape
from turgor.foundation.response import Column

DRIVE = 20e3


def record(t, x):
    return tg.Response(
        columns=(Column("time", "s", t), Column("bending_angle", "deg", x)), source=tg.laws.Source(text="a camera")
    )


@pytest.mark.parametrize("damping", [0.02, 0.3, 0.99, 1.0, 1.01, 3.0])
def test_step_solves_the_equation_of_motion(damping):
    f, h = 3.0, 1e-4
    t = np.linspace(0.01, 1.0, 50)
    w = 2 * np.pi * f
    ahead, here, behind = (step_shape(t + d, f, damping) for d in (h, 0.0, -h))
    left = (ahead - 2 * here + behind) / h**2 + 2 * damping * w * (ahead - behind) / (2 * h) + w**2 * (here - 1)
    assert np.abs(left).max() < 1e-3 * w**2
    assert step_shape(np.array([0.0]), f, damping)[0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("frequency", "damping"), [(4.0, 0.02), (1.3, 0.2), (6.0, 0.8), (2.0, 2.0)])
def test_exact_steps_are_identified(frequency, damping):
    t = np.linspace(-0.2, 3.0, 400)
    result = identify_step(record(t, 0.1 + 0.4 * step_shape(t, frequency, damping)), "bending_angle", drive=DRIVE)
    assert result.natural_frequency == pytest.approx(frequency, rel=1e-6)
    assert result.damping_ratio == pytest.approx(damping, rel=1e-6)
    assert result.gain * DRIVE == pytest.approx(0.4, rel=1e-6)
    assert result.offset == pytest.approx(0.1, rel=1e-6)
    assert result.findings == ()
    m, c, k = result.mass, result.damping, result.stiffness
    assert np.sqrt(k / m) / (2 * np.pi) == pytest.approx(frequency, rel=1e-6)
    assert c / (2 * np.sqrt(k * m)) == pytest.approx(damping, rel=1e-6)
    again = result.step(t, DRIVE, measure=Column("bending_angle", "deg", [0.0]))
    assert again["bending_angle"] == pytest.approx(0.1 + 0.4 * step_shape(t, frequency, damping), abs=1e-7)


def test_a_delay_is_found():
    t = np.linspace(0, 3.0, 600)
    result = identify_step(record(t, step_shape(t - 0.05, 3.0, 0.2)), "bending_angle", delayed=True)
    assert result.delay == pytest.approx(0.05, abs=2e-3)
    assert result.natural_frequency == pytest.approx(3.0, rel=2e-3)


def test_uncertainties_cover_the_truth():
    """Of 60 noisy records, about two thirds lie within one standard deviation, and nearly all within three."""
    t, rng, off = np.linspace(0, 2.0, 300), np.random.default_rng(3), []
    for _ in range(60):
        noisy = step_shape(t, 4.0, 0.1) + rng.normal(0, 0.01, len(t))
        result = identify_step(record(t, noisy), "bending_angle")
        off.append((result.natural_frequency - 4.0) / result.natural_frequency_uncertainty)
        assert result.natural_frequency_uncertainty < 0.01
    within = [float((np.abs(off) < n).mean()) for n in (1, 3)]
    assert 0.5 < within[0] < 0.85
    assert within[1] > 0.95


@pytest.mark.parametrize("known", [True, False])
def test_a_sweep_with_and_without_phase(known):
    f = np.linspace(0.5, 8.0, 60)
    moved = 0.02 / (1 - (f / 3.5) ** 2 + 2j * 0.15 * f / 3.5)
    result = identify_sweep(f, moved if known else np.abs(moved), drive=2.0)
    assert result.natural_frequency == pytest.approx(3.5, rel=1e-6)
    assert result.damping_ratio == pytest.approx(0.15, rel=1e-6)
    assert result.gain == pytest.approx(0.01, rel=1e-6)


def test_other_motions_are_named():
    t = np.linspace(0, 3.0, 400)
    two = step_shape(t, 3.0, 0.05) + 0.4 * step_shape(t, 7.0, 0.05)
    (finding,) = identify_step(record(t, two), "bending_angle").findings
    assert finding.code == "F07"
    f = np.linspace(0.5, 8, 50)
    flat = np.ones(50) + 0.5 * (f > 4)
    assert identify_sweep(f, flat).findings[0].code == "F07"


def test_records_that_say_nothing_are_refused():
    t = np.linspace(0, 1, 20)
    for x, fact in ((np.zeros(20), "0 to 0"), (np.full(20, np.nan), "nan")):
        with refused("'bending_angle'", fact):
            identify_step(record(t, x), "bending_angle")
    with refused(5, "eight rows"):
        identify_step(record(t[:5], t[:5]), "bending_angle")
    with refused("times", "1 to 0 s"):
        identify_step(record(t[::-1], t), "bending_angle")
    with refused("amplitude", 0, "drive", 2):
        identify_sweep(np.arange(1.0, 7.0), np.zeros(6), drive=2.0)
    with refused("2 frequencies", "2 amplitudes", "five"):
        identify_sweep([1.0, 2.0], [1.0, 1.0])
