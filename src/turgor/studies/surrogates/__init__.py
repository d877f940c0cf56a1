"""Surrogates: fast functions fitted to a study, with their error."""
