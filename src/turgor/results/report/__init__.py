"""Report: the page that says in words, numbers and pictures what a run found."""
