"""Job: one run described by a TOML file, from reading it to the folder of results."""
