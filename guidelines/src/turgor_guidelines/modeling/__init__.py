"""Sections 5, 6.2 and 8.1: claims on material models, meshes, procedures and what models leave out."""
