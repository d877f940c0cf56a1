"""Shapes on the CAD kernel: outlines, prisms, turned profiles, boxes and booleans, with their areas and volumes."""
