"""The laws, one in each file; a file is all that a law needs, and its name is that of the law in job files."""
