"""Law: how the volume of a chamber and its pressure follow from one coordinate."""

from typing import Protocol


class Law(Protocol):
    """Pressure and volume of a chamber along a coordinate in which the amount of fluid rises.

    The coordinate of a rigid vessel is its pressure, that of an elastic chamber its volume, so that the pressure may
    fall while the chamber grows.
    """

    def at(self, place: float, time: float) -> tuple[float, float, float, float]:
        """Gauge pressure [Pa], volume [m³], and their derivatives by the coordinate."""

    def work(self, place: float, ambient: float) -> float:
        """Integral of the absolute pressure over the volume [J]."""

    def place(self, pressure: float, time: float) -> float:
        """Coordinate at a gauge pressure [Pa]."""

    def bounds(self, ambient: float) -> tuple[float, float]:
        """Coordinates between which states are searched."""

    def rate(self, time: float) -> float:
        """Rate of the volume that does not follow from the pressure [m³/s]."""

    def outside(self, place: float) -> str:
        """Say how a state lies outside of what is known of the chamber; empty where it does not."""
