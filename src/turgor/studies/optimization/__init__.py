"""Optimization: dimensions, materials and loads chosen so that a response does what is wanted."""
