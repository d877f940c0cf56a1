"""A reduced model: its equations, Newton's method, answers."""
