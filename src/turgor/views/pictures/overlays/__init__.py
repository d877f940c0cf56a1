"""What pictures show beside the actuator: obstacles, threads, and patches in contact."""
