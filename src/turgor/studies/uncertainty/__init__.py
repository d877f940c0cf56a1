"""Uncertainty: the spread of materials, dimensions and pressures carried to the response."""
