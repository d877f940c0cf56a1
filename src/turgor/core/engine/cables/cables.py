"""Cables of a model: their terms, and what they do in a state."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cables.cable_term import CableTerm, lay_cable
from turgor.core.engine.cables.tendon_term import TendonTerm
from turgor.core.engine.cables.wire_term import WireTerm
from turgor.core.engine.term import Setting
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def cable_terms(setting: Setting) -> list[CableTerm]:
    """One for each tendon and each wire."""
    mesh, length, force = setting.model.mesh, setting.length, setting.stress * setting.length**2
    out: list[CableTerm] = []
    for loads in by_cable(setting.model).values():
        load = loads[-1]
        laid = lay_cable(mesh, setting.points, length, load)
        if load.heated:
            out.append(WireTerm(load=load, laid=laid, heating=tuple(loads), unit=force))
        else:
            out.append(TendonTerm.of(loads, laid, length, force))
    return out


def terms_of(model: Model) -> list[CableTerm]:
    """The terms of the cables of a model in SI units."""
    if not any(load.cable is not None for load in model.loads):
        return []
    points = model.mesh.points
    return cable_terms(Setting(model, points, np.zeros(points.shape, dtype=bool), np.empty((0, 0)), 1.0, 1.0))


def by_cable(model: Model) -> Mapping[tuple[str, str], list[Any]]:
    """Loads on each cable, by their kind and place.

    Parameters
    ----------
    model : Model

    Raises
    ------
    TurgorError
        If two loads on a cable contradict each other.
    """
    cables: dict[tuple[str, str], list[Any]] = {}
    for load in model.loads:
        if load.cable is None:
            continue
        cables.setdefault((load.kind, load.place), []).append(load)
    for loads in cables.values():
        for load in loads[1:]:
            if not load.of_same(loads[0]):
                raise TurgorError(f"{load.label} is stated twice with different numbers; {load.alone}")
    return cables
