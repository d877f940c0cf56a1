"""Reference points: their unknowns, couplings to faces, loads, springs and mass."""
