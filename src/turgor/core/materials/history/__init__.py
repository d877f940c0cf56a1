"""History: viscoelasticity, stress softening, and the stress of a material over time."""
