"""Axisymmetric meshes: the meridian of a body of revolution, turned by a quarter, whose rings of nodes move alike."""
