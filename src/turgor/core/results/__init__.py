"""Results: measures, fields and files of a solution."""
