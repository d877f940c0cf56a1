"""Gradients: derivatives of measures with respect to the numbers of a model, at an equilibrium."""
