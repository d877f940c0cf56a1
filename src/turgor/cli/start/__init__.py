"""Start and end of the process of a command: which commands there are, what is loaded late, signals, the last line."""
