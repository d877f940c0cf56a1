"""Segments of constant strain in SoRoMoX: `python soromox_robot.py segments.json`, with soromox 0.5 installed.

Makes a robot of the file that `turgor export FILE.reduced --to soromox` writes, and compares its tip with turgor's.
"""

import json
import sys
from pathlib import Path

import numpy as np

from turgor.systems.robots.strains import placed


def robot_of(numbers: dict, damping_time: float = 0.05):
    """A robot of SoRoMoX whose controls are pressures in Pa."""
    import jax
    import jax.numpy as jnp
    from soromox.actuation.joint import (
        AffineGeneralizedCoordinateActuator,
        AffineGeneralizedCoordinateActuatorParams,
        AffineGeneralizedCoordinateTransmissionParams,
    )
    from soromox.systems.components import ContinuumLinkParams, CrossSectionParams
    from soromox.systems.pcs import PCS, PCSParams, PCSStructure

    jax.config.update("jax_enable_x64", True)
    of = {key: jnp.asarray(value) for key, value in numbers.items() if isinstance(value, list) and key != "pressures"}
    link = ContinuumLinkParams(
        length=of["lengths"], density=of["density"], reference_strain=of["rest"], stiffness=of["stiffness"],
        cross_section=CrossSectionParams(of["radius"][:, None]), damping=damping_time * of["stiffness"],
    )  # fmt: skip
    active, count = of["active"].ravel(), len(numbers["pressures"])
    pressures = AffineGeneralizedCoordinateActuatorParams(
        transmission=AffineGeneralizedCoordinateTransmissionParams(
            routing_matrix=of["routing"].reshape(count, -1)[:, active],
            reference_configuration=jnp.zeros(int(active.sum())),
            coordinate_offset=jnp.zeros(count),
        ),
        lower_bounds=jnp.zeros(count), upper_bounds=jnp.full(count, jnp.inf),
    )  # fmt: skip
    return PCS(
        PCSParams(link=link, gravity=jnp.zeros(3)), PCSStructure(strain_selector=active),
        actuators=AffineGeneralizedCoordinateActuator(params=pressures),
        base_pose=jnp.asarray([0.0, 0.0, 0.0, 1.0, *numbers["base"]]),
    )  # fmt: skip


def tips(numbers: dict, pressures: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tip of the robot of SoRoMoX at its equilibrium, and that of turgor's segments."""
    robot = robot_of(numbers)
    routing = np.asarray(robot.actuators[0].params.transmission.routing_matrix)
    q = np.linalg.solve(np.asarray(robot.stiffness_matrix()), routing.T @ pressures)
    end = robot.forward_kinematics(q, np.sum(numbers["lengths"]))
    strains = np.array(numbers["rest"])
    strains[np.array(numbers["active"])] += q
    return np.asarray(end)[:3, 3], placed(np.array(numbers["base"]), np.array(numbers["lengths"]), strains)


if __name__ == "__main__":
    read = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    worst = 0.0
    for share in np.linspace(0.05, 1, 20):
        ours, theirs = tips(read, share * np.array(read["largest_pressures"]))
        worst = max(worst, float(np.linalg.norm(ours - theirs)))
    print(f"tip of SoRoMoX within {1e3 * worst:.2g} mm of turgor's segments at 20 pressures")
