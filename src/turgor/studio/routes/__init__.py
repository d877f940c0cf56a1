"""Routes of the page: each file answers for one kind of thing."""
