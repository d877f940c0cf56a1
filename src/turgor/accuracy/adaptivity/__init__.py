"""Adaptivity: the mesh error of every measure, and meshes refined where it comes from."""
