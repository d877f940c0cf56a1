"""Molds to cast actuators in."""
