"""Studies of job files."""
