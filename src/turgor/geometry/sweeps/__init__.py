"""Actuator families described as sweeps, for meshes of hexahedra."""
