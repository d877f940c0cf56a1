"""Convergence: estimate the error from results on several meshes."""
