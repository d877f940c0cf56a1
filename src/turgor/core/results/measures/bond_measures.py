"""Measures of bonds: what pulls two bodies, or a body and a sheet, off each other, and how far a bond has opened.

The stress on a face is averaged at the nodes of each region, and over the regions that meet on it. At the rim of a bond
between materials of different stiffness the exact stress is unbounded, so the value that 99 % of the area stay below is
read.
"""

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.bonds.bond_results import BondResult
from turgor.core.engine.cells.reference import side_tables
from turgor.core.engine.percentiles import PERCENTILE, weighted_percentile
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.field_measures import as_column
from turgor.core.results.measures.measure import Measure
from turgor.foundation.errors import unknown

Array = NDArray[np.float64]

_PEEL, _SHEAR = "peel_stress_p99", "bond_shear_p99"

#: Unit and definition of what is read off a `Bond`, and how.
_OPENING: Mapping[str, tuple[str, str, Callable[[BondResult], float]]] = MappingProxyType(
    {
        "peel_damage": ("", "Mean damage of the bond {}, 0 as new, 1 open, over what was bonded at rest",
                        lambda bond: bond.mean_damage),
        "opened_area": ("mm2", "Area of the bond {} that has opened", lambda bond: float(bond.area[bond.opened].sum())),
        "bond_gap": ("mm", "Largest distance across the bond {}", lambda bond: float(bond.gap.max())),
        "peel_energy": ("mJ", "Energy that opening the bond {} has taken",
                        lambda bond: float((bond.area * bond.energy).sum())),
    }
)  # fmt: skip

#: Those that are sums over the modeled part.
_SUMS = ("opened_area", "peel_energy")


def peel_stress_on(face: str) -> Measure:
    """Make the measure of the stress that pulls both sides of a face apart.

    Examples
    --------
    >>> peel_stress_on("strain_limiting_layer").name
    'strain_limiting_layer_peel_stress_p99'
    """
    return Measure(
        name=f"{as_column(face)}_{_PEEL}", unit="kPa", function=lambda at: _percentile(at, face, 0),
        definition=f"Cauchy stress across the face {face}, where it pulls, that {PERCENTILE} % of its area stay below",
        local=True,
    )  # fmt: skip


def bond_shear_on(face: str) -> Measure:
    """Make the measure of the shear stress between both sides of a face.

    Examples
    --------
    >>> bond_shear_on("strain_limiting_layer").name
    'strain_limiting_layer_bond_shear_p99'
    """
    return Measure(
        name=f"{as_column(face)}_{_SHEAR}", unit="kPa", function=lambda at: _percentile(at, face, 1),
        definition=f"Cauchy shear stress along the face {face} that {PERCENTILE} % of its area stay below",
        local=True,
    )  # fmt: skip


def opening_of(bond: str, what: str = "opened_area") -> Measure:
    """Make a measure of how far a `Bond` has opened.

    Parameters
    ----------
    bond : str
        Its name.
    what : str
        ``"peel_damage"``, ``"opened_area"``, ``"bond_gap"`` or ``"peel_energy"``.

    Examples
    --------
    >>> opening_of("glue").name, opening_of("glue", "bond_gap").unit
    ('glue_opened_area', 'mm')
    """
    if what not in _OPENING:
        raise unknown("measure of a bond", what, _OPENING)
    unit, definition, read = _OPENING[what]

    def value(at: StateFields) -> float:
        names = [name for name in at.bonds if bond in (name, as_column(name))]
        if not names:
            raise unknown("bond", bond, at.bonds)
        return (at.mesh.symmetry_factor if what in _SUMS else 1) * read(at.bonds[names[0]])

    return Measure(
        name=f"{as_column(bond)}_{what}", unit=unit, function=value, definition=definition.format(bond),
    )  # fmt: skip


def openings_of(model: Model) -> tuple[Measure, ...]:
    """Return the measures that a response has of each bond: damage, opened area, gap."""
    chosen = ("peel_damage", "opened_area", "bond_gap")
    return tuple(opening_of(bond.name, what) for bond in model.bonds for what in chosen)


def bond_measure(name: str) -> Measure | None:
    """Return the measure of a bond by its name; None for other names.

    Examples
    --------
    >>> bond_measure("strain_limiting_layer_peel_stress_p99").unit
    'kPa'
    """
    parts = re.fullmatch(rf"(\w+)_({'|'.join((_PEEL, _SHEAR, *_OPENING))})", name)
    if parts is None:
        return None
    if parts[2] in _OPENING:
        return opening_of(parts[1], parts[2])
    return (peel_stress_on if parts[2] == _PEEL else bond_shear_on)(parts[1])


def _percentile(at: StateFields, face: str, which: int) -> float:
    names = [name for name in at.mesh.faces if face in (name, as_column(name))]
    if not names:
        raise unknown("face", face, at.mesh.faces)
    values = at.once(("bond", names[0]), lambda: _tractions(at, names[0]))
    return weighted_percentile(values[which], values[2])


def _tractions(at: StateFields, face: str) -> tuple[Array, Array, Array]:
    """Stress that pulls, shear stress, and current area at the quadrature points of a face, (f, q) each."""
    sides, nodes = at.mesh.face(face), at.facts.region_nodes.node
    count = np.bincount(nodes, minlength=len(at.points))
    stress = np.zeros((len(at.points), 3, 3))
    np.add.at(stress, nodes, at.cauchy_stress)
    table = side_tables(sides.shape[1])
    local = np.einsum("qa,faij->fqij", table.N, (stress / count[:, None, None])[sides])
    tangent = np.einsum("qad,fai->fqid", table.dN, at.points[sides])
    across = np.cross(tangent[..., 0], tangent[..., 1])
    size = np.linalg.norm(across, axis=-1)
    normal = across / size[..., None]
    traction = np.einsum("fqij,fqj->fqi", local, normal)
    pull = np.einsum("fqi,fqi->fq", traction, normal)
    shear = np.linalg.norm(traction - pull[..., None] * normal, axis=-1)
    return np.maximum(pull, 0.0), shear, size * table.weights
