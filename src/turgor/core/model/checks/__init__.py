"""Checks that a model makes of itself."""
