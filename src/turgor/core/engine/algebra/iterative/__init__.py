"""Iterative: GMRES with a preconditioner of two levels, for large tangents that are not to be factored."""
