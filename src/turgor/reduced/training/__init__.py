"""Training: full solves, modes, and the equations that follow from them."""
