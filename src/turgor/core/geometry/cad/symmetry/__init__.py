"""Symmetry of CAD parts: what maps a part onto itself, and the share of it that is modeled."""
