"""Marks of supports and loads in pictures of an actuator at rest."""
