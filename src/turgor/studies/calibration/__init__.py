"""Calibration: parameters of a model fitted to experiments, with their standard errors."""
