"""write_sofa: an actuator as a scene of SOFA with the plugin SoftRobots."""

import json
from dataclasses import dataclass
from pathlib import Path
from string import Template
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces.surfaces import area
from turgor.core.materials.laws.laws import Hooke
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.core.model.model import Model
from turgor.core.model.supports.fixed import Fixed
from turgor.core.model.supports.symmetry import Symmetry
from turgor.foundation.errors import TurgorError
from turgor.systems.exports.linear_body import LinearBody, linear_body
from turgor.systems.exports.sofa_law import SofaLaw, sofa_law
from turgor.units import kPa, mm

#: Density of rubber whose material has none [kg/m³].
DENSITY = 1070.0

#: Files of a scene, besides one STL file for each cavity.
SCENE, BODY, SETS = "scene.py", "body.vtk", "sets.json"


@dataclass(frozen=True, slots=True, kw_only=True)
class SofaScene:
    """What was written for SOFA.

    Parameters
    ----------
    folder : Path
    volumes : dict of str to float [m³]
        Volume that the closed surface of each cavity encloses.
    materials : dict of str to SofaLaw
        Constants of each region.
    """

    folder: Path
    volumes: dict[str, float]
    materials: dict[str, SofaLaw]


def write_sofa(
    model: Model, folder: str | Path, *, poisson: float = 0.49, stretch: float = 1.5, step: float = 0.01
) -> SofaScene:
    """Write a model as a scene of SOFA: mesh, closed cavities, constants of a law of SOFA, supports, pressures.

    Lengths are in mm, masses in kg, times in s; so forces are in mN and pressures in kPa. Each tetrahedron becomes
    eight linear ones, and a half the whole. Sheets stretch and do not bend. Pressures rise over one second.

    The scene was not run in SOFA.

    Parameters
    ----------
    model : Model
        Of tetrahedra, with pressures on cavities and its weight as loads, and faces that are fixed in all directions.
    folder : str or Path
        Made where it does not exist.
    poisson : float [-]
        Poisson's ratio of rubber that keeps its volume, which SOFA's elements cannot.
    stretch : float [-]
        Largest stretch to which the constants are fitted.
    step : float [s]
        Time step.

    Returns
    -------
    SofaScene

    Raises
    ------
    TurgorError
        If the scene cannot have what the model has, a cavity is open, or a number is out of range.
    """
    if not 0 < poisson < 0.5:
        raise TurgorError(f"poisson is {poisson:g}; allowed is more than 0 and less than 0.5.")
    if not 1 < stretch < np.inf:
        raise TurgorError(f"stretch is {stretch:g}; allowed is more than 1.")
    if not 0 < step < np.inf:
        raise TurgorError(f"step is {step:g} s; allowed is more than 0 s.")
    _check(model)
    body, place = linear_body(model.mesh), Path(folder)
    materials = {name: sofa_law(each, stretch, poisson) for name, each in model.region_materials.items()}
    place.mkdir(parents=True, exist_ok=True)
    volumes = {
        load.face: write_stl(model.mesh, place / f"{load.face}.stl", face=load.face).volume for load in model.pressures
    }
    (place / BODY).write_text(_vtk(body), encoding="ascii")
    (place / SETS).write_text(json.dumps(_sets(model, body, materials)), encoding="ascii")
    template = Template(Path(__file__).with_name("sofa_scene.txt").read_text(encoding="utf-8"))
    error = f"{max(each.error for each in materials.values()):.1%}"
    text = template.substitute(name=model.mesh.name, error=error, stretch=f"{stretch:g}", step=repr(step))
    (place / SCENE).write_text(text, encoding="utf-8")
    return SofaScene(folder=place, volumes=volumes, materials=materials)


def _check(model: Model) -> None:
    for support in model.supports:
        if isinstance(support, Symmetry):
            continue  # the whole is written
        if (
            not isinstance(support, Fixed)
            or set(support.directions) != set("xyz")
            or (support.face not in model.mesh.faces)
        ):
            raise TurgorError(
                f"a scene of SOFA has faces that are fixed in x, y and z; the model has: {support.text()}"
            )
    for load in model.loads:
        if load.kind not in ("pressure", "gravity"):
            raise TurgorError(f"a scene of SOFA has pressures and weight; the model has: {load.text()}")
    for what in ("fibers", "obstacles"):
        if getattr(model, what, None):
            raise TurgorError(f"a scene of SOFA has no {what}; leave them out of the model.")


def _vtk(body: LinearBody) -> str:
    """The mesh in mm as a legacy file of VTK, which SOFA's loader reads."""
    points, cells = body.points / mm, body.tetrahedra
    lines = ["# vtk DataFile Version 2.0", "lengths in mm", "ASCII", "DATASET UNSTRUCTURED_GRID"]
    lines += [f"POINTS {len(points)} double", *(" ".join(f"{x:.12g}" for x in row) for row in points.tolist())]
    lines += [f"CELLS {len(cells)} {5 * len(cells)}", *(f"4 {a} {b} {c} {d}" for a, b, c, d in cells.tolist())]
    return "\n".join([*lines, f"CELL_TYPES {len(cells)}", *["10"] * len(cells)]) + "\n"


def _sets(model: Model, body: LinearBody, materials: dict[str, SofaLaw]) -> dict[str, object]:
    """What the scene reads: nodes, triangles and constants, in mm, kg, s, mN and kPa."""
    regions = {}
    for name, cells in body.regions.items():
        density = model.region_materials[name].density or DENSITY
        own = materials[name]
        mass = density * float(body.volumes(cells).sum())
        regions[name] = {"tetrahedra": cells.tolist(), "law": own.name, "constants": own.parameters, "mass": mass}
    sheets = {}
    for name, sheet in model.membranes.items():
        law = sheet.material.law
        if type(law) is not Hooke:
            raise TurgorError(f"the woven sheet on '{name}' has no form in SOFA scenes; leave it out.")
        numbers = {"young": law.E / kPa, "poisson": law.nu, "thickness": sheet.thickness / mm}
        whole = area(model.mesh.points, model.mesh.face(name)) * model.mesh.symmetry_factor
        numbers["mass"] = model.sheet_masses.get(name, 0.0) * whole
        sheets[name] = {"triangles": body.faces[name].tolist(), **numbers}
    weight: NDArray[np.float64] = np.zeros(3)
    falls: list[Any] = [load for load in model.loads if load.kind == "gravity"]
    for load in falls:
        weight = weight + np.array(load.direction) * load.acceleration / mm
    fixed = [body.faces[support.place].ravel() for support in model.supports if isinstance(support, Fixed)]
    return {
        "regions": regions,
        "sheets": sheets,
        "fixed": np.unique(np.concatenate([*fixed, np.zeros(0, dtype=np.int64)])).tolist(),
        "pressures": {load.face: load.pressure / kPa for load in model.pressures},
        "gravity": weight.tolist(),
    }
