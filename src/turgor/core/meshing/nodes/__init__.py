"""Nodes of a mesh by name, and how a total is spread over them."""
