"""The block of Rivlin's flexure, V08: its dimensions, and where it is drawn."""

import numpy as np

import problems

THICKNESS, LENGTH, WIDTH = 10 * problems.MM, 40 * problems.MM, 2.5 * problems.MM


def center(angle):
    """Shift that keeps the middle of the block near where it was."""
    return np.array([LENGTH / angle - THICKNESS / 2, 0, 0])
