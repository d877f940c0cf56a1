"""Plots: curves of responses, materials, fits and convergence studies."""
