"""Progress of a solve: on a terminal, in a notebook, and as records of a log."""
