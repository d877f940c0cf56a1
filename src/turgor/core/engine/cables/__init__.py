"""Cables: tendons with friction and shape-memory wires, through guides on the surface."""
