"""Searches: in a trust region, and for a front."""
