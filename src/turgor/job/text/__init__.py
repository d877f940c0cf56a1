"""Text: lines, problems and quantities of a job file."""
