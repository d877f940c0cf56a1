"""The bending actuators of Moseley et al. 2016: a block of Ecoflex 00-30 with a row of chambers, closed by a film.

Axes: x from the held end to the tip, z up, the film at z = 0, the mirror plane at y = 0. Dimensions are those of the
geometry script of the authors. A floor of rubber lies on the film, because a cavity needs walls of rubber.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from ecoflex import WHOLE, material, scaled

import turgor as tg
from turgor.foundation.source import Source
from turgor.studies.runs.run import Computed
from turgor.units import MPa, deg, kPa, mm

CHAMBER, HEIGHT, WIDTH, CHANNEL = 2 * mm, 8 * mm, 8 * mm, 2 * mm
LAYER = "strain_limiting_layer"
SOURCE = Source(text="turgor, half of the actuator")
#: The angle of the authors: of the line from a point that stands still to the tip.
LINE = "base_bottom tip_bottom"
#: Pressures that a path hits exactly [kPa].
READ = (10.0, 15.0, 20.0, 25.0, 30.0, 32.0, 34.0, 35.0, 36.0, 37.0, 38.0, 39.0, 40.0, 42.0, 44.0)
#: What is modeled where nothing else is said. The film is a membrane of silk, as its authors model it.
STATED: Mapping[str, Any] = {
    "law": "yeoh", "upto": WHOLE, "zero": "authors", "tests": "both", "factor": 1.0,
    "modulus_MPa": 4100.0, "thickness_mm": 0.5, "form": "wrinkles",
    "wall_mm": 7.0, "floor_mm": 0.5, "clamp_mm": 0.0, "gravity": "none",
    "plate_mm": 0.0, "table": "none", "touches_itself": None, "size_mm": 7.0, "picture": False,
}  # fmt: skip


def actuator(chambers: int, given: Mapping[str, Any]) -> tg.actuators.SlowPneuNet:
    """Half of an actuator."""
    wall, floor = given["wall_mm"] * mm, given["floor_mm"] * mm
    return tg.actuators.SlowPneuNet(
        chambers=chambers,
        length=chambers * CHAMBER + (chambers + 1) * wall,
        width=WIDTH + 2 * wall,
        height=floor + HEIGHT + wall,
        wall=wall,
        side_wall=wall,
        top_wall=wall,
        end_wall=wall,
        floor=floor,
        base=0.0,
        channel_width=CHANNEL,
        channel_height=CHANNEL,
        clamp_length=given["clamp_mm"] * mm,
    )


def layer(film: Mapping[str, Any]) -> tg.Shell | tg.Membrane:
    """The film: ``"wrinkles"`` bears tension only, ``"membrane"`` compression too, ``"shell"`` bends as a plate."""
    silk = tg.Material(name="film", law=tg.laws.Hooke(E=film["modulus_MPa"] * MPa, nu=0.49))
    thickness = film["thickness_mm"] * mm
    if film["form"] == "shell":
        return tg.Shell(silk, thickness)
    return tg.Membrane(silk, thickness, compression={"wrinkles": 0.0, "membrane": 1.0}[film["form"]])


def model_of(chambers: int, given: Mapping[str, Any]) -> tg.Model:
    """The actuator without loads."""
    mesh = tg.mesh(actuator(chambers, given).build(), size=given["size_mm"] * mm, cells="tetrahedra")
    rubber = material(given["law"], given["upto"], given["zero"], given["tests"])
    materials: dict[str, Any] = {"body": replace(rubber, law=scaled(rubber.law, given["factor"]))}
    if given["form"] != "none":
        materials[LAYER] = layer(given)
    contact = tg.Contact(given["touches_itself"], table_under(given["table"], mesh.points))
    return tg.Model(mesh, materials, [tg.Fixed("fixed")], [], contact=contact)


def table_under(under: str, points: np.ndarray) -> list[tg.obstacles.Obstacle]:
    """A rigid table without friction, under the ``"film"`` or under the ``"top"``, which then lies upside down."""
    if under == "none":
        return []
    up, down = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
    place, normal = {"film": (0.0, up), "top": (float(points[:, 2].max()), down)}[under]
    plane = tg.obstacles.Plane(point=(0.0, 0.0, place), normal=normal)
    return [tg.obstacles.Obstacle(name="table", shape=plane)]


def bends(chambers: int, top_kPa: float, past: float, how: dict[str, Any]) -> Computed:
    """Free bending: places of points on base and tip while the pressure rises, past limit points."""
    given = {**STATED, **how}
    model = model_of(chambers, given)
    air, at = tg.Pressure("cavity", top_kPa * kPa), tuple(each / top_kPa for each in READ if each < top_kPa)
    procedure = tg.Auto(past=past, at=at) if given["gravity"] == "none" else tg.Static(at=at)
    solution = solved(model, air, procedure, given["gravity"])
    length, height = float(model.mesh.points[:, 0].max()), float(model.mesh.points[:, 2].max())
    points = {"base_bottom": (0.0, 0.0, 0.0), "base_top": (0.0, 0.0, height), "tip_bottom": (length, 0.0, 0.0),
              "tip_middle": (length, 0.0, height / 2), "tip_top": (length, 0.0, height)}  # fmt: skip
    markers = [each for name, place in points.items() for each in tg.measures.marker(name, place)]
    others = (tg.bending_angle, tg.cavity_volume, tg.measures.principal_stretch_p99)
    result = tg.measure(solution, *others, *markers, mesh_error=False)
    kept = ["pressure", *(each.name for each in others), *(each.name for each in markers if each.name[-1] != "y")]
    response = tg.Response(columns=tuple(map(result.find, kept)), source=SOURCE, message=solution.message)
    return Computed(response=response, picture=_drawn(solution, given))


def solved(model: tg.Model, air: tg.Pressure, procedure: Any, gravity: Any) -> tg.Solution:
    """The path of the pressure, after the weight where there is one."""
    if gravity == "none":
        return tg.solve(replace(model, loads=[air]), procedure, throw=False)
    weight = tg.Stage("weight", loads=[tg.Gravity(gravity)])
    return tg.solve(model, tg.Stages([weight, tg.Stage("pressure", procedure, loads=[air])]), throw=False)


def _drawn(solution: tg.Solution, given: Mapping[str, Any]) -> bytes:
    """Picture of the last state, where one is wanted."""
    return tg.picture(solution, width=900).png if given["picture"] else b""


def angles(response: tg.Response, line: str) -> tuple[np.ndarray, np.ndarray]:
    """Pressure [kPa] and angle [deg] along the path; the angle is of a line between two points, or ``"tangent"``."""
    if line == "tangent":
        angle = response.column("bending_angle")
    else:
        start, end = line.split()
        along, up = (response.column(f"{end}_{axis}") - response.column(f"{start}_{axis}") for axis in "xz")
        angle = np.unwrap(np.arctan2(-up, along))
    return response.column("pressure") / kPa, (angle - angle[0]) / deg
