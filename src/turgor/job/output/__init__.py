"""Output: the folder of results and the files that a run writes into it."""
