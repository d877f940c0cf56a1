"""The inflated membranes of Campbell et al. 2025: a clamped disc of Ecoflex 00-30 lifts a rigid plate with a weight.

Axis x, up. The disc is 2 mm thick and clamped at a radius of 70 mm, on top of a stiff can which holds the air; its part
under the plate is bonded to it, and rings are regions of the same thickness, as in the equations of the authors. The
can is sealed while the weight is put on, then air volume is prescribed: some curves have a maximum of the pressure.
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from ecoflex import WHOLE, material, scaled
from measured_tables import DATA, numbers, table
from netgen.occ import Cylinder, Glue, Pnt, X

import turgor as tg
from turgor.foundation.response import Column
from turgor.foundation.source import Source
from turgor.studies.runs.run import Computed
from turgor.units import MPa, kPa, mL, mm

FOLDER = DATA / "upenn-ecoflex30-membranes"
RADIUS, THICKNESS, DEEP, STIFF_WALL = 70.0, 2.0, 3.0, 3.0  # mm
WEIGHTS = (14.715, 24.525, 39.24)  # N
#: Heights of the plate that are compared [mm]: above the noise at the bottom, below the stop of the stage.
HEIGHTS = (8.0, 48.0)
AUTHORS = {"mu": 31.7 * kPa, "Jm": 39.6}
RING = tg.Material(name="ring", law=tg.laws.Gent(mu=1 * MPa, Jm=25.0))
STIFF = tg.Material(name="rigid", law=tg.laws.NeoHooke(C10=100 * MPa))
SOURCE = Source(text="turgor, axisymmetric")


def dimensions(membrane: str) -> dict[str, float]:
    """Radii and widths of a membrane [mm]; those of rings that it lacks are nan."""
    row = next(row for row in table(FOLDER / "membranes.csv") if row["membrane"] == membrane)
    return {name: float(value or "nan") for name, value in row.items() if name.endswith("_mm")}


def _disc(outer: float, low: float, high: float, inner: float = 0.0) -> Any:
    """Ring around x between two heights [mm]."""
    result = Cylinder(Pnt(low, 0, 0), X, outer, high - low)
    return result - Cylinder(Pnt(low - 1, 0, 0), X, inner, high - low + 2) if inner else result


def bands(membrane: str, plate_mm: float | None = None) -> list[tuple[str, float, float]]:
    """Name, inner and outer radius [mm] of the bands of a membrane, from the middle on."""
    sizes = dimensions(membrane)
    results = [("plate", 0.0, plate_mm or sizes["contact_radius_mm"])]
    for ring in ("ring1", "ring2"):
        middle, width = sizes[f"{ring}_radius_mm"], sizes[f"{ring}_width_mm"]
        if np.isfinite(middle):
            low, high = middle - width / 2, min(middle + width / 2, RADIUS - 0.2)
            results += [(f"before_{ring}", results[-1][2], low), (ring, low, high)]
    return [*results, ("outer", results[-1][2], RADIUS)]


def geometry(membrane: str, thickness: float = THICKNESS, plate_mm: float | None = None) -> tg.Geometry:
    """A quarter of can and membrane."""
    wall = RADIUS + STIFF_WALL
    can = _disc(wall, -DEEP - STIFF_WALL, thickness) - _disc(RADIUS, -DEEP, thickness + 1)
    parts = bands(membrane, plate_mm)
    solids = [_disc(high, 0.0, thickness, low) for _, low, high in parts]
    middle = thickness / 2 * mm
    regions = {name: tg.cad.NearestTo((middle, (low + high) / 2 * mm, 0.1 * mm)) for name, low, high in parts}
    regions["can"] = tg.cad.NearestTo(((-DEEP - STIFF_WALL) * mm, 10 * mm, 10 * mm))
    faces = {"fixed": tg.cad.WithNormal("-x"), "tip": tg.cad.NearestTo((thickness * mm, 8 * mm, 8 * mm))}
    with TemporaryDirectory() as folder:
        path = Path(folder) / "membrane.step"
        Glue([can, *solids]).WriteStep(str(path))
        return tg.cad.read_cad(path, unit="mm", faces=faces, regions=regions, symmetry="yz")


def rubber(law: str, upto: float, factor: float) -> Any:
    """A fit to the tests of Moseley et al., or ``"authors"``, the constants of Campbell et al.; all stresses scaled."""
    if law == "authors":
        return tg.Material(name="authors", law=tg.laws.Gent(mu=factor * AUTHORS["mu"], Jm=AUTHORS["Jm"]))
    return tg.Material(name=law, law=scaled(material(law, upto).law, factor))


def lifts(
    membrane: str, weight: float, law: str, *, upto: float = WHOLE, factor: float = 1.0, volume_mL: float = 900.0,
    size_mm: float = 3.0, thickness_mm: float = THICKNESS, plate_mm: float | None = None,
) -> Computed:  # fmt: skip
    """Pressure and height of the plate while air comes in."""
    built = geometry(membrane, thickness_mm, plate_mm)
    materials = dict.fromkeys(built.regions, rubber(law, upto, factor))
    materials |= {name: RING for name in built.regions if name.startswith("ring")} | {"plate": STIFF, "can": STIFF}
    mesh = tg.mesh(built, size=size_mm * mm, cells="axisymmetric")
    model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [])
    rests = tg.Stage("weight", tg.Sealed(), loads=[tg.loads.Force("tip", (-weight, 0, 0))])
    fills = tg.Stage("fill", tg.VolumeControl(volume=volume_mL * mL, max_step=0.05))
    solution = tg.solve(model, tg.Stages([rests, fills]), throw=False)
    result = tg.measure(solution, tg.measures.tip_displacement_x, tg.measures.principal_stretch_p99, mesh_error=False)
    filled = np.array([state.stage == "fill" for state in solution.states])
    columns = (
        Column("height", "mm", result.column("tip_displacement_x")[filled]),
        Column("pressure", "kPa", result.column("pressure")[filled]),
        Column("stretch_p99", "", result.column("outer_principal_stretch_p99")[filled]),
    )
    return Computed(response=tg.Response(columns=columns, source=SOURCE, message=solution.message))


def measured(membrane: str, weight: float) -> dict[str, np.ndarray]:
    """Height [mm], pressure [kPa] and its spread over both sweeps, at the heights that are compared."""
    rows = numbers(FOLDER / f"{membrane}_means.csv")
    used = (rows["lifted_weight_N"] == weight) & (rows["height_mm"] >= HEIGHTS[0]) & (rows["height_mm"] <= HEIGHTS[1])
    heights = np.unique(rows["height_mm"][used])
    sweeps = [rows["pressure_Pa"][used & (rows["height_mm"] == height)] / 1e3 for height in heights]
    pressures = np.array([each.mean() for each in sweeps])
    return {"height": heights, "pressure": pressures, "spread": np.array([np.ptp(each) / 2 for each in sweeps])}


def pressures_at(response: tg.Response, heights: np.ndarray) -> np.ndarray:
    """Computed pressure [kPa] at heights of the plate [mm]; nan above the highest one."""
    x, y = response.column("height") / mm, response.column("pressure") / kPa
    return np.interp(heights, x, y, left=np.nan, right=np.nan)


def off(response: tg.Response, membrane: str, weight: float) -> np.ndarray:
    """Relative differences of the pressure [-], computed over measured minus one."""
    result = measured(membrane, weight)
    return pressures_at(response, result["height"]) / result["pressure"] - 1


def calibrated(law: str) -> Computed:
    """Factor on all stresses with which the plain membrane fits at the middle weight: one step of the secant method."""

    def mean_off(factor: float) -> float:
        result = lifts("membrane_01", WEIGHTS[1], law, factor=factor).response
        return float(np.nanmean(off(result, "membrane_01", WEIGHTS[1])))

    before = mean_off(1.0)
    tried = 1 - before
    factor = 1 - before * (tried - 1) / (mean_off(tried) - before)
    columns = (Column("factor", "", np.array([round(factor, 3)])),)
    return Computed(response=tg.Response(columns=columns, source=SOURCE))
