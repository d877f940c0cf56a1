"""Liquids: hydrostatic pressure, inertia of what cavities contain, added mass and drag of slender bodies."""
