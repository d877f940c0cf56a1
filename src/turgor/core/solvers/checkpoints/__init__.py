"""Checkpoints: files that are written after every step, from which an ended run can continue."""
