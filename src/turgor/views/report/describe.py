"""Describe: models in words and rows for a report."""

import inspect
import re
from dataclasses import dataclass, fields
from math import isinf
from typing import Any

from turgor.core.materials.failure_tables import describe_failure
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.library.record_history import describe_history
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import MeshQuality
from turgor.core.model.embedded import EmbeddedThreads
from turgor.core.model.fibers import Fibers
from turgor.core.model.model import Model
from turgor.core.model.obstacles.obstacle import friction_text
from turgor.core.model.sheets import Sheet, Shell
from turgor.units import GPa, MPa, deg, kPa, mm, mN
from turgor.views.report.references import law_source

Rows = list[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class MaterialText:
    """A material in words: where it is used, its name, its law, its values, its source and its doubts.

    ``material`` is the material itself; None for threads.
    """

    where: str
    name: str
    law: str
    values: Rows
    source: str
    doubts: tuple[str, ...]
    material: Material | None = None


def loads(model: Model) -> list[str]:
    """Describe the loads of a model at load factor 1, a sentence for each."""
    return [load.text() for load in model.loads] or ["None."]


def supports(model: Model) -> list[str]:
    """Describe the supports of a model, a sentence for each."""
    return [support.text() for support in model.supports]


def contact(model: Model) -> list[str]:
    """Describe possible contact: a sentence for the actuator itself and one for each obstacle."""
    own, sentences = model.contact.for_mesh(model.mesh), []
    if own is not None:
        sentences.append(f"The actuator touches itself {friction_text(own.friction)}.")
    elif model.contact.self_contact is None:
        sentences.append("Walls of the actuator do not stop each other: self-contact is off.")
    sentences += [bond.text() for bond in model.bonds]
    return sentences + [obstacle.text() for obstacle in model.contact.obstacles]


def mesh(of: Mesh, quality: MeshQuality | None) -> Rows:
    """Counts of a mesh and, where it was measured, its quality."""
    rows = [
        ("cells", f"{len(of.cells):,} {of.cell_type.name.replace('hedron', 'hedra')} ({_share(of)})"),
        ("nodes", f"{len(of.points):,}"),
        ("unknowns", f"{of.unknown_count:,} displacements and mean stresses"),
        ("regions", ", ".join(f"{name} {len(cells):,}" for name, cells in of.regions.items())),
    ]
    if quality is not None:
        rows += [
            (
                "edges",
                f"{quality.min_edge / mm:.2g} to {quality.max_edge / mm:.2g} mm, mean {quality.mean_edge / mm:.2g} mm",
            ),
            ("shape", f"mean {quality.mean_shape:.2f}, worst {quality.min_shape:.2f} (1 is regular, 0 is flat)"),
            ("curvature", f"worst Jacobian ratio {quality.min_jacobian_ratio:.2f} (1 is straight, 0 is folded)"),
        ]
    return rows


def _share(of: Mesh) -> str:
    """Which part of the actuator is meshed, in words."""
    if of.wedge is not None:
        return f"wedge of 1/{of.wedge.fold} about {of.wedge.axis}"
    if of.revolved:
        return f"body of revolution about {of.revolved}"
    normals = [axis for axis, _ in of.mirror_planes]
    if len(set(normals)) < len(normals):
        return "slice between two mirror planes"
    return {1: "whole actuator", 2: "half, mirrored", 4: "quarter, mirrored"}.get(of.symmetry_factor, "part, mirrored")


def materials(model: Model) -> list[MaterialText]:
    """Put the materials of a model into words; regions of the same material share one text."""
    shared: list[tuple[Material | Sheet, list[str]]] = []
    for name, used in model.materials.items():
        names = next((names for known, names in shared if known == used), None)
        if names is None:
            shared.append((used, [name]))
        else:
            names.append(name)
    return [*(material(names, used) for used, names in shared), *(_fibers(each) for each in model.reinforcements)]


def _fibers(fibers: Fibers) -> MaterialText:
    """Threads: their modulus, diameter and how they are wound."""
    law = fibers.material.law
    values: Rows = [("coefficients", ", ".join(f"{name} = {value}" for name, value in coefficients(law)))]
    values.append(("diameter", f"{fibers.diameter / mm:.4g} mm"))
    values += _course(fibers)
    if fibers.compression:
        values.append(("in compression", f"{100 * fibers.compression:g} % of the stiffness"))
    if fibers.bending:
        values.append(("bending", "resisted"))
    where = f"{fibers.place.replace('_', ' ')} ({'embedded' if fibers.embedded else fibers.form} fibers)"
    source = fibers.material.source
    return MaterialText(
        where, fibers.material.name, "Threads, stiff along themselves.", values, str(source), source.doubts
    )


def _course(fibers: Fibers) -> Rows:
    """How threads run."""
    if isinstance(fibers.winding, EmbeddedThreads):
        return [("threads", str(len(fibers.winding.through)))]
    winding = fibers.winding
    values: Rows = []
    units = {"angle_from_axis": deg, "angle_from_circumference": deg, "pitch": mm, "spacing": mm}
    for name in ("angle_from_axis", "angle_from_circumference", "turns", "pitch", "spacing", "starts"):
        value = getattr(winding, name)
        if value is not None:
            unit = {deg: "°", mm: " mm"}.get(units.get(name, 1.0), "")
            values.append((name.replace("_", " "), f"{value / units.get(name, 1.0):.4g}{unit}"))
    hand = "both hands" if winding.hand == "both" else f"{winding.hand}-handed"
    straight = winding.angle_from_axis == 0 or winding.angle_from_circumference == 0
    return values if straight else [*values, ("helix", hand)]


def material(names: list[str], used: Material | Sheet) -> MaterialText:
    """Put a material into words.

    Parameters
    ----------
    names : list of str
        Where it is used.
    used : Material, Shell or Membrane

    Returns
    -------
    MaterialText
    """
    material = used.material if isinstance(used, Sheet) else used
    where = ", ".join(name.replace("_", " ") for name in names)
    values: Rows = [("coefficients", ", ".join(f"{name} = {value}" for name, value in coefficients(material.law)))]
    if isinstance(used, Sheet):
        where += f" ({type(used).__name__.lower()})"
        values.append(("thickness", f"{used.thickness / mm:g} mm"))
        if isinstance(used, Shell):
            values.append(("bending stiffness", f"{used.bending_stiffness / (mN * mm):.3g} mN mm"))
        if used.wrinkles:
            values.append(("in compression", f"{100 * used.compression:g} % of the stiffness: it wrinkles"))
    else:
        kappa = "infinite: fully incompressible" if isinf(material.bulk_modulus) else _modulus(material.bulk_modulus)
        stiff = isinstance(material.law, Hooke)
        values += [] if stiff else [("shear modulus", _modulus(material.law.shear_modulus)), ("bulk modulus", kappa)]
    if material.orientation is not None:
        values.append(("directions", repr(material.orientation).removeprefix("Orientation")))
    if material.density is not None:
        values.append(("density", f"{material.density:g} kg/m³"))
    if material.expansion is not None:
        values.append(("thermal expansion", f"{material.expansion * 1e6:.4g} ppm/K"))
    if material.stretch_range is not None:
        values.append(("fitted to stretches", f"{material.stretch_range[0]:g} to {material.stretch_range[1]:g}"))
    values += describe_history(material)
    values += describe_failure(material)
    formula = (inspect.getdoc(type(material.law)) or type(material.law).__name__).splitlines()[0]
    values += [("law published in", law_source(material.law))] if law_source(material.law) else []
    return MaterialText(where, material.name, formula, values, str(material.source), material.source.doubts, material)


def coefficients(law: Any) -> Rows:
    """Coefficients of a law with the units that its documentation states.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Hooke
    >>> coefficients(Hooke(E=6.5e9, nu=0.2))
    [('E', '6.5 GPa'), ('nu', '0.2')]
    >>> from turgor.core.materials.laws.laws import GeneralizedRivlin, Ogden
    >>> coefficients(Ogden(mu=(2e5,), alpha=(1.5,)))
    [('mu_1', '0.2 MPa'), ('alpha_1', '1.5')]
    >>> coefficients(GeneralizedRivlin(coefficients=((1, 0, 1e5), (0, 1, 2e4))))
    [('C10', '0.1 MPa'), ('C01', '0.02 MPa')]
    """
    stated: dict[str, str] = {}
    for names, unit in re.findall(
        r"^\s*(\w+(?:, \w+)*) : (?:tuple of )?float(?: \[(.*?)\])?$", inspect.getdoc(type(law)) or "", re.M
    ):
        stated |= dict.fromkeys(names.split(", "), unit)
    rows = []
    for each in fields(law):
        for name, value in _terms(each.name, getattr(law, each.name)):
            pascal = stated.get(each.name) == "Pa" or name.startswith("C")
            rows.append((name, _modulus(value) if pascal else f"{value:g}"))
    return rows


def _terms(name: str, value: Any) -> list[tuple[str, float]]:
    """Name and number of each term of a coefficient, which may be one number, a series, or terms with exponents."""
    if not isinstance(value, tuple):
        return [(name, value)]
    if name != "coefficients":
        return [(f"{name}_{n}", each) for n, each in enumerate(value, 1)]
    if isinstance(value[0], tuple):
        return [(f"C{i}{j}", each) for i, j, each in value]
    return [(f"C{n}0", each) for n, each in enumerate(value, 1)]


def _modulus(value: float) -> str:
    if value == 0:
        return "0"
    if abs(value) >= GPa:
        return f"{value / GPa:g} GPa"
    return f"{value / MPa:g} MPa" if abs(value) >= 0.01 * MPa else f"{value / kPa:g} kPa"
