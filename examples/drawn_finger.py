"""A finger of chambers that stand apart, drawn by a function: its arguments are dimensions of drawn_finger.toml.

netgen.occ comes with turgor; a function may as well return a part of build123d or CadQuery.
"""

from typing import Annotated

from netgen.occ import Box, Pnt, Solid

#: Outer width, and height of the chambers above the floor; height of the channel that joins them [mm].
WIDTH, HEIGHT, CHANNEL = 12.0, 10.0, 2.0


def build(
    chambers: int = 3,
    room: Annotated[float, "mm", (2, 20)] = 5,
    wall: Annotated[float, "mm", (0.5, 3)] = 1.5,
    gap: Annotated[float, "mm", (0.5, 5)] = 1.5,
    floor: Annotated[float, "mm", (1, 8)] = 2.5,
) -> Solid:
    """Draw the finger along x, with its floor below; lengths are in millimeters, and ``room`` is that of a chamber."""
    if chambers < 1:
        raise ValueError(f"chambers is {chambers}; one or more are needed")
    outer, pitch = room + 2 * wall, room + 2 * wall + gap
    length = chambers * pitch - gap
    solid = _box((0, length), WIDTH, (0, floor + CHANNEL + wall))
    air = _box((wall, length - wall), WIDTH / 3, (floor, floor + CHANNEL))
    for i in range(chambers):
        solid += _box((i * pitch, i * pitch + outer), WIDTH, (0, floor + HEIGHT))
        air += _box((i * pitch + wall, i * pitch + wall + room), WIDTH - 2 * wall, (floor, floor + HEIGHT - wall))
    return solid - air


def _box(x: tuple[float, float], width: float, z: tuple[float, float]) -> Solid:
    return Box(Pnt(x[0], -width / 2, z[0]), Pnt(x[1], width / 2, z[1]))
