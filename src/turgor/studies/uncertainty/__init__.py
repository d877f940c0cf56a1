"""Uncertainty: the spread of materials, dimensions and pressures propagated to the response."""
