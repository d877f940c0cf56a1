"""Cells: element kernels, the materials at Gauss points and their internal variables."""
