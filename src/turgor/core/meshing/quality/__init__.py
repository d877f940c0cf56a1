"""Mesh quality: shape of cells, checks of a mesh, and walls that face each other."""
