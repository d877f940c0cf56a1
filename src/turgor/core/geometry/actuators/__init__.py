"""Actuator families: one frozen dataclass of dimensions a file, with rules, volumes and `build()`."""
