"""Geometry: solids with named regions and faces, one actuator family per file."""
