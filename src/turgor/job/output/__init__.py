"""Output: the folder of results and what a run writes into it."""
