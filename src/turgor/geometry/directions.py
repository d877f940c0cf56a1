"""Directions along the axes, by their names in selectors, obstacles, windings and job files."""

from collections.abc import Mapping
from types import MappingProxyType

Vector = tuple[float, float, float]

#: The three axes, by name.
AXES: Mapping[str, Vector] = MappingProxyType({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)})

#: The six directions along them, by name with a sign.
DIRECTIONS: Mapping[str, Vector] = MappingProxyType(
    {
        "+x": (1.0, 0.0, 0.0),
        "-x": (-1.0, 0.0, 0.0),
        "+y": (0.0, 1.0, 0.0),
        "-y": (0.0, -1.0, 0.0),
        "+z": (0.0, 0.0, 1.0),
        "-z": (0.0, 0.0, -1.0),
    }
)
