"""Fitting of laws to tests, ranking of laws, and files of fitted constants."""
