"""Faces: pressure, membranes, shells and dead loads on named faces."""
