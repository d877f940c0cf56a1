"""Viewer: the path of a solution in a browser, to turn, cut and play."""
