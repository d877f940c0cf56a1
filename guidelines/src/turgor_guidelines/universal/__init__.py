"""Section 7.0: what holds for every soft fluidic actuator."""
