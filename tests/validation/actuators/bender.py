"""The bending actuators of Moseley et al. 2016: a block of Ecoflex 00-30 with a row of chambers, closed by a film.

Axes: x from the held end to the tip, z up, the film at z = 0, the mirror plane at y = 0. A floor of rubber of 0.5 mm
lies on the film, because a cavity needs walls of rubber; its share is one of the variations.
"""

from typing import Any

import numpy as np
from ecoflex import material

import turgor as tg
from turgor.response import Column
from turgor.source import Source
from turgor.study.runs import Computed
from turgor.units import MPa, N, kPa, mm

CHAMBER, HEIGHT, WIDTH, CHANNEL, DENSITY = 2 * mm, 8 * mm, 8 * mm, 2 * mm, 1070.0
SOURCE = Source(text="turgor, half of the actuator")
#: The film as its authors model it: a membrane of silk.
FILM = {"modulus_MPa": 4100.0, "thickness_mm": 0.5, "form": "wrinkles"}
POINTS = ("tip_bottom", "tip_middle", "tip_top", "base_bottom", "base_top")


def actuator(chambers: int, *, wall: float = 7 * mm, floor: float = 0.5 * mm, clamp: float = 0.0) -> Any:
    """Half of an actuator with the dimensions of the geometry script of the authors."""
    return tg.actuators.SlowPneuNet(
        chambers=chambers,
        length=chambers * CHAMBER + (chambers + 1) * wall,
        width=WIDTH + 2 * wall,
        height=floor + HEIGHT + wall,
        wall=wall,
        side_wall=wall,
        top_wall=wall,
        end_wall=wall,
        floor=floor,
        base=0.0,
        channel_width=CHANNEL,
        channel_height=CHANNEL,
        clamp_length=clamp,
    )


def layer(film: dict[str, Any]) -> tg.Membrane:
    """The film: ``"wrinkles"`` bears tension only, ``"membrane"`` compression too, ``"shell"`` bends as a plate."""
    silk = tg.Material(name="film", law=tg.laws.Hooke(E=film["modulus_MPa"] * MPa, nu=0.49))
    how = {"wrinkles": {"compression": 0.0}, "membrane": {}, "shell": {"bending": True}}[film["form"]]
    return tg.Membrane(silk, film["thickness_mm"] * mm, **how)
