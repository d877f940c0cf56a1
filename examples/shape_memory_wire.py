"""A shape-memory wire along one side bends a soft bar when a current heats it, and the bar stretches it again, cold.

The heated wire contracts by the strain by which it was stretched before it was mounted. The bar bends and becomes
shorter, as the warm layer of a bimetal makes it. A rigid plate at the end takes the wire: a knot in soft rubber would
give way.
"""

from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

LENGTH, SIDE, STRAIN = 80 * mm, 8 * mm, 0.04

bar = tg.bodies.Block(length=LENGTH, width=SIDE, height=SIDE, mirrors="y")
mesh = tg.mesh(bar.build(), size=5 * mm)
sides = mesh.faces["ends"]
at_tip = mesh.points[sides].mean(axis=1)[:, 0] > 0
mesh = replace(mesh, faces={**mesh.faces, "ends": sides[~at_tip], "tip": sides[at_tip]})
supports = [tg.Fixed("ends"), tg.supports.ReferencePoint("plate", "tip")]
rubber = tg.Material(name="silicone", law=tg.laws.NeoHooke(C10=60 * kPa))
guides = [(x, 0, SIDE / 2) for x in np.linspace(-LENGTH / 2, LENGTH / 2, 9)]
wire = tg.loads.ShapeMemoryWire(
    through=guides, diameter="0.1 mm", alloy="nitinol-brinson-1993", strain=STRAIN, temperature="70 °C"
)
state = tg.solve(tg.Model(mesh, {"body": rubber}, supports, [wire])).states[-1]

angle = float(np.arcsin(state.points["plate"].rotation[2, 0]))
(result,) = tg.measures.cable_results(state)

# Thin bar: the wire, at e from the axis, is shorter by κ e where the bar bends and by κ I / (A e) where it is pressed.
distance, shorter = SIDE / 2, STRAIN / (1 + STRAIN)
curvature = shorter / (distance + SIDE**2 / 12 / distance)
formula = curvature * LENGTH
print(f"{angle / deg:.1f} deg, a thin bar {formula / deg:.1f} deg; {result.tension[0]:.2f} N in the wire.")
assert result.phases is not None and result.phases.martensite == 0, "the wire is all austenite"
assert abs(angle - formula) < 0.03 * formula
