"""Robots: what a simulator of robots takes of an actuator, with the error of each export."""
