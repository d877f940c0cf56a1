"""Fibers: windings on unrolled surfaces, smeared or as trusses."""
