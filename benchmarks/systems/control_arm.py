"""The three-chamber actuator of the benchmark of control, and its reduced models.

An omnidirectional actuator of Ecoflex 00-30, 60 mm long. Without fibers it balloons before it bends far, unless it is
slender: so its diameter is 5 mm. Its mesh is that of an actuator of a third of its length, stretched along the axis.
"""

from dataclasses import replace
from itertools import permutations
from pathlib import Path

import numpy as np

import turgor as tg
from turgor.core.model.model import Model
from turgor.reduced.reduce import Budget
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.path_runs import PathRuns
from turgor.units import kPa, mm

LENGTH, STRETCH, PRESSURE = 60 * mm, 3.0, 12.3 * kPa
CAVITIES = ("cavity_1", "cavity_2", "cavity_3")
KEYS = tuple(f"loads.{name}.pressure" for name in CAVITIES)
#: Training begins at the corners, and goes on between one and two chambers, and with some pressure in all of them.
AIMS = (*permutations((1.0, 0.5, 0.0)), *sorted(set(permutations((1.0, 0.5, 0.5)))))
OPTIONS = tg.EngineOptions(threads=1)


def arm() -> Model:
    """Make the full model."""
    actuator = tg.actuators.OmnidirectionalActuator(
        chamber_shape="semicircular_flat_inward", outer_radius=2.5 * mm, chamber_size=2.25 * mm, wall=0.5 * mm,
        length=LENGTH / STRETCH, cap=2 * mm / STRETCH,
    )  # fmt: skip
    mesh = tg.mesh(actuator.build(), size=2 * mm, quality="draft")
    return tg.Model(
        mesh=replace(mesh, points=mesh.points * np.array([STRETCH, 1.0, 1.0])),
        materials={"body": tg.from_library("ecoflex-00-30", record="yeoh-steck-2019")},
        supports=(tg.Fixed("fixed"),),
        loads=tuple(tg.Pressure(name, 1 * kPa) for name in CAVITIES),
    )


def trained(folder: Path, modes: int, processes: int = 1) -> Reduced:
    """Train a reduced model, or read the one in a folder."""
    file = folder / f"arm-{modes}.reduced"
    if not file.exists():
        budget = Budget(error=0.002, paths=7 + len(AIMS), held_out=1, modes=modes, steps=10, aims=AIMS)
        ranges = dict.fromkeys(KEYS, (0.0, PRESSURE))
        tg.reduce(arm(), ranges, budget=budget, options=OPTIONS, runs=PathRuns(folder, processes), say=print).save(file)
    return Reduced.load(file)


if __name__ == "__main__":
    import sys

    trained(Path(sys.argv[1]), int(sys.argv[2]))
