"""Speed of sections against what is asked for: python benchmarks/fast_models/sections.py.

Twenty pressures on the default mesh of each family that has a uniform cross-section, in CPU seconds of one thread,
without the estimate of the mesh error; the kernels are compiled before. Exit code 1 where the limit is passed.
"""

import sys
from time import process_time

import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

#: CPU seconds for twenty pressures.
LIMIT = 3.0

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
THREAD = tg.Material(name="thread", law=tg.laws.Hooke(E=31067e6, nu=0.36))

#: Families by name, their largest pressure [kPa], and the angle of their threads from the axis [°].
CASES = (
    ("EccentricBender", 40, None),
    ("TwoMaterialBender", 30, None),
    ("RectangularBender", 20, None),
    ("SemicircularBender", 10, None),
    ("OmnidirectionalActuator", 6, None),
    ("BidirectionalBender", 30, None),
    ("ExtendingCylinder", 20, None),
    ("TwistingTube", 30, 60),
    ("FiberReinforcedCylinder", 30, 90),
)


def section_of(name: str, angle: float | None) -> tg.Section:
    """The section of a family with all regions of one rubber, and threads around its outside."""
    actuator = getattr(tg.actuators, name)()
    face = "winding" if "winding" in actuator.build().faces else "outside"
    fibers = []
    if angle is not None:
        winding = tg.Winding(angle_from_axis=angle * deg, spacing=2 * mm)
        fibers = [tg.Fibers(face=face, material=THREAD, diameter=0.1778 * mm, winding=winding, compression=1.0)]
    return tg.Section(actuator, dict.fromkeys(actuator.build().regions, RUBBER), reinforcements=fibers)


def main() -> int:
    section_of("TwistingTube", 60).solve(1 * kPa)  # compiles
    slow = 0
    for name, most, angle in CASES:
        section = section_of(name, angle)
        began = process_time()
        solution = section.solve(np.arange(1, 21) / 20 * most * kPa, mesh_error=False)
        took = process_time() - began
        slow += took > LIMIT
        rows, cells = len(solution.response), len(section.model.mesh.cells)
        late = " TOO SLOW" if took > LIMIT else ""
        print(f"{name}: {rows} pressures to {most} kPa on {cells} cells, {took:.2f} CPU s (limit {LIMIT:g} s){late}")
    return int(slow > 0)


if __name__ == "__main__":
    sys.exit(main())
