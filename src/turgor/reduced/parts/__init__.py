"""Parts of the equations of a reduced model: sampled rubber, polynomials, contact."""
