"""Command ``turgor fit``, and what it prints."""
