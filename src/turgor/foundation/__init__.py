"""Foundation: errors, findings, sources, saved files, and what every other folder stands on."""
