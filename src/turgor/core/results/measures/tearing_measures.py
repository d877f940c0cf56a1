"""Measures of tearing: shares of what materials bear, cracking energy, tearing energy of a flaw, and life."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.checks.tearing.cracking import Cracking, cracking_along
from turgor.core.solvers.checks.tearing.uses import STRESS, STRETCH, uses
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Decimal logarithm of the largest number of cycles that is counted: 30,000 years at one in each second.
LONGEST_LIFE = 12


def _share(quantity: str, what: str, at: StateFields) -> float:
    """Largest share of all parts; zero or less where nothing is stretched."""
    each_use = uses(at.model, at.displacement, lambda: at.cells, at.state.load_factor)
    shares = [each.share for each in each_use if each.quantity == quantity]
    if not shares:
        raise TurgorError(f"no material states its {what}; give one a strength, such as tg.laws.Strength({what}=…).")
    return max(shares)


def _along(value: Callable[[Cracking], float], path: Sequence[StateFields]) -> Array:
    """Read a number of the cracks at each state of a path, which is evaluated once for all measures."""
    if not path:
        return np.empty(0)
    key = ("cracking", *(id(at.state.displacement) for at in path))
    cracks = path[0].facts.once(key, lambda: tuple(cracking_along([at.state for at in path])))
    return np.array([value(each) for each in cracks])


def _of_flaw(value: Callable[[Cracking], float], path: Sequence[StateFields]) -> Array:
    if path and all(each.crack_growth is None for each in path[0].model.region_materials.values()):
        raise TurgorError("no material of a region states its crack_growth, such as tg.laws.CrackGrowth(...).")
    return _along(value, path)


def _log_cycles(path: Sequence[StateFields]) -> Array:
    """A logarithm, since meshes and batches differ by factors; between one cycle and more than anyone will wait for."""
    cycles = _of_flaw(lambda each: each.cycles[1], path)
    return np.asarray(np.log10(np.clip(cycles, 1.0, 10.0**LONGEST_LIFE)))


def _of_path(at: StateFields) -> float:
    raise TurgorError("it is a sum along a path.")


break_share = Measure(
    name="break_share", unit="", function=partial(_share, STRETCH, "elongation_at_break"),
    definition="stretch that 99 % of a region, sheet or thread stay below, less 1, over the elongation at break of its "
    "material; the largest of all that state one",
    local=True,
)  # fmt: skip
strength_share = Measure(
    name="strength_share", unit="", function=partial(_share, STRESS, "tensile_strength"),
    definition="nominal stress that 99 % of a region, sheet or thread stay below over the tensile strength of its "
    "material; the largest of all that state one",
    local=True,
)  # fmt: skip
cracking_energy_p99 = Measure(
    name="cracking_energy_p99", unit="kPa", function=_of_path, along=partial(_along, lambda each: each.energy),
    definition="energy density along the path, in kJ/m³, that opens small cracks across the largest stretch; 99 % of "
    "the volume of the solid stay below",
    local=True,
)  # fmt: skip
tearing_energy = Measure(
    name="tearing_energy", unit="N/m", function=_of_path, along=partial(_of_flaw, lambda each: each.tearing),
    definition="tearing energy, in J/m², of the first flaw in the region that tears first; 99 % of its volume stay "
    "below",
    local=True,
)  # fmt: skip
log_cycles_to_tear = Measure(
    name="log_cycles_to_tear", unit="", function=_of_path, along=_log_cycles,
    definition="decimal logarithm of the number of cycles from rest to this state and back until the first flaw of the "
    f"rubber tears through a region; {LONGEST_LIFE} where it does not grow",
    local=True,
)  # fmt: skip
