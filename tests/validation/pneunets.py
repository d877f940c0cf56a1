"""PneuNets of the targets that need contact: bent until the tip has turned far enough, or pushing on a plate.

Elastosil M4601 as Mosadegh et al. 2014 state it (Yeoh, 0.11 and 0.02 MPa), and paper of 0.1 mm half way up the base.
The paper is a shell, in hexahedra: as a membrane, which bends freely, it wrinkles below the floor of the slow PneuNet
at 45 kPa and 29°, where the path ends in a fold. The fixed end is held, the procedure is the default one.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import turgor as tg
from turgor.core.engine.faces.surfaces import vector_area
from turgor.job.job import Actuator
from turgor.units import deg, kPa, mm

Array = NDArray[np.float64]

EXAMPLE = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"

#: The reference geometry of the targets: eight chambers of 8 x 16 x 14 mm inside, every 12 mm.
ENVELOPE: dict[str, Any] = {
    "chambers": 8,
    "length": 95 * mm,
    "width": 20 * mm,
    "height": 19 * mm,
    "end_wall": 1.5 * mm,
    "channel_width": 3 * mm,
    "channel_height": 3 * mm,
}
#: The walls between its chambers: two of 1.5 mm and a gap of 1 mm, or the gap filled.
FAST = ENVELOPE | {"wall": 1.5 * mm, "gap": 1 * mm, "channel_wall": 1.5 * mm}
SLOW = ENVELOPE | {"wall": 4 * mm}


@dataclass(frozen=True, slots=True)
class Curve:
    """What was measured along a path: pressure [kPa], bending angle [°], volume of the cavity [mL]; the solution."""

    pressure: Array
    angle: Array
    volume: Array
    solution: tg.Solution

    def at_angle(self, angle: float) -> tuple[float, float]:
        """Pressure [kPa] at which the tip has first turned so far [°], and the volume [mL] let in; nan if never."""
        k = int(np.argmax(self.angle >= angle))
        if not self.angle[k] >= angle:
            return float("nan"), float("nan")
        share = (angle - self.angle[k - 1]) / (self.angle[k] - self.angle[k - 1])
        between = [values[k - 1] + share * (values[k] - values[k - 1]) for values in (self.pressure, self.volume)]
        return between[0], between[1] - self.volume[0]

    def r_squared(self) -> float:
        """Of a straight line through the angles, sampled evenly over the pressures."""
        at = np.linspace(0, self.pressure[-1], 41)
        angle = np.interp(at, self.pressure, self.angle)
        line = np.polyval(np.polyfit(at, angle, 1), at)
        return float(1 - ((angle - line) ** 2).sum() / ((angle - angle.mean()) ** 2).sum())


def model_of(actuator: Actuator, *, size: float, pressure: float, contact: tg.Contact | None = None) -> tg.Model:
    """Mesh an actuator with hexahedra of a size [mm] and ask for a pressure [kPa]."""
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    paper = tg.from_library("paper", record="hooke-polygerinos-2020")
    return tg.Model(
        tg.mesh(actuator.build(), size=size * mm, cells="hexahedra"),
        materials={
            "body": rubber,
            "base": rubber,
            "strain_limiting_layer": tg.Shell(paper, thickness=0.1 * mm),
        },
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure * kPa)],
        contact=contact or tg.Contact(),
    )


def demo(*, size: float, pressure: float, contact: tg.Contact | None = None) -> tg.Model:
    """The model of examples/fast_pneunet.toml, tetrahedra and a membrane, at another size [mm] and pressure [kPa]."""
    job = tg.jobs.read_job(EXAMPLE)
    return tg.Model(
        tg.mesh(job.actuator.build(), size=size * mm),
        materials=job.materials,
        supports=job.supports,
        loads=[tg.Pressure("cavity", pressure * kPa)],
        contact=contact or tg.Contact(),
    )


def bend(model: tg.Model, *, until: float = 360.0, procedure: tg.Static | None = None) -> Curve:
    """Raise the pressure until the tip has turned so far [°], or the pressure is reached, or it goes no further."""
    turned = [0.0]

    def stop(state: tg.solutions.State) -> str | None:
        mesh = state.model.mesh
        area = vector_area(mesh.points + state.displacement, mesh.face("tip"))
        turned.append(float(np.unwrap([turned[-1], np.arctan2(-area[2], area[0])])[1]))
        return "bent far enough" if turned[-1] > until * deg else None

    solution = tg.solve(model, procedure, stop=stop, throw=False)
    response = tg.measure(solution, tg.bending_angle, tg.cavity_volume, mesh_error=False)
    columns = (response.column(name) for name in ("pressure", "bending_angle", "cavity_volume"))
    pressure, angle, volume = columns
    return Curve(pressure / kPa, angle / deg, volume * 1e6, solution)


def push(model: tg.Model) -> float:
    """Force [N] of the tip on a plate that stands where the tip is at rest, at the whole pressure."""
    solution = tg.solve(tg.setups.blocked_force(model, direction="-z"))
    return float(tg.measure(solution, tg.measures.blocked_force, mesh_error=False).column("blocked_force")[-1])
