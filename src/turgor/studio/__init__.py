"""Studio: job files, runs and reduced models in a browser; a client of files on disk and of the commands."""
