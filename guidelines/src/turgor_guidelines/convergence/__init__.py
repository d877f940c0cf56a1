"""Section 6.2: what helps a finite element model to converge."""
