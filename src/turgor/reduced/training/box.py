"""Box: the inputs of a reduced model with their ranges, and where training paths lead in these."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from turgor.accuracy.gradients.model_keys import input_numbers, model_numbers, model_variation, with_number
from turgor.core.model.drive import pressed_together
from turgor.core.model.history import RAMP
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.inputs import Inputs

Array = NDArray[np.float64]


def inputs_of(model: Model, ranges: Mapping[str, tuple[float, float]]) -> Inputs:
    """Check the ranges of the inputs of a model.

    Parameters
    ----------
    model : Model
    ranges : mapping of str to (float, float)

    Returns
    -------
    Inputs
    """
    if not ranges:
        raise TurgorError("a reduced model needs an input, such as 'loads.pressure' with its range.")
    ranges = {single: limits for key, limits in ranges.items() for single in components_of(model, key)}
    variation = model_variation(model, list(ranges), inputs=True)
    for key in ranges:
        if not key.startswith(("loads.", "obstacles.")):
            raise TurgorError(
                f"the input '{key}' is no load; inputs of a reduced model are loads, such as 'loads.pressure', and "
                "places of obstacles."
            )
    for load in model.loads:
        if load.of_bodies:
            raise TurgorError(
                f"reduced models have no states of bodies, and {load.label} is one; their equations are those of "
                "bodies that are at rest in the shape of the mesh."
            )
        if load.history != RAMP:
            raise TurgorError(f"reduced models have no histories of loads; {load.label} has one.")
    low, high = np.array(list(ranges.values()), dtype=np.float64).T
    box = Inputs(tuple(ranges), low, high, tuple(variation.units.get(key, "") for key in ranges))
    for place in np.flatnonzero(~(low < high)).tolist():
        begin, end = box.shown(place, low[place]), box.shown(place, high[place])
        raise TurgorError(f"the range of '{box.keys[place]}' is {begin} to {end}; its end must exceed its beginning.")
    return box


def components_of(model: Model, key: str) -> list[str]:
    """Keys of the components of a vector, without those that a symmetric model cannot have; else the key itself."""
    known = model_numbers(model) | input_numbers(model)
    every = [f"{key}.{axis}" for axis in (1, 2, 3)]
    if key in known or any(each not in known for each in every):
        return [key]
    possible = [each for each in every if _may_be(model, each)]
    return possible or every


def _may_be(model: Model, key: str) -> bool:
    """Whether a component may have any value."""
    try:
        with_number(model, key, 1.0)
    except TurgorError:
        return False
    return True


def with_all_cavities(model: Model, box: Inputs) -> Model:
    """Return the model whose walls may touch in all cavities that some inputs press together.

    By default those are found from the pressures of one model; a reduced model has the same parts at all inputs.
    """
    own = model.contact.self_contact
    if own is None or own.cavities is not None:
        return model
    at = model_variation(model, list(box.keys), inputs=True).model
    ends = product(*zip(box.low.tolist(), box.high.tolist(), strict=True))
    every = {name for values in ends for name in pressed_together(at(dict(zip(box.keys, values, strict=True))))}
    cavities = tuple(name for name in model.mesh.cavities if name in every)
    return replace(model, contact=model.contact.with_cavities(cavities))


def aims_of(box: Inputs, shares: Sequence[Sequence[float]]) -> list[Array]:
    """Inputs at shares of the ranges."""
    for each in shares:
        if len(each) != len(box.keys) or not 0 <= min(each) <= max(each) <= 1:
            raise TurgorError(
                f"an aim of training is {tuple(each)}; {len(box.keys)} numbers from 0 to 1 are needed, one for each "
                "input."
            )
    return [box.at_shares(np.asarray(each)) for each in shares]


def random_shares(n: int, seed: int, count: int) -> Array:
    """Shares (count, n) of ranges that cover the box evenly."""
    power = int(np.ceil(np.log2(max(count, 1))))
    return np.asarray(qmc.Sobol(n, seed=seed).random_base2(power))[:count]


def corners(box: Inputs) -> list[Array]:
    """Corners of the box of inputs but the one at rest, the one with the largest values first.

    More than three inputs have too many corners. Then it is a balanced part of these (Plackett and Burman 1946, doi
    10.1093/biomet/33.4.305), where every two inputs have all combinations of their ends, and the first ones, too.
    """
    n = len(box.keys)
    bits = n if n <= 3 else n.bit_length()
    columns = sorted(range(1, 2**bits), key=lambda c: (c.bit_count() > 1, c.bit_count() % 2 == 0, c))[:n]
    shares = np.array([[1.0 - (row & column).bit_count() % 2 for column in columns] for row in range(2**bits)])
    values = box.at_shares(shares)
    loads = ~box.places
    return [value for value in values if not loads.any() or np.abs(value[loads]).max() > 0]


def one_path(box: Inputs) -> bool:
    """Whether one path passes all inputs: those of one load."""
    return len(box.keys) == 1 and not box.places.any()
