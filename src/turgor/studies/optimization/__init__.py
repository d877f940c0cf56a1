"""Optimization: dimensions, materials and loads chosen so that a response meets goals."""
