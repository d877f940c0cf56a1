"""Compliance of a rig: what load cell and frame give way is no displacement of the actuator."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from turgor.core.materials.experiments.machine import Machine
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response


def without_compliance(response: Response, machine: Machine, compared: Iterable[str] = ()) -> Response:
    """Return a measurement whose displacement is that of the actuator, without what the rig gave way.

    The rig gives way towards the force, so that its crosshead moves farther than the actuator: the displacement loses
    the compliance times the force, in the sign in which both grow together.

    Parameters
    ----------
    response : Response
        With a displacement and a force.
    machine : Machine
    compared : iterable of str
        Columns that drive or are compared: where there are several displacements or forces, these are meant.

    Returns
    -------
    Response

    Raises
    ------
    TurgorError
        If it is not clear which displacement or force is meant, or the rig would have moved more than the whole.

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> columns = Column("way", "mm", [0, 1e-3, 2e-3]), Column("force", "N", [0, 5, 10])
    >>> pull = Response(columns=columns, source=Source(text="a test"))
    >>> (1e3 * without_compliance(pull, Machine(compliance="0.04 mm/N"))["way"]).round(6)
    array([0. , 0.8, 1.6])
    """
    named = tuple(compared)
    way, force = (_only(response, unit, what, named) for unit, what in (("m", "displacement"), ("N", "force")))
    length, pull = response.column(way), response.column(force)
    given = machine.compliance * pull * np.sign(np.nansum((length - length[0]) * (pull - pull[0])) or 1.0)
    if np.ptp(given) >= np.ptp(length):
        raise TurgorError(
            f"a compliance of {machine.text} makes {1e3 * np.ptp(given):.3g} mm in {response.source}, more than the "
            f"whole of '{way}', {1e3 * np.ptp(length):.3g} mm; check its unit."
        )
    columns = tuple(
        replace(column, values=column.values - given) if column.name == way else column for column in response.columns
    )
    return replace(response, columns=columns)


def _only(response: Response, unit: str, what: str, named: tuple[str, ...]) -> str:
    """Name of the column of a kind: that which is compared, or the only one."""
    known = [column.name for column in response.columns if column.si_unit == unit]
    chosen = [name for name in known if name in named] or known
    if len(chosen) != 1:
        there = f"it has {', '.join(known)}; name one as x or y" if known else "it has none"
        raise TurgorError(f"the compliance of a rig needs one {what} in {response.source}; {there}.")
    return chosen[0]
