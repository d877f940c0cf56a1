"""Warm-up: which kernels a model needs, and their compilation at a known time, shared among processes."""
