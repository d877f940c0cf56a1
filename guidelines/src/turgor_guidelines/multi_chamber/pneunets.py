"""PneuNets of the guidelines: one rubber, paper in the base, one end fixed; bent, or pushing on a plate."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import deg, kPa, mm
from turgor_guidelines.guideline import Setting
from turgor_guidelines.pictures import picture_of
from turgor_guidelines.values import Value

#: Families of which rules on multi-chambered actuators speak; they were run with the first of them.
MULTI_CHAMBERED = (
    "fast_pneunet",
    "slow_pneunet",
    "bidirectional_pneunet",
    "free_bottom_pneunet",
    "helical_pneunet",
    "trapezoidal_pneunet",
    "triangular_pneunet",
)

#: Dimensions that the studies share [mm], those of a fast PneuNet.
WALLS: Mapping[str, float] = MappingProxyType(
    {
        "width": 20,
        "height": 19,
        "wall": 1.5,
        "side_wall": 2,
        "top_wall": 2,
        "end_wall": 1.5,
        "floor": 1.5,
        "base": 1.5,
        "gap": 1,
        "channel_width": 3,
        "channel_height": 3,
        "channel_wall": 1.5,
    }
)

#: What only a PneuNet with gaps has.
OF_GAPS = ("gap", "channel_wall")

#: Distance from one chamber to the next [mm].
PITCH = 12

#: Records of the rubbers.
ELASTOSIL = "elastosil-m4601/yeoh-mosadegh-2014"

#: How the studies describe these PneuNets.
SETUP = (
    "PneuNet {count}, 20 mm wide and 19 mm high, walls between chambers of 1.5 mm, gaps of 1 "
    "mm, other walls of 2 mm, floor and base of 1.5 mm each, of Elastosil M4601 (Yeoh, 0.11 and 0.02 MPa), with "
    "paper of "
    "0.1 mm between floor and base; one end fixed; walls touch"
)


def pneunet(
    chambers: int, changed: Mapping[str, Any] = MappingProxyType({}), family: str = "FastPneuNet"
) -> dict[str, Any]:
    """Family and dimensions [mm] of a PneuNet of so many chambers, with some of them changed.

    A slow PneuNet gets walls as thick as two walls of a fast one and the gap between them.

    Parameters
    ----------
    chambers : int
    changed : mapping of str to float
        Other dimensions [mm], angles [deg].
    family : str
        Name of the actuator.
    """
    out = dict(WALLS) | {"family": family, "chambers": chambers, "length": PITCH * chambers - WALLS["gap"]}
    if family == "SlowPneuNet":
        out = {name: value for name, value in out.items() if name not in OF_GAPS}
        out |= {"wall": 2 * WALLS["wall"] + WALLS["gap"]}
    return out | dict(changed)


def count_and_size(setting: Setting) -> tuple[int, float]:
    """Chambers of a PneuNet and size of its cells [mm]."""
    return (2, 6.0) if setting == "quick" else (4, 3.0)


def actuator_of(given: Mapping[str, Any]) -> Any:
    """Actuator, from its family, dimensions in mm and angles in degrees."""
    units = {"chambers": 1, "chamber_angle": deg}
    fields = {name: value * units.get(name, mm) for name, value in given.items() if name != "family"}
    return getattr(tg.actuators, given["family"])(**fields)


def model_of(
    given: Mapping[str, Any], size: float, pressure: float, rubbers: Mapping[str, str] | None = None
) -> tg.Model:
    """Model of a PneuNet with paper of 0.1 mm, in hexahedra.

    Parameters
    ----------
    given : mapping of str to str or float
        As `pneunet` makes it.
    size : float [mm]
        Size of the cells.
    pressure : float [kPa]
    rubbers : mapping of str to str, optional
        ``"material/record"`` by region; Elastosil M4601 where not given.

    Returns
    -------
    Model
    """
    paper = tg.from_library("paper", record="hooke-polygerinos-2020")
    materials: dict[str, Any] = {"strain_limiting_layer": tg.Shell(paper, thickness=0.1 * mm)}
    for region in ("body", "base"):
        name, record = (rubbers or {}).get(region, ELASTOSIL).split("/")
        materials[region] = tg.from_library(name, record=record)
    return tg.Model(
        tg.mesh(actuator_of(given).build(), size=size * mm, cells="hexahedra"),
        materials=materials,
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure * kPa)],
    )


def _bulge(at: Any) -> float:
    """Largest displacement sideways."""
    return float(np.abs(at.displacement[:, 1]).max())


#: How far the sides bulge: what a multi-chamber actuator has of radial extension.
BULGE = tg.measures.Measure(name="bulge", unit="mm", function=_bulge, definition="largest displacement along y")


def bend(
    given: Mapping[str, Any],
    size: float,
    pressure: float,
    until: float = 360.0,
    mesh_error: bool = True,
    rubbers: Mapping[str, str] | None = None,
) -> Computed:
    """Bend a PneuNet to a pressure [kPa] or an angle [deg], whichever comes first."""

    def far_enough(state: tg.solutions.State) -> str | None:
        return "bent far enough" if tg.bending_angle(state) > until * deg else None

    model = model_of(given, size, pressure, rubbers)
    solution = tg.solve(model, stop=far_enough, throw=False)
    measures = [tg.bending_angle, tg.cavity_volume, BULGE]
    measures += [] if "symmetry_y" in model.mesh.faces else [tg.measures.twist_angle]
    return Computed(response=tg.measure(solution, *measures, mesh_error=mesh_error), picture=picture_of(solution))


def push(given: Mapping[str, Any], size: float, pressure: float) -> Computed:
    """Let the tip push on a plate that stands where it is at rest, up to a pressure [kPa]."""
    model = tg.setups.blocked_force(model_of(given, size, pressure), direction="-z")
    solution = tg.solve(model, throw=False)
    return Computed(response=tg.measure(solution, tg.measures.blocked_force), picture=picture_of(solution))


def run_of(
    name: str,
    function: Callable[..., Computed],
    setting: Setting,
    pressure: float,
    values: Mapping[str, Any] = MappingProxyType({}),
) -> Run:
    """Run of `bend` or `push` up to a pressure [kPa]; other values override those of a fast PneuNet."""
    count, size = count_and_size(setting)
    return Run(
        name=name,
        function=function,
        values={"given": pneunet(count), "size": size, "pressure": pressure} | dict(values),
    )


def at_angle(response: tg.Response, name: str, angle: float, *, less_rest: bool = False) -> Value:
    """Value of a column where the actuator first reaches an angle [deg]; its mesh error comes from that of the angle.

    Parameters
    ----------
    response : Response
        With ``bending_angle``.
    name : str
    angle : float [deg]
    less_rest : bool
        Whether the value at rest is subtracted, for a volume that is let in.
    """
    column, angles = response.find(name), response.column("bending_angle") / deg
    values = column.in_unit - (column.in_unit[0] if less_rest else 0.0)
    reached = np.flatnonzero(angles >= angle)
    if not len(reached) or reached[0] == 0:
        return Value(np.nan, np.nan, column.unit)
    k = int(reached[0])
    steepness = (values[k] - values[k - 1]) / (angles[k] - angles[k - 1])
    number = float(values[k - 1] + steepness * (angle - angles[k - 1]))
    error = response.mesh_error("bending_angle")
    own = 0.0 if error is None else float(np.interp(angle, angles[: k + 1], error[: k + 1] / deg))
    return Value(number, abs(float(steepness)) * own, column.unit)
