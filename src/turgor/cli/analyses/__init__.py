"""Commands that solve something else than a run."""
