"""Volumes of chambers against their pressures."""
