"""Foundation: errors, findings, sources, saved files, and the other parts that every folder imports."""
