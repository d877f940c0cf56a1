"""Components: inputs that are vectors, such as a force or gravity, as one input for each component."""

from turgor.accuracy.gradients.model_keys import input_numbers, model_numbers, with_number
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError


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
