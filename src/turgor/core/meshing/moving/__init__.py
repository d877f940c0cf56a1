"""Moving: the nodes of a mesh of tetrahedra follow its CAD shape when a dimension changes."""
