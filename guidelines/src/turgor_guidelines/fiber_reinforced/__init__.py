"""Section 7.2: fiber-reinforced actuators."""
