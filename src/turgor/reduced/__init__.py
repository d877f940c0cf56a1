"""Reduced models: an actuator that answers in milliseconds, from modes of full solves."""
