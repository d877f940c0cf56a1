"""Plausibility: every magnitude of a model against the range of the field, before the solve."""
