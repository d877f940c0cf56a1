"""Sweeps of actuator families, for meshes of hexahedra."""
