"""Fast models: formulas, rods and sections, which answer without a mesh of the whole actuator."""
