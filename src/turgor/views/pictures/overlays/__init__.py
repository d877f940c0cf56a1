"""What pictures show besides the actuator: obstacles, threads, and patches in contact."""
