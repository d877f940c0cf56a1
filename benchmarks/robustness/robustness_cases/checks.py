"""Independent checks of the end of a path: none uses what it checks."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

import turgor as tg
from benchmarks.robustness.robustness_cases.case import KPA, OPTIONS, Check, Found, limited
from turgor.core.engine.fields import strain_energy
from turgor.core.materials.laws.stability import first_instability
from turgor.core.solvers.pressures import pressures_of


def read(solution: tg.Solution, *measures: tg.measures.Measure) -> list[np.ndarray]:
    """Columns of a path."""
    response = tg.measure(solution, *measures, mesh_error=False)
    return [response.column(each.name) for each in measures]


def value(what: str, got: float, expected: float, tolerance: float, unit: str = "") -> Found:
    """Compare with a known number, relative to it."""
    off = got / expected - 1
    return Found(abs(off) <= tolerance, f"{what} {got:.5g}{unit}, expected {expected:.5g} ({off:+.2%})")


def both(*checks: Check) -> Check:
    """Several checks in a row."""

    def check(solution: tg.Solution) -> Found:
        results = [each(solution) for each in checks]
        open_ = any(each.agrees is None for each in results)
        agrees = None if open_ and all(each.agrees is not False for each in results) else all(e.agrees for e in results)
        return Found(agrees, "; ".join(each.text for each in results))

    return check


def small_steps(count: int = 20, tolerance: float = 2e-3) -> Check:
    """The same end by many equal steps, from the last state each and by Newton's plain method.

    It is solved more precisely than what is checked: beside a stiff film a state whose residual is just small enough
    may be so far off that plain Newton's method finds no way on, and comes to another end.
    """

    def check(solution: tg.Solution) -> Found:
        step = 1 / count
        slow = tg.Static(first_step=step, max_step=step, min_step=min(1e-4, step), tolerance=1e-8)
        plain = replace(OPTIONS, iteration="plain")
        end, _ = limited(solution.model, slow, options=plain)
        if end.status is tg.Status.INTERRUPTED:
            return Found(None, f"{count} plain steps came to {end.states[-1].load_factor:.3g} in their time")
        if not end.converged:
            return Found(False, f"{count} plain steps came to load factor {end.states[-1].load_factor:.4g} only")
        u, v = solution.states[-1].displacement, end.states[-1].displacement
        off = float(np.linalg.norm(u - v) / np.linalg.norm(v))
        return Found(off <= tolerance, f"{off:.1e} from the end of {count} plain steps")

    return check


def energy(tolerance: float = 0.01) -> Check:
    """The work of the pressures along the path is the strain energy stored at its end."""

    def check(solution: tg.Solution) -> Found:
        model = solution.model
        factors = np.array([state.load_factor for state in solution.states])
        work = 0.0
        for face in model.mesh.cavities:
            (volume,) = read(solution, tg.measures.volume_of(face))
            pressure = np.array([pressures_of(state).get(face, 0.0) for state in solution.states])
            if not pressure.any():
                continue
            along = factors if (np.diff(factors) > 0).all() else np.arange(len(factors))
            p, v = CubicSpline(along, pressure), CubicSpline(along, volume)
            fine = np.linspace(along[0], along[-1], 2001)
            work += float(np.trapezoid(p(fine) * v(fine, 1), fine))
        last = solution.states[-1]
        stored = model.mesh.symmetry_factor * strain_energy(model, last.displacement, last.mean_stress)
        return value("work of the pressure", work * 1e3, stored * 1e3, tolerance, " mJ")

    return check


def rises(measure: tg.measures.Measure, scale: float = 1.0, unit: str = "") -> Check:
    """A measure grows from state to state."""

    def check(solution: tg.Solution) -> Found:
        (got,) = read(solution, measure)
        return Found(bool((np.diff(got) > 0).all()), f"{measure.name} rises to {got[-1] * scale:.4g}{unit}")

    return check


def back_to_rest(solution: tg.Solution) -> Found:
    """Nothing is left where no load acts any more."""
    largest = max(float(np.abs(state.displacement).max()) for state in solution.states)
    left = float(np.abs(solution.states[-1].displacement).max())
    return Found(left <= 1e-4 * largest, f"{left / largest:.0e} of the largest displacement is left")


def limit_at(pressure: float, below: float = 0.003, above: float = 0.001) -> Check:
    """The path stopped at a known limit pressure, and the advice names procedures that go on."""

    def check(solution: tg.Solution) -> Found:
        got = solution.states[-1].load_factor * solution.model.pressures[0].pressure
        result = value("stopped at", got / KPA, pressure / KPA, 1.0, " kPa")
        right = (1 - below) * pressure <= got <= (1 + above) * pressure
        return Found(right and "VolumeControl" in solution.advice, result.text)

    return check


def at_end(
    what: str, got: Callable[[tg.solutions.State], float], expected: float, tolerance: float, unit: str = ""
) -> Check:
    """A number of the last state against a known one."""
    return lambda solution: value(what, got(solution.states[-1]), expected, tolerance, unit)


def stable(solution: tg.Solution) -> Found:
    """No state of the path is unstable."""
    count = sum(bool(state.unstable_modes) for state in solution.states)
    return Found(not count, f"{count} unstable states")


def not_through(solution: tg.Solution) -> Found:
    """No wall has gone deeper into another than the tolerance allows."""
    deepest = max((touch.share for state in solution.states for touch in state.touches.values()), default=0.0)
    area = max((touch.area for touch in solution.states[-1].touches.values()), default=0.0)
    return Found(deepest <= 1.05, f"{deepest:.2f} of the penetration allowed, {area * 1e6:.3g} mm² touch")


def limit_of_volume_control(volume: float, tolerance: float = 5e-3) -> Check:
    """The load stopped at the maximum that the same model has when its volume drives."""

    def check(solution: tg.Solution) -> Found:
        model = solution.model
        free = tg.Model(model.mesh, model.materials, model.supports, [], contact=model.contact)
        path = limited(free, tg.VolumeControl(volume=volume))[0]
        maxima = [limit.pressure for limit in path.limit_points if limit.kind == "maximum"]
        if not maxima:
            return Found(False, f"volume control found no maximum: {path.message}")
        return limit_at(maxima[0], tolerance, tolerance)(solution)

    return check


def small_gas(ambient: float, outside: float, tolerance: float = 2e-3) -> Check:
    """The gas in the cavity obeys Boyle's law."""

    def check(solution: tg.Solution) -> Found:
        (volume,) = read(solution, tg.cavity_volume)
        expected = ambient * volume[0] / volume[-1] - outside
        got = pressures_of(solution.states[-1])["cavity"]
        return value("gauge pressure", got / KPA, expected / KPA, tolerance, " kPa")

    return check


def law_gives_way(law: Any) -> Check:
    """Rubber has been stretched to where its own law has no stable states any more (Drucker), in some mode."""
    modes = ("uniaxial", "equibiaxial", "planar")
    results = [first_instability(law, mode, criterion="drucker", lower=0.999) for mode in modes]
    first = min((stretch for stretch in results if stretch), default=np.inf)

    def check(solution: tg.Solution) -> Found:
        largest = tg.measures.maximum_principal_stretch(solution.states[-1])
        return Found(largest >= 0.95 * first, f"stretch {largest:.3g}; the law gives way at {first:.3g}")

    return check
