"""Notebook: values as tables and pictures, as HTML."""
