"""Exports: reduced models for other simulators, and scenes for SOFA."""
