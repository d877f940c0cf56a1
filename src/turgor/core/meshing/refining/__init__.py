"""Refining: cells cut into smaller ones, and which cell each piece came from."""
