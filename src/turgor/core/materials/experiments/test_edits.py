"""Preparation of tests: each function returns a new test with a record of the edit."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from turgor.core.materials.experiments.cycles import half_cycles
from turgor.core.materials.experiments.material_test import Array, Edit, MaterialTest
from turgor.foundation.errors import TurgorError


def remove_slack(test: MaterialTest, stress: float, *, shift: bool = False) -> MaterialTest:
    """Count the stretch from the length at which the specimen is taut: where the stress first stays above a threshold.

    Earlier points are removed. The initial area stays as it was measured.

    Parameters
    ----------
    test : MaterialTest
        One loading curve.
    stress : float [Pa]
        Nominal stress at which the specimen counts as taut: the preload.
    shift : bool
        Whether to subtract the stress at that point too, so that the curve begins at zero.
    """
    load = _load(test)
    below = np.flatnonzero(load <= stress)
    if load.max() <= stress:
        raise TurgorError(f"test '{test.name}' never exceeds {stress:g} Pa; choose a smaller preload.")
    rising = np.flatnonzero(load > stress)
    # noise may lift a single point above the threshold: take the first point that is followed by more
    start = next((int(i) for i in rising if (load[i : i + 5] > stress).all()), len(load))
    if start == len(load):
        raise TurgorError(f"test '{test.name}' does not stay above {stress:g} Pa; choose a smaller preload.")
    if not len(below) or start == 0:
        return _note(test, f"No slack below {stress:g} Pa.")
    zero = float(test.stretch[start])
    offset = float(test.nominal_stress[start]) if shift else 0.0
    keep = np.arange(len(test.stretch)) >= start
    taut = test.keeping(keep, f"Slack below a preload of {stress:g} Pa")
    rest = f", less the stress {offset:g} Pa there" if shift else ""
    values = {**_counted_from(taut, zero), "nominal_stress": taut.nominal_stress - offset}
    return taut.changed(Edit(text=f"Stretch counted from the length at {zero:.5g}{rest}."), values)


def rest_below(test: MaterialTest, stress: float) -> MaterialTest:
    """Count the stretch of a cyclic test from the taut length, and set the stress below that length to zero.

    Cycles between grips may unload the specimen below the length at which it carries a load. That length is taken from
    the last loading curve, where the stress first stays above a threshold. Shorter lengths become stretch 1 without
    stress. These points stay, because time passes in them, but no fit uses them. A rubber that relaxes much more than
    silicone is slack before it is back at its initial length; the taut length is then found too large.

    Parameters
    ----------
    test : MaterialTest
        Points in the order of time.
    stress : float [Pa]
        Nominal stress at which the specimen counts as taut: the preload.

    Examples
    --------
    >>> stretch, pull = [1.0, 1.1, 1.5, 2.2, 1.5, 1.0], [-8e3, 1e3, 5e4, 1e5, 5e4, -8e3]
    >>> sheet = MaterialTest(mode="planar", stretch=stretch, nominal_stress=pull, name="a sheet")
    >>> rest_below(sheet, 500.0).stretch.round(3)
    array([1.   , 1.   , 1.364, 2.   , 1.364, 1.   ])
    """
    last = [half for half in half_cycles(test) if test.stretch[half][-1] >= test.stretch[half][0]][-1]
    taut = np.flatnonzero(test.nominal_stress[last] > stress)
    start = next((i for i in taut if (test.nominal_stress[last][i : i + 5] > stress).all()), None)
    if start is None:
        raise TurgorError(f"test '{test.name}' does not stay above {stress:g} Pa; choose a smaller preload.")
    zero = float(test.stretch[last][start])
    slack = test.stretch <= zero
    edit = Edit(
        text=f"Stretch counted from the length at {zero:.5g}, where the last cycle exceeds {stress:g} Pa; at rest "
        f"below it, {int(slack.sum())} of {len(slack)} points.",
        stretch=test.stretch[slack],
        nominal_stress=test.nominal_stress[slack],
    )
    values = {
        "stretch": np.where(slack, 1.0, test.stretch / zero),
        "nominal_stress": np.where(slack, 0.0, test.nominal_stress),
    }
    return test.changed(edit, values)


def set_zero_length(test: MaterialTest, stretch: float) -> MaterialTest:
    """Count the stretch from another length: all stretches are divided by a number.

    Parameters
    ----------
    test : MaterialTest
        The test.
    stretch : float [-]
        Stretch, as counted so far, that becomes 1.

    Examples
    --------
    >>> test = MaterialTest(mode="planar", stretch=[1.1, 2.2], nominal_stress=[0.0, 1e5], name="a sheet")
    >>> set_zero_length(test, 1.1).stretch
    array([1., 2.])
    """
    if not stretch > 0:
        raise TurgorError(f"stretch is {stretch:g}; the new zero of length must be more than 0.")
    edit = Edit(text=f"Stretch counted from the length at {stretch:.5g}.")
    return test.changed(edit, _counted_from(test, stretch))


def _counted_from(test: MaterialTest, zero: float) -> dict[str, object]:
    """Values of a test whose specimen had its length at another stretch."""
    old = test.specimen
    longer = None if old is None else replace(old, length=old.length * zero)
    crosshead = None if test.crosshead is None else test.crosshead / zero
    return {"stretch": test.stretch / zero, "crosshead": crosshead, "specimen": longer}


def remove_tail(test: MaterialTest, *, drop: float = 0.2) -> MaterialTest:
    """Remove the points after the specimen broke: all points after the peak, if the stress then falls.

    In compression, where the stress is negative, the magnitude of the stress counts.

    Parameters
    ----------
    test : MaterialTest
        One loading curve.
    drop : float [-]
        Share of the largest stress by which the stress falls at a break. A curve with a smaller fall stays as it is.
    """
    if not 0 < drop < 1:
        raise TurgorError(f"drop is {drop:g}; allowed is between 0 and 1.")
    load = _load(test)
    peak = int(np.argmax(load))
    if not load[peak] > 0 or load[peak:].min() > (1 - drop) * load[peak]:
        return _note(test, "No break: the stress does not fall after its peak.")
    keep = np.arange(len(test.stretch)) <= peak
    return test.keeping(keep, f"After the break at stretch {test.stretch[peak]:.4g}")


def crop(test: MaterialTest, low: float, high: float) -> MaterialTest:
    """Keep the points between two stretches.

    Parameters
    ----------
    test : MaterialTest
        The test.
    low, high : float [-]
        Smallest and largest stretch of the points that stay.
    """
    keep = (test.stretch >= low) & (test.stretch <= high)
    return _note(test, "Nothing to crop.") if keep.all() else test.keeping(keep, f"Outside stretch {low:g} to {high:g}")


def thin(test: MaterialTest, points: int = 60) -> MaterialTest:
    """Average a test over equal intervals of stretch, so that dense regions have no more weight than others.

    Parameters
    ----------
    test : MaterialTest
        One loading curve.
    points : int
        Number of intervals over the whole range; a test with fewer points stays as it is.

    Examples
    --------
    >>> stretch = np.concatenate([np.linspace(1.0, 1.1, 100), np.linspace(1.15, 2.0, 18)])
    >>> test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=1e5 * (stretch - 1), name="a strip")
    >>> len(thin(test, points=10).stretch)
    10
    """
    if points < 2:
        raise TurgorError(f"points is {points}; at least 2 are needed.")
    if len(test.stretch) <= points:
        return _note(test, f"Not thinned: {len(test.stretch)} points only.")
    if test.mode == "biaxial":
        raise TurgorError(f"test '{test.name}' is biaxial, a field of points; it cannot be thinned along a curve.")
    low, high = test.range
    bins = np.minimum(((test.stretch - low) / (high - low) * points).astype(int), points - 1)
    count = np.bincount(bins, minlength=points)
    filled = count > 0

    def mean(values: Array) -> Array:
        return np.bincount(bins, weights=values, minlength=points)[filled] / count[filled]

    edit = Edit(text=f"{len(test.stretch)} points averaged over {int(filled.sum())} equal intervals of stretch.")
    spread = None if test.spread is None else mean(test.spread)
    values = {
        "stretch": mean(test.stretch),
        "nominal_stress": mean(test.nominal_stress),
        "spread": spread,
        "time": None,
        "crosshead": None if test.crosshead is None else mean(test.crosshead),
    }
    return test.changed(edit, values)


def average(tests: Sequence[MaterialTest], *, points: int = 60, name: str = "") -> MaterialTest:
    """Average replicates at equal stretches, with their standard deviation as a band.

    The mean ends where the first specimen ends, because a mean over the remaining specimens would jump there.

    Parameters
    ----------
    tests : sequence of MaterialTest
        Loading curves of the same mode.
    points : int
        Number of points of the mean, equally spaced in stretch.
    name : str
        Name of the mean.
    """
    if len(tests) < 2:
        given = ", ".join(f"'{test.name}'" for test in tests) or "none"
        raise TurgorError(f"a mean needs 2 replicates or more; given: {given}.")
    modes = {test.mode for test in tests}
    if len(modes) > 1 or "biaxial" in modes:
        raise TurgorError(f"replicates of the modes {', '.join(sorted(modes))} have no mean; give tests of one mode.")
    for test in tests:
        if test.first_turn() is not None:
            raise TurgorError(f"test '{test.name}' turns round; choose a loading curve with select_cycle first.")
    low, high = max(test.range[0] for test in tests), min(test.range[1] for test in tests)
    if not low < high:
        raise TurgorError(f"the tests {', '.join(test.name for test in tests)} have no stretch in common.")
    grid = np.linspace(low, high, points)
    curves = []
    for test in tests:
        order = np.argsort(test.stretch, kind="stable")
        curves.append(np.interp(grid, test.stretch[order], test.nominal_stress[order]))
    beyond = [(test.stretch < low) | (test.stretch > high) for test in tests]
    edit = Edit(
        text=f"Mean of {len(tests)} replicates from stretch {low:.4g} to {high:.4g}, where all of them have points; "
        f"{sum(int(each.sum()) for each in beyond)} points outside removed.",
        stretch=np.concatenate([t.stretch[each] for t, each in zip(tests, beyond, strict=True)]),
        nominal_stress=np.concatenate([t.nominal_stress[each] for t, each in zip(tests, beyond, strict=True)]),
    )
    return MaterialTest(
        mode=tests[0].mode,
        stretch=grid,
        nominal_stress=np.mean(curves, axis=0),
        name=name or f"mean of {len(tests)}",
        source=tests[0].source,
        spread=np.std(curves, axis=0, ddof=1),
        raw=MaterialTest(
            mode=tests[0].mode,
            stretch=np.concatenate([test.stretch for test in tests]),
            nominal_stress=np.concatenate([test.nominal_stress for test in tests]),
            name="all replicates",
        ),
        edits=(*(each for test in tests for each in test.edits), edit),
    )


def _load(test: MaterialTest) -> Array:
    """Nominal stress in the direction of the test, (n,) [Pa]: positive in tension, and positive in compression too."""
    return test.nominal_stress if test.stretch[-1] >= test.stretch[0] else -test.nominal_stress


def _note(test: MaterialTest, text: str) -> MaterialTest:
    return test.changed(Edit(text=text), {})
