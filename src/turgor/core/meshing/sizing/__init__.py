"""Sizing: the sizes of cells, and cells through walls."""
