"""Reference of job files: every key with its type, unit, default, range and meaning, from the code that reads it."""
