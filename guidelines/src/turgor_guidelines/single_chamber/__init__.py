"""Section 7.1: actuators with a single chamber."""
