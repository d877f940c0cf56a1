"""Report: one page with the words, numbers and pictures of a run."""
