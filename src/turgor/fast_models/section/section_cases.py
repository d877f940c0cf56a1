"""Questions: the rows that a section is solved for, checked and scaled."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.section.equations import Equations, Question
from turgor.fast_models.section.stiffness import FORCE_NAMES, STRAIN_NAMES, scales
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]

#: What a table of loads holds for each name: one value, or one for each row.
Rows = Mapping[str, float | Sequence[float] | Array]


def questions_of(
    equations: Equations, pressure: float | Sequence[float] | Array | Rows, volume: Rows, strains: Rows, forces: Rows
) -> list[Question]:
    """Scaled questions, one for each row; what they are made of is described in `turgor.Section.solve`.

    Raises
    ------
    TurgorError
        If a name is unknown, a strain has a force too, or the numbers of rows differ.
    """
    cavities = tuple(equations.cavities)
    _check_names("cavity", volume, cavities)
    given = _pressures_of(pressure, cavities, volume)
    _check_names("strain of a section", strains, STRAIN_NAMES)
    _check_names("force on a section", forces, FORCE_NAMES)
    _check_strains(equations, strains, forces)
    columns = _as_rows({"pressure": 0.0} if not given else {}, given, volume, strains, forces)
    rows = range(len(next(iter(columns.values()))))
    return [_question(equations, {name: float(values[row]) for name, values in columns.items()}) for row in rows]


def _question(equations: Equations, value: Mapping[str, float]) -> Question:
    """Scale the values of a row; what is not in it is free, or zero."""
    force, strain = scales(equations)
    strains = [value.get(f"strain {name}", np.nan) / scale for name, scale in zip(STRAIN_NAMES, strain, strict=True)]
    for i in equations.numbers.fixed:
        strains[i] = 0.0
    acting = [value.get(f"force {name}", 0.0) / scale for name, scale in zip(FORCE_NAMES, force, strict=True)]
    pressures = [value.get(f"pressure {name}", 0.0) / equations.stress for name in equations.cavities]
    volumes = [value.get(f"volume {name}", np.nan) / equations.area for name in equations.cavities]
    return Question(
        pressures=np.array(pressures), volumes=np.array(volumes), strains=np.array(strains), forces=np.array(acting)
    )


def _check_strains(equations: Equations, strains: Rows, forces: Rows) -> None:
    """Refuse a strain with a force of its own, and one that a mirror plane keeps at zero."""
    for name, other in zip(STRAIN_NAMES, FORCE_NAMES, strict=True):
        if name in strains and other in forces:
            raise TurgorError(f"{name} is prescribed, and {other} is given; a section takes one of both.")
    fixed = {STRAIN_NAMES[i] for i in equations.numbers.fixed}
    blocked = [
        n for n, f in zip(STRAIN_NAMES, FORCE_NAMES, strict=True) if n in fixed and (n in strains or f in forces)
    ]
    if blocked:
        raise TurgorError(
            f"{blocked[0]} is zero in a section that a mirror plane cuts; model the whole one (symmetric = false)."
        )


def _check_names(kind: str, given: Mapping[str, object], known: Sequence[str]) -> None:
    for name in given:
        if name not in known:
            raise unknown(kind, name, known)


def _pressures_of(
    pressure: float | Sequence[float] | Array | Rows, cavities: Sequence[str], volume: Rows
) -> dict[str, float | Sequence[float] | Array]:
    """Pressures of the cavities whose volume is free."""
    if not isinstance(pressure, Mapping):
        if np.any(pressure) and volume:
            raise TurgorError(
                f"a pressure is given for all cavities and a volume for {', '.join(volume)}; give pressures by name."
            )
        return {name: pressure for name in cavities if name not in volume}
    _check_names("cavity", pressure, cavities)
    for name in pressure:
        if name in volume:
            raise TurgorError(f"{name} has a pressure and a volume; a cavity takes one of both.")
    return dict(pressure)


def _as_rows(least: Rows, pressure: Rows, volume: Rows, strains: Rows, forces: Rows) -> dict[str, Array]:
    """Columns of equal length."""
    named = dict(least) | {f"pressure {n}": v for n, v in pressure.items()}
    named |= {f"volume {n}": v for n, v in volume.items()}
    named |= {f"strain {n}": v for n, v in strains.items()} | {f"force {n}": v for n, v in forces.items()}
    columns = {name: np.atleast_1d(np.asarray(values, dtype=np.float64)) for name, values in named.items()}
    count = max(len(values) for values in columns.values())
    for name, values in columns.items():
        if values.ndim != 1 or len(values) not in (1, count) or not np.isfinite(values).all():
            raise TurgorError(f"{name} has {values.size} values, others {count}; give one finite value for each row.")
    return {name: np.broadcast_to(values, count) for name, values in columns.items()}
