"""The measured bending actuators of Moseley et al. 2016, and what is read off measured and computed curves alike."""

import numpy as np
from bender import LINE, angles
from ecoflex import FOLDER
from measured_tables import numbers

import turgor as tg
from turgor.units import N, kPa

#: Angle [deg] at which the pressure is compared, where the chambers have begun to balloon.
TURN = {5: 15.0, 7: 20.0}
#: Pressure before that [kPa], up to which angles are compared.
SOFT = 34.0


def measured_free(chambers: int) -> dict[str, np.ndarray]:
    """Pressure [kPa], angle and its standard deviation in a bin of 0.5 kPa [deg], as published: zero at 10 kPa."""
    rows = numbers(FOLDER / f"actuator_c{chambers}-w7_free_bending_means.csv")
    return {"pressure": rows["pressure_kPa"], "angle": rows["bending_angle_deg"], "sd": rows["bending_angle_sd_deg"]}


def repeated_free() -> dict[str, np.ndarray]:
    """The second test of the actuator with 7 chambers, in steps."""
    rows = numbers(FOLDER / "actuator_c7-w7_free_bending_stepwise.csv")
    return {"pressure": rows["pressure_kPa"], "angle": rows["bending_angle_deg"]}


def measured_blocked(chambers: int, wall_mm: float = 7.0) -> dict[str, np.ndarray]:
    """Pressure [kPa], force less the force of the rest before it, and its standard deviation [N], by pressure."""
    rows = numbers(FOLDER / f"actuator_c{chambers}-w{wall_mm:.0f}_blocked_force_steps.csv")
    force = rows["force_mean_N"] - rows["preceding_rest_force_N"]
    steps = np.unique(rows["pressure_kPa"])
    means = np.array([force[rows["pressure_kPa"] == each].mean() for each in steps])
    sd = np.array([rows["force_sd_N"][rows["pressure_kPa"] == each].mean() for each in steps])
    return {"pressure": steps, "force": means, "sd": sd}


def from_zero(response: tg.Response, *, line: str = LINE, zero: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    """Pressure [kPa] and angle [deg] along the whole path, less the angle at ``zero``."""
    pressure, angle = angles(response, line)
    first = int(np.argmax(pressure))  # the part before the maximum has one angle for each pressure
    return pressure, angle - np.interp(zero, pressure[: first + 1], angle[: first + 1])


def pressure_at(pressure: np.ndarray, angle: np.ndarray, wanted: float) -> float:
    """Pressure at which an angle is first reached [kPa]; nan where it is not."""
    reached = np.flatnonzero(angle >= wanted)
    if not len(reached) or reached[0] == 0:
        return float("nan")
    last = int(reached[0])
    return float(np.interp(wanted, angle[last - 1 : last + 1], pressure[last - 1 : last + 1]))


def angle_at(pressure: np.ndarray, angle: np.ndarray, wanted: float) -> float:
    """Angle at a pressure that rises [deg]; nan beyond the highest one."""
    top = int(np.argmax(pressure))
    return float(np.interp(wanted, pressure[: top + 1], angle[: top + 1], right=np.nan))


def soft_distance(curve: tuple[np.ndarray, np.ndarray], chambers: int) -> float:
    """RMS difference of a curve of `from_zero` from 10 to 34 kPa, over the measured range of the angle there [-]."""
    data = measured_free(chambers)
    used = data["pressure"] <= SOFT
    got = np.array([angle_at(*curve, each) for each in data["pressure"][used]])
    there = np.isfinite(got)
    off = got[there] - data["angle"][used][there]
    return float(np.sqrt(np.mean(off**2)) / np.ptp(data["angle"][used]))


def forces(response: tg.Response) -> tuple[np.ndarray, np.ndarray]:
    """Pressure [kPa] and blocked force [N]."""
    return response.column("pressure") / kPa, response.column("blocked_force") / N


def measured_rest_force(chambers: int, wall_mm: float = 7.0) -> float:
    """What the cell shows before the first step [N]."""
    rows = numbers(FOLDER / f"actuator_c{chambers}-w{wall_mm:.0f}_blocked_force_steps.csv")
    return float(rows["preceding_rest_force_N"][0])


def blocked_distance(
    curve: tuple[np.ndarray, np.ndarray], chambers: int, wall_mm: float = 7.0, upto: float = np.inf
) -> tuple[float, float]:
    """RMS difference of a curve of `forces`, as far as it goes, over the range measured there [-]; how far [kPa]."""
    data = measured_blocked(chambers, wall_mm)
    pressure, force = curve
    used = data["pressure"] <= min(pressure.max() + 1e-6, upto)
    off = np.interp(data["pressure"][used], pressure, force) - data["force"][used]
    return float(np.sqrt(np.mean(off**2)) / np.ptp(data["force"][used])), float(data["pressure"][used].max())
