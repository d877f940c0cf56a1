"""Calibration: parameters of a model fitted to experiments, with how well they are determined."""
