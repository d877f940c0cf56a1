"""Notebook: values as HTML, with tables and pictures."""
