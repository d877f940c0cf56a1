"""Convergence: what results on several meshes say about the error."""
