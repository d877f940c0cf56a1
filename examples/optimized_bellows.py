"""Stroke against force: bellows of 32 mm, from the one that pushes most to the one that extends most."""

import turgor as tg
from turgor.units import N, kPa, mm

RUBBER = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
START = {"inner_radius": 8 * mm, "wall": 2.2 * mm}


def bellows(inner_radius, wall):
    shape = tg.actuators.BellowsOfRevolution(outer_radius=16 * mm, pitch=8 * mm, inner_radius=inner_radius, wall=wall)
    return tg.formulas.castigliano_bellows(shape, RUBBER, [1 * kPa, 2 * kPa])


found = tg.optimize(
    bellows,
    [
        tg.studies.Factor(name="inner_radius", low=5 * mm, high=11 * mm, unit="mm"),
        tg.studies.Factor(name="wall", low=1.5 * mm, high=2.5 * mm, unit="mm"),
    ],
    [
        tg.studies.Maximize("blocked_force"),
        tg.studies.Maximize("tip_displacement_x"),
        tg.studies.Limit("wall", least=1.8 * mm),
    ],
    start=START,
    search=tg.studies.Search(most_solves=60),
)
strong, far = (found.reads(found.pareto[end]) for end in (0, -1))
print(found.message)
print(f"The strongest pushes with {strong[0].value / N:.2f} N and extends by {strong[1].value / mm:.2f} mm,")
print(f"the softest pushes with {far[0].value / N:.2f} N and extends by {far[1].value / mm:.2f} mm.")

# One number to remember: the neck of the strongest is as wide as its range allows.
assert found.converged and abs(strong[0].value - 1.06) < 0.03, "the strongest pushes with 1.06 N at 2 kPa"
