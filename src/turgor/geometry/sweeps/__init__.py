"""Families told as sweeps, for meshes of hexahedra."""
