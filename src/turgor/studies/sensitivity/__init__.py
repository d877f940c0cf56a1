"""Sensitivity: which inputs matter for a response, and how much."""
