"""Control: pressures that make an actuator follow a wanted motion."""
