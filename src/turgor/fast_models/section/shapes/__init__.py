"""Shapes: what a section is made from, and the slice of hexahedra that it becomes."""
