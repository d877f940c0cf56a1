"""Geometry: solids with named regions and faces, one actuator family per file."""

from turgor.geometry.fast_pneunet import FastPneuNet
from turgor.geometry.geometry import Geometry

__all__ = ["FastPneuNet", "Geometry"]
