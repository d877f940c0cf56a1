"""Findings about membranes: where compression makes them wrinkle as the mesh does, not as the sheet (N05)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.membrane_term import bending_energy, least_tension
from turgor.core.engine.fields import strain_energy
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.drive import drive_text
from turgor.core.model.model import Model
from turgor.core.model.points import RIGID
from turgor.core.model.sheets import Membrane, Shell
from turgor.core.solvers.checks.settings import CAUSES, REPORTS
from turgor.core.solvers.solution import State
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Compression:
    """How a membrane is compressed in a state: its smaller principal force per width, and the area of each point.

    Parameters
    ----------
    force : (n,) array [N/m]
        Negative in compression.
    area : (n,) array [m²]
    wrinkling_force : float [N/m]
        Compression from which it wrinkles on this mesh.
    """

    force: Array
    area: Array
    wrinkling_force: float

    @classmethod
    def of(cls, state: State, name: str) -> "Compression":
        """Find the compression of the membrane on a face.

        A membrane on a soft solid wrinkles, in the shortest waves that the mesh has, where the force per width exceeds
        2 μ / k: the stiffness of a half space against waves of the number k = π over an edge.
        """
        force, area = least_tension(state.model, name, state.displacement, state.load_factor)
        edge = float(np.sqrt(area.sum() / len(area)))
        return cls(force=force.ravel(), area=area.ravel(), wrinkling_force=2 * softest(state.model) * edge / np.pi)

    def share(self, beyond: float) -> float:
        """Share of the area that is compressed by more than a force per width."""
        return float(self.area[self.force < -beyond].sum() / self.area.sum())

    @property
    def wrinkled(self) -> float:
        """Share of the area that wrinkles on this mesh."""
        return self.share(self.wrinkling_force)

    @property
    def largest(self) -> float:
        """Largest compressive force per width."""
        return max(0.0, -float(self.force.min()))

    @property
    def mean(self) -> float:
        """Compressive force per width, averaged over the area."""
        return float((self.area * np.maximum(-self.force, 0.0)).sum() / self.area.sum())


def bears_compression(model: Model) -> list[str]:
    """Return the faces of membranes that bear compression, and deform: not those that move rigidly with a point."""
    rigid = {point.face for point in model.points.values() if point.coupling == RIGID}
    bearing = {name for name, sheet in model.membranes.items() if isinstance(sheet, Membrane) and not sheet.wrinkles}
    return [name for name in model.membranes if name in bearing - rigid]


def compressed_membranes(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Return N05 for every membrane that bears compression and is compressed on the path, with what a shell would do.

    Parameters
    ----------
    model : Model
    states : sequence of State
    """
    findings = []
    for name in bears_compression(model):
        path = [Compression.of(state, name) for state in states]
        little = CAUSES.little_compression * max((float(np.abs(each.force).max()) for each in path), default=0.0)
        shares = [each.share(little) for each in path]
        if max(shares, default=0.0) > REPORTS.notable_share:
            worst = int(np.argmax([each.mean for each in path]))
            first = next(i for i, share in enumerate(shares) if share > REPORTS.notable_share)
            since = f" (from {_load(model, states[first])} on)" if first != worst else ""
            where = f"in {100 * shares[worst]:.0f} % of its area at {_load(model, states[worst])}{since}"
            findings.append(_compressed(model, name, where, path[worst], states[worst]))
    return tuple(findings)


def _load(model: Model, state: State) -> str:
    return drive_text(model, state.load_factor, 3) or f"load factor {state.load_factor:.3g}"


def _compressed(model: Model, name: str, where: str, pushed: Compression, state: State) -> Finding:
    wrinkles, bent = pushed.wrinkled > REPORTS.notable_share, _bending_share(model, name, state)
    what = "so that it wrinkles" if wrinkles else "and wrinkles on finer meshes"
    counts = bent is not None and bent > REPORTS.notable_share
    return Finding(
        code="N05",
        severity=Severity.WARNING if wrinkles or counts else Severity.NOTE,
        message=f"The membrane on '{name}' is compressed {where}, by up to {pushed.largest:.3g} N/m, {what}: in waves "
        f"as short as the cells, differently on each mesh. {_as_shell(model, name, bent)}",
        advice='Let it bend: form = "shell" gives one answer on all meshes. A sheet whose own waves are shorter than '
        "the cells bears tension only: compression = 0.",
    )


def _bending_share(model: Model, name: str, state: State) -> float | None:
    """Energy that a membrane would store by bending were it a shell, over that of the actuator; None if it branches."""
    try:
        bent = bending_energy(model, name, state.displacement)
    except TurgorError:
        return None
    return bent / strain_energy(model, state.displacement, state.mean_stress, load_factor=state.load_factor)


def _as_shell(model: Model, name: str, bent: float | None) -> str:
    """Effect of the bending stiffness of a membrane: on its waves, and on the energy of its present shape.

    A plate on a thick solid of the shear modulus μ wrinkles at 3 (D μ²)^⅓, in waves of 2π (D/μ)^⅓; inside of a
    solid both halves resist, and μ counts twice.
    """
    sheet, mesh = model.membranes[name], model.mesh
    D = Shell(sheet.material, sheet.thickness, warp=sheet.warp).bending_stiffness
    count = len(mesh.points)
    inside = not np.isin(corner_keys(mesh.face(name), count), corner_keys(outer_triangles(mesh), count)).any()
    mu = softest(model) * (2 if inside else 1)
    if mu == 0:  # nothing holds a film alone
        waves = "A shell of its thickness has waves of a finite length"
    else:
        waves = (
            f"A shell of its thickness would wrinkle at about {3 * np.cbrt(D * mu**2):.3g} N/m, in waves of "
            f"{2 * np.pi * np.cbrt(D / mu) / mm:.2g} mm"
        )
    if bent is None:
        return f"{waves}."
    share = f"{100 * bent:.0f} %" if bent > 0.01 else "less than 1 %"
    return f"{waves}; bent as now it would store {share} of the energy of the actuator."


def softest(model: Model) -> float:
    """Return the smallest initial shear modulus of the regions [Pa]; 0 of films without a solid."""
    return min((material.law.shear_modulus for material in model.region_materials.values()), default=0.0)
