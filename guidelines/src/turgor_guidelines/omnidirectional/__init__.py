"""Section 7.3: bidirectional and omnidirectional actuators."""
