"""Bonds between bodies: the opening, what the traction does with it, and the terms of the equations."""
