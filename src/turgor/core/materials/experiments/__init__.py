"""Experiments: tests on materials, read from tables and prepared for fitting."""
