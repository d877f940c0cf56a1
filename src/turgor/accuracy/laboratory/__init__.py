"""Laboratory: measured actuators, read from tables and marker tracks, and compared with what was computed."""
