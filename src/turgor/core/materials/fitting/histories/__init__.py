"""Fits of relaxation and softening to tests over time."""
