"""Plane faces of CAD parts as outlines: cuts, and the edges that bound them."""
