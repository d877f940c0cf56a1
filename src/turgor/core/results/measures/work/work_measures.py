"""Measures of work and stiffness: injected volume, work, energy, efficiency, and the stiffness of the tip."""

import numpy as np

from turgor.core.engine.fields import strain_energy as stored_energy
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.work.fluid import fluid_works, injected
from turgor.core.results.measures.work.outside import efficiencies, outside_works
from turgor.core.results.measures.work.tip_stiffness import across_the_model, tip_compliance
from turgor.foundation.errors import TurgorError


def _strain_energy(at: StateFields) -> float:
    state = at.state
    fields = (state.displacement, state.mean_stress, state.memory, state.points)
    stored = stored_energy(at.model, *fields, state.load_factor)
    return at.mesh.symmetry_factor * stored


def _tip_stiffness(at: StateFields) -> float:
    """Smallest over all directions within the planes of symmetry: the softest one has the largest compliance."""
    whole = [axis for axis in range(3) if axis not in across_the_model(at)]
    compliance = tip_compliance(at)[np.ix_(whole, whole)]
    return 1 / float(np.linalg.eigvalsh((compliance + compliance.T) / 2)[-1])


def _of_path(at: StateFields) -> float:
    raise TurgorError("it is a sum along a path.")


def _along(axis: str) -> Measure:
    """Make the measure of the stiffness of the tip along an axis."""
    number = "xyz".index(axis)

    def stiffness(at: StateFields) -> float:
        if number in across_the_model(at):
            raise TurgorError(
                f"a force along {axis} does not fit a model that is cut by a plane across it; model the whole actuator "
                "(symmetric = false)."
            )
        return 1 / float(tip_compliance(at)[number, number])

    return Measure(
        name=f"tip_stiffness_{axis}", unit="N/m", function=stiffness, faces=("tip",),
        definition=f"small force on the face tip along {axis} over the mean displacement of the face along {axis} that "
        "it causes, the tip being free to move sideways and pressures constant; whole actuator",
    )  # fmt: skip


injected_volume = Measure(
    name="injected_volume", unit="mL", function=injected, faces=("cavity",),
    definition="volume by which the faces cavity* have grown since rest, whole actuator: what a pump of liquid has "
    "injected",
)  # fmt: skip
fluid_work = Measure(
    name="fluid_work", unit="mJ", function=_of_path, along=fluid_works, faces=("cavity",),
    definition="work of the pressures in all cavities, ∫ p dV along the path by the trapezoidal rule, whole actuator",
)  # fmt: skip
strain_energy = Measure(
    name="strain_energy", unit="mJ", function=_strain_energy,
    definition="energy stored in rubber, layers, fibers and springs, whole actuator",
)  # fmt: skip
outside_work = Measure(
    name="outside_work", unit="mJ", function=_of_path, along=outside_works,
    definition="work of the actuator on dead forces, hanging weights, obstacles and faces that are moved, along the "
    "path by the trapezoidal rule, whole actuator; its own weight left out",
)  # fmt: skip
efficiency = Measure(
    name="efficiency", unit="", function=_of_path, along=efficiencies, faces=("cavity",),
    definition="work on outside loads over work of the fluid, both since rest; only where there is an outside load",
)  # fmt: skip
tip_stiffness = Measure(
    name="tip_stiffness", unit="N/m", function=_tip_stiffness, faces=("tip",),
    definition="stiffness of the face tip against a small force in the direction in which it yields most, pressures "
    "constant, whole actuator; of a half only directions within its mirror plane count",
)  # fmt: skip
tip_stiffness_x, tip_stiffness_y, tip_stiffness_z = map(_along, "xyz")
