"""PneuNets of the guidelines: one rubber, paper in the base, the fixed end held."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import turgor as tg
from turgor.units import mm

#: Section and walls that the studies share, those of a fast PneuNet.
WALLS: Mapping[str, Any] = MappingProxyType(
    {
        "width": 20 * mm,
        "height": 19 * mm,
        "wall": 1.5 * mm,
        "channel_wall": 1.5 * mm,
        "end_wall": 1.5 * mm,
        "gap": 1 * mm,
        "channel_width": 3 * mm,
        "channel_height": 3 * mm,
    }
)


def pneunet(actuator: tg.FastPneuNet | tg.actuators.SlowPneuNet, size: float, pressure: float) -> tg.Model:
    """Model of a PneuNet of Elastosil M4601 with paper of 0.1 mm, in hexahedra.

    Parameters
    ----------
    actuator : FastPneuNet or SlowPneuNet
    size : float [mm]
        Size of the cells.
    pressure : float [Pa]

    Returns
    -------
    Model
    """
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    paper = tg.from_library("paper", record="hooke-polygerinos-2020")
    return tg.Model(
        tg.mesh(actuator.build(), size=size * mm, cells="hexahedra"),
        materials={
            "body": rubber,
            "base": rubber,
            "strain_limiting_layer": tg.Membrane(paper, thickness=0.1 * mm, bending=True),
        },
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure)],
    )
