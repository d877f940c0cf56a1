"""Start and end of the process of a command: the commands, lazy imports, signals, the last line."""
