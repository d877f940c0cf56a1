"""Building: the geometry of a job, once for all screens that ask for it."""

from collections.abc import Hashable, Mapping
from functools import lru_cache, partial
from typing import Any

from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.geometry import Geometry
from turgor.job.job import MESHED
from turgor.job.tables.sections import read_actuator
from turgor.job.text.problems import Problems


def built(table: Mapping[str, Any], problems: Problems) -> Geometry | None:
    """Return the geometry of a table ``[actuator]``; None where it is wrong, which is noted."""
    actuator = read_actuator(table, problems)
    if actuator is None:
        return None
    if isinstance(actuator, (CadFile, *MESHED)) or not isinstance(actuator, Hashable):
        return problems.attempt(("actuator",), actuator.build)
    return problems.attempt(("actuator",), partial(_of_family, actuator))


@lru_cache(maxsize=8)
def _of_family(actuator: Any) -> Geometry:
    """Build a family once: the screens of the page ask for it one after another."""
    shape: Geometry = actuator.build()
    return shape
