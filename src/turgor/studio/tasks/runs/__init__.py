"""Tasks about runs and studies: checks with fixes, scenes, files, and rows."""
