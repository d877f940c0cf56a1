"""Buckling: loads at which an actuator leaves its shape, the shapes in which it does, branches, imperfections."""
