"""Step options: the steps and iterations of every procedure of equilibria."""

from collections.abc import Iterable, Mapping
from dataclasses import Field, dataclass, fields
from math import inf
from numbers import Integral
from types import NoneType
from typing import Any, get_args, get_origin

from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import number, one


@dataclass(frozen=True, slots=True, kw_only=True)
class StepOptions(Procedure):
    """Steps along a path and the iterations in each; procedures extend it and change the defaults.

    Parameters
    ----------
    first_step, max_step, min_step : float [-]
        First, largest and smallest increment of the load factor, in (0, 1].
    at : tuple of float [-]
        Load factors that must be hit exactly besides 1, each in (0, 1].
    tolerance : float [-]
        Largest residual force relative to the applied and reaction forces.
    max_iterations : int
        Newton iterations before a step is cut back.
    max_steps : int
        Attempted steps before the solve stops.
    """

    first_step: float = 0.05
    max_step: float = 0.25
    min_step: float = 1e-4
    at: tuple[float, ...] = ()
    tolerance: float = 1e-6
    max_iterations: int = 15
    max_steps: int = 1000

    def __post_init__(self) -> None:
        check_steps(self)


def make_numbers(procedure: Any) -> None:
    """Make floats of the numbers of a procedure, which may be given as texts with a unit, and refuse what is none.

    Parameters
    ----------
    procedure : dataclass
        Its fields say by their types and metadata what they hold.
    """
    for item in fields(procedure):
        kinds = get_args(item.type) or (item.type,)
        value, what = getattr(procedure, item.name), f"procedure.{item.name}"
        dimension = item.metadata.get("dimension", "").replace("number", "")
        if (value is None and NoneType in kinds) or not {float, int} & set(kinds):
            continue
        if get_origin(item.type) is tuple:
            given = value if isinstance(value, Iterable) and not isinstance(value, str) else (value,)
            checked: Any = tuple(number(each, what, dimension, finite=False) for each in given)
        elif isinstance(value, Mapping):
            checked = {key: number(each, f"{what}.{key}", dimension, finite=False) for key, each in value.items()}
        elif int in kinds:
            checked = one(value, Integral, what, "a whole number is needed")
        else:
            checked = number(value, what, dimension, finite=False)
        object.__setattr__(procedure, item.name, checked)


def check_steps(steps: StepOptions, longest: float = 1.0) -> None:
    """Refuse steps, tolerances, numbers of iterations and a duration that make no sense.

    Raises
    ------
    TurgorError
        Naming the field, its value and what is allowed; ``longest`` is the largest step allowed.
    """
    make_numbers(steps)
    if steps.duration is not None and not 0 < steps.duration < inf:
        raise TurgorError(f"procedure.duration is {steps.duration:g} s; it must be more than 0.")
    for name, upper in (("first_step", 1.0), ("max_step", longest), ("min_step", 1.0)):
        value = getattr(steps, name)
        if not 0 < value <= upper:
            raise TurgorError(f"procedure.{name} is {value:g}; allowed is more than 0 up to {upper:g}.")
    if steps.min_step > steps.first_step:
        raise TurgorError(
            f"procedure.min_step is {steps.min_step:g}; it must not exceed first_step, {steps.first_step:g}."
        )
    if not 1e-12 <= steps.tolerance <= 1e-2:
        raise TurgorError(f"procedure.tolerance is {steps.tolerance:g}; allowed is 1e-12 to 0.01.")
    for name in ("max_iterations", "max_steps"):
        if getattr(steps, name) < 1:
            raise TurgorError(f"procedure.{name} is {getattr(steps, name)}; allowed is 1 or more.")
    for factor in steps.at:
        if not 0 < factor <= 1:
            raise TurgorError(f"procedure.at holds {factor:g}; a load factor lies in (0, 1].")


def fields_in_order(kind: type) -> tuple[Field[Any], ...]:
    """Return the fields of a procedure for people to read: what it asks, its steps, its duration, what extends it.

    Parameters
    ----------
    kind : type
        The class of a procedure.

    Returns
    -------
    tuple of Field

    Examples
    --------
    >>> from turgor.core.solvers.procedures.auto import Auto
    >>> [each.name for each in fields_in_order(Auto)][:3]
    ['past', 'max_stretch', 'first_step']
    """
    steps = {each.name for each in fields(StepOptions)}
    options = [each for each in kind.__mro__ if issubclass(each, StepOptions) and "__dataclass_fields__" in vars(each)]
    if len(options) < 2:
        return fields(kind)
    own = {each.name for each in fields(options[-2])} - steps - {"duration"}

    def place(each: Field[Any]) -> int:
        if each.name in own:
            return 0
        return 1 if each.name in steps else 2 if each.name == "duration" else 3

    return tuple(sorted(fields(kind), key=place))
