"""Steps of .inp files: one for each requested load factor of each stage."""

from collections.abc import Sequence
from itertools import pairwise

from turgor.core.inp.context import Context
from turgor.core.inp.reference_points import InpDeck
from turgor.core.inp.tracks import amplitude_lines, stated_lines, statements
from turgor.core.model.loads.load import DeckRows, Load
from turgor.core.model.model import Model
from turgor.core.model.supports import Support
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: CalculiX accepts a step at a residual of 0.5 % by default; its result was then 0.5 % off in the comparison with
#: turgor.
CALCULIX_TOLERANCE = 1e-6


def history_lines(
    context: Context, procedure: Procedure, acting: Sequence[Sequence[DeckRows]]
) -> tuple[list[str], list[str]]:
    """Write the amplitudes and the steps of a model.

    Parameters
    ----------
    context : Context
    procedure : Procedure
        One, or stages.
    acting : sequence of sequence of DeckRows
        What acts and moves in each stage.

    Returns
    -------
    amplitudes, steps : list of str
    """
    ends = [0.0]
    for part in procedure.parts():
        ends.append(ends[-1] + _time(part))
    stages = statements(acting, list(pairwise(ends)))
    amplitudes, names = amplitude_lines(stages)
    labels = [stage.name for stage in procedure.stages] or [""]
    steps = list[str]()
    for label, part, stage in zip(labels, procedure.parts(), stages, strict=True):
        try:
            steps += _stage(context, label, part, list(stated_lines(stage, names)))
        except TurgorError as error:
            raise TurgorError(f"stage '{label}': {error}" if label else str(error)) from None
    return amplitudes, steps


def _stage(context: Context, label: str, part: Procedure, stated: list[str]) -> list[str]:
    """The steps of one stage, of which the first states what changes."""
    relaxes = any(material.viscoelasticity is not None for material in context.model.region_materials.values())
    kind = part.deck_step(context.program, relaxes)
    what = f"stages.{label}" if label else "procedure"
    (context.approximated if kind.differs else context.written)(what, f"{kind.keyword}{kind.differs}")
    lines = [f"** stage {label}"] if label else []
    ends = [1.0] if part.finds_load else sorted({*part.at, 1.0})
    for start, end in pairwise([0.0, *ends]):
        length = (end - start) * _time(part)
        lines += ["*STEP, NLGEOM=YES, INC=1000" if context.for_abaqus else "*STEP, NLGEOM, INC=1000"]
        if not context.for_abaqus:
            lines += ["*CONTROLS, PARAMETERS=FIELD", f"{CALCULIX_TOLERANCE:g}, {CALCULIX_TOLERANCE:g}"]
        lines.append(kind.keyword)
        first, most = min(kind.first, length / 20), min(kind.most, length / 10)
        lines.append(f"{first:.12g}, {length:.12g}, {length * 1e-5:.3g}, {most:.12g}{kind.more}")
        lines += stated
        lines += ["*NODE FILE, FREQUENCY=1000", "U", "*EL FILE, FREQUENCY=1000", "S"]
        lines += ["*NODE PRINT, NSET=Nall, FREQUENCY=1000", "U", "*END STEP"]
        stated = []
    return lines


def _time(part: Procedure) -> float:
    """Length of a procedure in the time of the file: seconds, or the load factor."""
    return 1.0 if part.duration is None else part.duration


def acting_rows(model: Model, deck: InpDeck) -> list[DeckRows]:
    """Displacements and loads of a model."""
    acting: list[Load | Support] = [*model.loads, *model.supports]
    every = [rows for each in acting for rows in each.deck_rows(deck) if rows.rows]
    return list(dict.fromkeys(every))  # the states of all bodies are one temperature


def damping_lines(procedure: Procedure, program: str) -> list[str]:
    """Write Rayleigh's damping of a material; nothing without any."""
    kinds = {part.deck_step(program, False).damping for part in procedure.parts() if part.has_inertia}
    if len(kinds) > 1:
        raise TurgorError("stages have different damping, and a material has one in .inp files; give them the same.")
    mass, stiffness = kinds.pop() if kinds else (0.0, 0.0)
    return [f"*DAMPING, ALPHA={mass:.12g}, BETA={stiffness:.12g}"] if mass or stiffness else []


def velocity_lines(procedure: Procedure, program: str) -> list[str]:
    """Write the velocity of the whole body at the start; nothing where it is at rest."""
    first = procedure.parts()[0]
    velocity = first.deck_step(program, False).velocity if first.has_inertia else (0.0, 0.0, 0.0)
    rows = [f"Nall, {axis}, {part / mm:.12g}" for axis, part in enumerate(velocity, start=1) if part]
    return ["*INITIAL CONDITIONS, TYPE=VELOCITY", *rows] if rows else []
