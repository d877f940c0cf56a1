"""Speed of the formulas, against what is asked for: python benchmarks/fast_models/formulas.py.

Each number is the least CPU time of several calls after a first one, which compiles the derivatives of the law. Closed
forms may take 1 ms for a whole path; the others search for an equilibrium at every pressure, and may take 1 ms for
each. Exit code 1 where a limit is passed.
"""

import sys
from collections.abc import Callable
from time import process_time

import numpy as np

import turgor as tg
from turgor.foundation.response import Column
from turgor.units import deg, kPa, mm

F = tg.formulas
CALLS = 20


def best(work: Callable[[], object]) -> float:
    """Shortest of several calls [s]."""
    work()
    taken = []
    for _ in range(CALLS):
        began = process_time()
        work()
        taken.append(process_time() - began)
    return min(taken)


def rows() -> tuple[tuple[str, float, Callable[[], object]], ...]:
    rubber = tg.Material(name="rubber", law=tg.Yeoh(C10=0.11e6, C20=0.02e6))
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=31067e6, nu=0.36))
    helix = tg.Winding(angle_from_axis=60 * deg, spacing=2 * mm)
    braid = tg.Winding(angle_from_axis=25 * deg, spacing=2 * mm, hand="both")
    wound, braided = (
        tg.Fibers(face="outside", material=thread, diameter=0.1778 * mm, winding=each) for each in (helix, braid)
    )
    tube, bender = tg.actuators.ExtendingCylinder(), tg.actuators.FiberReinforcedBender()
    muscle, bellows = tg.actuators.ContractingTube(), tg.actuators.BellowsOfRevolution()
    twenty = np.linspace(0, 30, 20) * kPa
    angle = tg.Response(columns=(Column("bending_angle", "deg", [1.0]),), source=tg.laws.Source(text="a ruler"))
    stretches = np.linspace(1, 2, 20)
    ball = F.HollowSphere(inner_radius=10 * mm, wall=5 * mm)
    arc = F.Arc(curvature=10.0, plane=0.3, length=0.1)
    closed, searched = 1e-3, 20e-3
    return (
        ("pose of an arc", closed, lambda: F.pose(arc)),
        ("arc to a position", closed, lambda: F.arc_to([0.1, 0.02, 0.03])),
        ("constant curvature, one angle", closed, lambda: F.constant_curvature(bender, angle)),
        ("Euler-Bernoulli, 20 pressures", closed, lambda: F.euler_bernoulli(bender, rubber, twenty)),
        ("ideal McKibben, 20 pressures", closed, lambda: F.ideal_mckibben(muscle, braided, twenty)),
        ("Castigliano, 20 pressures", closed, lambda: F.castigliano_bellows(bellows, rubber, twenty)),
        ("thick sphere, 20 stretches", closed, lambda: F.thick_sphere(ball, rubber, inner_stretch=stretches)),
        (
            "thick tube, held, 20 stretches",
            closed,
            lambda: F.thick_tube(tube, rubber, inner_stretch=stretches, ends="fixed"),
        ),
        ("thick tube, free, 20 pressures", searched, lambda: F.thick_tube(tube, rubber, twenty)),
        ("fiber-reinforced bender, 20 pressures", searched, lambda: F.fiber_reinforced_bender(bender, rubber, twenty)),
        ("thick McKibben, 20 pressures, free", searched, lambda: F.mckibben(muscle, rubber, braided, twenty)),
        ("wound tube, 20 pressures", searched, lambda: F.wound_tube(tube, rubber, wound, twenty)),
    )


def main() -> int:
    slow = 0
    for text, limit, work in rows():
        took = best(work)
        slow += took > limit
        print(f"{text}: {1e3 * took:.3f} ms (limit {1e3 * limit:g} ms){' TOO SLOW' if took > limit else ''}")
    return int(slow > 0)


if __name__ == "__main__":
    sys.exit(main())
