"""Formats: parsers and writers of mesh files."""
