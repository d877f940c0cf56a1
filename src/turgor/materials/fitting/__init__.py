"""Fitting: coefficients of laws from tests, the ranking of laws, and files of what was fitted."""
