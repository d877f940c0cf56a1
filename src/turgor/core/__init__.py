"""Core: the way from a material and a geometry to a response: mesh, model, finite element engine, solvers, results."""
