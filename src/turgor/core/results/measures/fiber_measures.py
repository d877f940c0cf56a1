"""Measures of fibers and cables: tensions, how hard a winding holds the body, how far a cable is drawn in."""

from turgor.core.results.fields.cables import (
    end_tension,
    largest_tension,
    largest_travel,
    wire_martensite_of,
    wire_stress_of,
    wire_temperature_of,
)
from turgor.core.results.fields.fibers import maximum_tension
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.winding import winding_force

maximum_fiber_tension = Measure(
    name="maximum_fiber_tension", unit="N", function=maximum_tension,
    definition="largest tension of any thread, averaged over the sides of cells around each place",
)  # fmt: skip
winding_force_per_length = Measure(
    name="winding_force_per_length", unit="N/m", function=winding_force,
    definition="force of the threads around the axis for each current length along it, mean over the wound faces: of "
    "hoops the tension times threads per length",
)  # fmt: skip
cable_tension = Measure(
    name="cable_tension", unit="N", function=largest_tension,
    definition="tension of a cable at its motor, the largest of several",
)  # fmt: skip
cable_end_tension = Measure(
    name="cable_end_tension", unit="N", function=end_tension,
    definition="tension of a cable at its end, which friction leaves, the smallest of several",
)  # fmt: skip
cable_travel = Measure(
    name="cable_travel", unit="mm", function=largest_travel,
    definition="by how much the way of a cable through its guides is shorter than at rest, the largest of several",
)  # fmt: skip
wire_stress = Measure(
    name="wire_stress", unit="MPa", function=wire_stress_of,
    definition="stress of a shape-memory wire, the largest of several",
)  # fmt: skip
wire_martensite = Measure(
    name="wire_martensite", unit="", function=wire_martensite_of,
    definition="fraction of martensite of a shape-memory wire, the smallest of several",
)  # fmt: skip
wire_temperature = Measure(
    name="wire_temperature", unit="K", function=wire_temperature_of,
    definition="temperature of a shape-memory wire, the highest of several",
)  # fmt: skip
