"""Fit Bergström and Boyce's network, a permanent set, or both to tests with time; stress softening too."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from turgor.core.materials.experiments.cycles import half_cycles
from turgor.core.materials.experiments.material_test import Array, MaterialTest
from turgor.core.materials.fitting.histories.history_fit import HistoryFit, quality_of
from turgor.core.materials.fitting.histories.history_points import HistoryPart
from turgor.core.materials.fitting.settings import DETERMINATION, FLOW_FIT, HISTORY_FIT
from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins, softening
from turgor.core.materials.laws.conventions import scaled_law
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source


@dataclass(frozen=True, slots=True)
class _Search:
    """Nonlinear search over the logarithms of all parameters, but 1/r as it is.

    Parameters
    ----------
    law : Law
    parts : list of HistoryPart
    bounds : dict of str to (float, float)
        Smallest and largest value of each parameter.
    stress : float [Pa]
        Reference stress of the network that flows: the largest Cauchy stress of the tests.
    """

    law: Law
    parts: list[HistoryPart]
    bounds: dict[str, tuple[float, float]]
    stress: float

    def box(self) -> tuple[Array, Array]:
        rows = np.array(list(self.bounds.values()))
        return np.log(rows[:, 0]), np.log(rows[:, 1])

    def values(self, x: Array) -> dict[str, float]:
        return dict(zip(self.bounds, np.exp(x).tolist(), strict=True))

    def material(self, x: Array) -> Material:
        values = self.values(x)
        network = plastic = mullins = None
        if "rate" in values:
            network = BergstromBoyce(
                stiffness=values["stiffness"], rate=values["rate"], stress=self.stress, exponent=values["exponent"]
            )
        if "set_stress" in values:
            plastic = PermanentSet(stress=values["set_stress"], exponent=values["set_exponent"])
        if "r" in values:
            mullins = Mullins(r=values["r"], m=values["m"])
        law = scaled_law(self.law, values["scale"])
        return Material(
            name="fitted rubber", law=law, viscoelasticity=network, stress_softening=mullins, permanent_set=plastic
        )

    def residual(self, x: Array) -> Array:
        material = self.material(x)
        off = np.concatenate([part.pulls(material) - part.measured for part in self.parts])
        return np.nan_to_num(off, nan=FLOW_FIT.refused, posinf=FLOW_FIT.refused, neginf=-FLOW_FIT.refused)


def fit_flow(
    law: Law,
    tests: MaterialTest | Sequence[MaterialTest],
    *,
    rate_dependence: bool = False,
    permanent_set: bool = False,
    stress_softening: bool = False,
    starts: int = FLOW_FIT.starts,
) -> HistoryFit:
    """Fit Bergström and Boyce's network, a permanent set, or both to tests with time; the law's form stays as it is.

    The residual of each test is divided by its largest stress. A factor multiplies the law, which becomes that of an
    infinitely slow first loading. The creep strain keeps its usual power −1 and offset 0.01.

    Parameters
    ----------
    law : Law
        Law that was fitted to first loading curves.
    tests : MaterialTest or sequence of MaterialTest
        Tests with time, in uniaxial, equibiaxial or planar mode: at several rates, with holds or cycles.
    rate_dependence : bool
        Whether to fit the network: ``stiffness``, ``rate`` and ``exponent``.
    permanent_set : bool
        Whether to fit the set, ``set_stress`` and ``set_exponent``; this needs unloading.
    stress_softening : bool
        Whether to fit r and m too; this needs cycles.
    starts : int
        Number of starts of the search.

    Returns
    -------
    HistoryFit

    Raises
    ------
    TurgorError
        If nothing is to be fitted, or a test has no time or another mode.

    Examples
    --------
    >>> from turgor.core.materials.history.stress_history import stress_history
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(
    ...     name="r", law=NeoHooke(C10=1e5), permanent_set=PermanentSet(stress=4e6, exponent=1.0)
    ... )
    >>> t = np.linspace(0.0, 2.0, 21)
    >>> pull = stress_history(rubber, "uniaxial", t, 2.0 - np.abs(1.0 - t))
    >>> test = MaterialTest(
    ...     mode="uniaxial", stretch=pull.stretch, nominal_stress=pull.nominal_stress, time=t, name="cycle"
    ... )
    >>> fitted = fit_flow(NeoHooke(C10=0.9e5), test, permanent_set=True, starts=1)
    >>> round(fitted.values["set_stress"] / 1e6, 2), round(fitted.values["set_exponent"], 2)
    (4.0, 1.0)
    """
    from scipy.optimize import least_squares

    tests = [tests] if isinstance(tests, MaterialTest) else list(tests)
    if not tests:
        raise TurgorError("no test was given; fit_flow needs at least one test with time.")
    if not (rate_dependence or permanent_set):
        raise TurgorError(
            "rate_dependence and permanent_set are False; there is nothing to fit. Give one of them, or take "
            "fit_history for stress_softening alone."
        )
    parts = [HistoryPart(law, test, _points(test)) for test in tests]
    search = _search(law, parts, rate_dependence, permanent_set, stress_softening)
    low, high = search.box()
    random = np.random.default_rng(0)
    begin = [low + (high - low) * share for share in (0.5, *random.uniform(0.2, 0.8, (starts - 1, len(low))))]
    solver = partial(least_squares, search.residual, bounds=(low, high), ftol=FLOW_FIT.tolerance, x_scale="jac")
    best = min((solver(each, xtol=FLOW_FIT.tolerance) for each in begin), key=lambda each: float(each.cost))
    return _result(search, best.x, best.jac, tests)


def _points(test: MaterialTest) -> int:
    """How many points of a test: enough of them between two turns that steps in time are short."""
    turns = len(list(half_cycles(test)))
    return int(np.clip(FLOW_FIT.between_turns * turns, FLOW_FIT.between_turns * 2, HISTORY_FIT.points))


def _search(law: Law, parts: list[HistoryPart], rates: bool, sets: bool, softens: bool) -> _Search:
    """The search with its bounds, which follow from the tests."""
    top = max(float((part.loaded_test.stretch * part.loaded_test.nominal_stress).max()) for part in parts)
    bounds = {"scale": FLOW_FIT.scale}
    if rates:
        steps = np.concatenate([np.diff(part.time) for part in parts])
        longest = max(float(np.ptp(part.time)) for part in parts)
        least, most = FLOW_FIT.strain
        bounds |= {
            "stiffness": FLOW_FIT.stiffness,
            "rate": (least / longest, most / float(np.median(steps[steps > 0]))),
        }
        bounds |= {"exponent": FLOW_FIT.exponent}
    if sets:
        bounds |= {"set_stress": (FLOW_FIT.set_stress[0] * top, FLOW_FIT.set_stress[1] * top)}
        bounds |= {"set_exponent": FLOW_FIT.set_exponent}
    if softens:
        energy = max(float(part.energy.max()) for part in parts)
        r, m = HISTORY_FIT.inverse_r, HISTORY_FIT.m
        bounds |= {"r": (1 / r[1], 1 / r[0]), "m": (m[0] * energy, m[1] * energy)}
    return _Search(law, parts, bounds, top)


def _result(search: _Search, x: Array, jacobian: Array, tests: Sequence[MaterialTest]) -> HistoryFit:
    material, values, (low, high) = search.material(x), search.values(x), search.box()
    stretches = np.concatenate([test.stretch for test in tests])
    off = search.residual(x)
    variance = float(off @ off) / max(1, len(off) - len(x))
    share = np.sqrt(np.diagonal(variance * np.linalg.pinv(jacobian.T @ jacobian)))
    at_bound = np.minimum(x - low, high - x) < 1e-3
    names, mullins = np.array(list(values)), material.stress_softening
    top = max(float(part.energy.max()) for part in search.parts) * values["scale"]
    material = Material(
        name=material.name,
        law=material.law,
        stretch_range=(min(1.0, float(stretches.min())), float(stretches.max())),
        source=Source(text=f"fitted to {', '.join(test.name for test in tests)}"),
        viscoelasticity=material.viscoelasticity,
        stress_softening=mullins,
        permanent_set=material.permanent_set,
    )
    return HistoryFit(
        material=material,
        values=values,
        errors={name: 0.0 if end else values[name] * s for name, s, end in zip(values, share, at_bound, strict=True)},
        bounds_hit=tuple(f"{name} is limited by the search at {values[name]:.4g}" for name in names[at_bound]),
        undetermined=tuple(names[~at_bound & (share > DETERMINATION.large_error)].tolist()),
        largest_softening=0.0 if mullins is None else 1.0 - float(softening(mullins, 0.0, top)[0]),
        quality=quality_of(material, tests),
    )
