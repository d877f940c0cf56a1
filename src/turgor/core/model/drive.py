"""Drive: which pressures act at a load factor, as numbers and in words."""

from collections.abc import Iterable
from operator import itemgetter

from turgor.core.model.history import RAMP, peak_of, share_at, turns_of
from turgor.core.model.loads import Load, Pressure, pressures_among
from turgor.core.model.model import Model
from turgor.units import kPa


def common_pressure(loads: Iterable[Load]) -> Pressure | None:
    """Return the first pressure where all faces under pressure share its value and history; None otherwise.

    Parameters
    ----------
    loads : iterable of Load

    Returns
    -------
    Pressure or None
    """
    pressures = pressures_among(loads)
    different = {(load.pressure, load.history) for load in pressures}
    return pressures[0] if len(different) == 1 else None


def pressures_at(model: Model, load_factor: float) -> dict[str, float]:
    """Return the gauge pressure on every pressed face and in every cavity at a load factor [Pa].

    Parameters
    ----------
    model : Model
    load_factor : float

    Returns
    -------
    dict of str to float [Pa]
        Cavities first, in the order of the mesh; zero in a cavity without load.
    """
    pressures = dict.fromkeys(model.mesh.cavities, 0.0)
    for load in model.pressures:
        pressures[load.face] = pressures.get(load.face, 0.0) + load.at(load_factor)
    return pressures


def kinks(model: Model) -> tuple[float, ...]:
    """Return the load factors between 0 and 1 at which a history or the path of an obstacle has a point, rising.

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of float
    """
    turns = {factor for load in model.loads for factor in turns_of(load.history)}
    turns |= {factor for each in model.supports if each.way is not None for factor in turns_of(each.way)}
    turns |= {factor for obstacle in model.contact.obstacles for factor in obstacle.stops if 0 < factor < 1}
    return tuple(sorted(turns))


def extremes(model: Model) -> tuple[float, ...]:
    """Return the load factors at which loads may have extrema: the kinks, the peaks of expressions, and 1.

    Also 0, where a load acts there already. Of a history that all loads share its highest and lowest point suffice.

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of float
    """
    histories = {load.history for load in model.loads}
    only = next(iter(histories)) if len(histories) == 1 else ""
    if not isinstance(only, str):  # a measured history has thousands of points
        ends = (min(only, key=itemgetter(1)), max(only, key=itemgetter(1)))
        return tuple(sorted({*(factor for factor, share in ends if factor or share), 1.0}))
    peaks = {peak_of(history) for history in histories if isinstance(history, str)}
    first = {0.0} if any(share_at(history, 0.0) for history in histories) else set()
    return tuple(sorted({*first, *kinks(model), *peaks, 1.0}))


def pressed_together(model: Model) -> tuple[str, ...]:
    """Name the cavities whose pressure is at some load below that of another one, or below zero, and the stated ones.

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of str
        In the order of the mesh; their walls may be pressed together.
    """
    own = model.contact.self_contact
    cavities = set() if own is None else set(own.cavities or ())
    for factor in extremes(model):
        pressures = {name: p for name, p in pressures_at(model, factor).items() if name in model.mesh.cavities}
        cavities |= {name for name, pressure in pressures.items() if pressure < max(0.0, *pressures.values())}
    return tuple(name for name in model.mesh.cavities if name in cavities)


def drive_text(model: Model, load_factor: float, digits: int = 4) -> str:
    """Write the pressures at a load factor for a person: ``"20 kPa"``, or each with its face where they differ.

    Parameters
    ----------
    model : Model
    load_factor : float
    digits : int
        Significant digits.

    Returns
    -------
    str
        Empty where no pressure acts.
    """
    common = common_pressure(model.loads)
    if common is not None:
        return f"{common.at(load_factor) / kPa:.{digits}g} kPa"
    if not model.pressures:
        return ""
    return ", ".join(f"{face} {p / kPa:.{digits}g} kPa" for face, p in pressures_at(model, load_factor).items())


def rises(load: Pressure) -> bool:
    """Whether a pressure grows in proportion to the load factor.

    Examples
    --------
    >>> rises(Pressure("cavity", 1e3)), rises(Pressure("cavity", 1e3, history=[(0, 0), (0.5, 1), (1, 0)]))
    (True, False)
    """
    return load.history == RAMP
