"""Measures: numbers of a state, such as the bending angle."""
