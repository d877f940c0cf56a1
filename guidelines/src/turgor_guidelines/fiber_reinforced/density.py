"""Guidelines 7.2-1 to 7.2-4 on one set of tubes: what a density of hoops does, and how curves are drawn over it."""

import numpy as np

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.banded import inflated
from turgor_guidelines.guideline import Runs, Setting
from turgor_guidelines.values import Value, at, last

#: Pressure up to which the tubes are inflated [kPa].
PRESSURE = 50.0


def runs(setting: Setting) -> tuple[Run, ...]:
    """Tubes without hoops and with hoops every 16 to 2 mm."""
    return inflated(setting, PRESSURE)


def extension(runs: Runs, name: str, pressure: float = PRESSURE) -> Value:
    """How far the tip of a tube moved at a pressure [kPa]."""
    return at(runs[name].response, "tip_displacement_x", "pressure", pressure * kPa)


def injected(response: tg.Response) -> Value:
    """Volume that went into the cavity, in percent of its volume at rest."""
    volume = last(response, "cavity_volume")
    rest = response.find("cavity_volume").in_unit[0]
    return Value(100 * (volume.number / rest - 1), 100 * volume.error / rest, "%")


def along(response: tg.Response, name: str, drive: str, where: float) -> float:
    """Value of a column [SI] where another one, which rises, is at a number [SI]; not a number beyond its end."""
    return float(np.interp(where, response[drive], response[name], right=np.nan))


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Extension against pressure, volume against extension, and the largest stretch of the rubber."""
    curves = tuple((name, each.response) for name, each in runs.items())
    volumes = [
        tg.pictures.Line(
            x=each.response["tip_displacement_x"] / mm,
            y=100 * (each.response["cavity_volume"] / each.response["cavity_volume"][0] - 1),
            label=name,
        )
        for name, each in runs.items()
    ]
    return (
        tg.pictures.Panel(x="pressure", y="tip_displacement_x", responses=curves),
        tg.pictures.Panel(x="tip displacement x [mm]", y="injected volume [% of that at rest]", lines=volumes),
        tg.pictures.Panel(x="pressure", y="principal_stretch_p99", responses=curves),
    )
