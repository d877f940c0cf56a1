"""Swept meshes: a section cut into quadrilaterals, moved along a path into 27-node hexahedra."""
