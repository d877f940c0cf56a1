"""Remeshing on the way: where cells degrade, what finer cells take over, and the path that goes on with them."""
