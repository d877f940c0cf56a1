"""Handling of tests: every point is used or shown as removed, and each step says what it did."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.cycles import half_cycles, select_cycle
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.test_edits import (
    average,
    crop,
    remove_slack,
    remove_tail,
    set_zero_length,
    thin,
)


def strip(stretch, stress=None, name="strip"):
    stretch = np.asarray(stretch, dtype=float)
    return MaterialTest(
        mode="uniaxial", stretch=stretch, nominal_stress=stretch - 1 if stress is None else stress, name=name
    )


def saw(peaks):
    """Load to each peak and back to 1, ten points each way."""
    parts = [part for peak in peaks for part in (np.linspace(1, peak, 11)[:-1], np.linspace(peak, 1, 11)[:-1])]
    return np.concatenate([*parts, [1.0]])


def count(test):
    return len(test.stretch) + sum(len(step.stretch) for step in test.edits)


def test_cycles_are_found_and_chosen():
    test = strip(saw([2.0, 2.0, 3.0]))
    assert len(half_cycles(test)) == 6
    last = select_cycle(test)
    assert last.range == (pytest.approx(1.0, abs=0.25), 3.0)
    assert (np.diff(last.stretch) > 0).all()
    assert select_cycle(test, 1).range[1] == 2.0
    down = select_cycle(test, 1, part="unloading")
    assert (np.diff(down.stretch) < 0).all()
    assert count(last) == len(test.stretch)
    assert last.raw is test
    assert "loading curve of cycle 3 of 3" in last.edits[-1].text
    with refused("strip", "3 loading curves", "number 4"):
        select_cycle(test, 4)
    with refused("part", "loadin", "loading"):
        select_cycle(test, part="loadin")


def test_cycles_are_counted_from_one_as_on_the_command_line():
    test = strip(saw([1.5, 2.0, 3.0]))
    assert [select_cycle(test, number).range[1] for number in (1, 2, 3)] == [1.5, 2.0, 3.0]
    assert [select_cycle(test, -number).range[1] for number in (1, 2, 3)] == [3.0, 2.0, 1.5]
    assert "cycle 1 of 3" in select_cycle(test, -3).edits[-1].text
    with refused("cycle is 0", "'strip'", 1, -1):
        select_cycle(test, 0)


def test_loading_in_compression_is_away_from_the_undeformed_state():
    stretch = np.concatenate([np.linspace(1, 0.5, 11), np.linspace(0.55, 1, 10), np.linspace(0.9, 0.4, 6)])
    test = strip(stretch, stretch - stretch**-2)
    assert select_cycle(test, 1).range == (0.5, 1.0)
    assert (np.diff(select_cycle(test, 2).stretch) < 0).all()
    assert (np.diff(select_cycle(test, 1, part="unloading").stretch) > 0).all()


def test_noise_is_no_cycle():
    stretch = np.linspace(1, 3, 201) + np.random.default_rng(0).normal(0, 0.02, 201)
    assert len(half_cycles(strip(stretch))) == 1


def test_slack_is_removed_and_length_counted_anew():
    stretch = np.linspace(1.0, 2.2, 121)
    test = strip(stretch, np.maximum(stretch - 1.1, 0.0) * 1e5)
    taut = remove_slack(test, 500.0)
    assert taut.stretch[0] == 1.0
    assert taut.range[1] == pytest.approx(2.2 / 1.11, rel=1e-6)
    assert taut.nominal_stress[0] == pytest.approx(1000.0)
    assert remove_slack(test, 500.0, shift=True).nominal_stress[0] == 0.0
    assert count(taut) == len(stretch)
    assert "Slack below a preload of 500 Pa: 11 points of 121 removed" in taut.edits[0].text
    with refused("strip", "1e+07 Pa"):
        remove_slack(test, 1e7)


def test_one_noisy_point_does_not_make_it_taut():
    stress = np.zeros(100)
    stress[20] = 1.0
    stress[50:] = np.arange(50) + 1.0
    taut = remove_slack(strip(np.linspace(1, 2, 100), stress), 0.5)
    assert len(taut.stretch) == 50
    assert taut.nominal_stress[0] == 1.0  # the point of index 50, not the noisy one


def test_no_slack_is_said():
    assert "No slack" in remove_slack(strip([1.0, 1.5, 2.0], [0.2, 0.5, 1.0]), 0.1).edits[-1].text


def test_tail_after_a_break_goes_and_a_whole_curve_stays():
    broken = strip([1, 2, 3, 4, 5], [0.0, 1.0, 2.0, 0.1, -0.1])
    kept = remove_tail(broken)
    assert list(kept.stretch) == [1, 2, 3]
    assert count(kept) == 5
    whole = strip([1, 2, 3, 4], [0.0, 1.0, 2.0, 1.9])
    assert len(remove_tail(whole).stretch) == 4
    assert "No break" in remove_tail(whole).edits[-1].text
    with refused("drop", 2, "0 and 1"):
        remove_tail(whole, drop=2)


def test_compression_is_no_break():
    """A test from 1 down to 0.5 has its largest stress at its beginning, which was once taken for a break there."""
    stretch = np.linspace(1.0, 0.5, 26)
    stress = 2e4 * (stretch - stretch**-2)
    whole = remove_tail(strip(stretch, stress))
    assert len(whole.stretch) == 26
    assert "No break" in whole.edits[-1].text
    crushed = remove_tail(strip([*stretch, 0.48, 0.46], [*stress, -1e3, -0.5e3]))
    assert crushed.range == (0.5, 1.0)
    taut = remove_slack(strip(stretch, np.minimum(stress + 5e3, 0.0)), 100.0)
    assert taut.stretch[0] == 1.0
    assert len(taut.stretch) < 26


def test_a_test_from_compression_to_tension_is_no_break():
    stretch = np.linspace(0.4, 1.5, 30)
    assert len(remove_tail(strip(stretch, stretch - stretch**-2)).stretch) == 30
    assert len(remove_tail(strip(stretch[::-1], (stretch - stretch**-2)[::-1])).stretch) == 30


def test_thinning_is_even_in_stretch():
    """A thousand points below 1.1 must not outweigh ten above: both regions get points by their width."""
    stretch = np.concatenate([np.linspace(1.0, 1.1, 1000), np.linspace(1.12, 3.0, 95)])
    thinned = thin(strip(stretch), 20)
    assert len(thinned.stretch) == 20
    assert np.diff(thinned.stretch) == pytest.approx(np.full(19, 0.1), abs=0.04)
    assert thinned.nominal_stress == pytest.approx(thinned.stretch - 1)
    assert "1095 points averaged over 20" in thinned.edits[-1].text
    assert "Not thinned" in thin(strip([1, 2, 3]), 20).edits[-1].text
    with refused("points", 1, "at least 2"):
        thin(strip([1, 2]), 1)


def test_average_has_the_band_of_the_replicates():
    stretch = np.linspace(1, 3, 50)
    replicates = [
        strip(stretch[: 50 - 5 * i], slope * (stretch[: 50 - 5 * i] - 1)) for i, slope in enumerate((1, 2, 3))
    ]
    mean = average(replicates, points=21)
    assert mean.range[1] == pytest.approx(stretch[39])
    assert mean.nominal_stress == pytest.approx(2 * (mean.stretch - 1))
    assert mean.spread == pytest.approx(mean.stretch - 1)
    assert "3 replicates" in mean.edits[-1].text
    assert "15 points outside removed" in mean.edits[-1].text
    with refused("2 replicates", "'strip'"):
        average(replicates[:1])
    with refused("strip, strip", "stretch"):
        average([strip([1, 2]), strip([3, 4])])
    with refused("strip", "select_cycle"):
        average([strip([1, 2, 1, 3]), strip([1, 2])])


def test_crop_and_zero_length():
    test = strip([1, 2, 3, 4])
    assert list(crop(test, 1.5, 3.5).stretch) == [2, 3]
    assert "Nothing to crop" in crop(test, 0.5, 5).edits[-1].text
    with refused("strip", "3.5 to 5", "one point", 4):
        crop(test, 3.5, 5)
    assert list(set_zero_length(test, 2.0).stretch) == [0.5, 1, 1.5, 2]
    with refused("stretch", 0, "more than 0"):
        set_zero_length(test, 0.0)
