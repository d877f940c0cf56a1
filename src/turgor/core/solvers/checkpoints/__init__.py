"""Checkpoints: what is written after every step, so that a run that was ended goes on from there."""
