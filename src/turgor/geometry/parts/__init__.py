"""Parts that several actuator families are made of: rows of chambers, bellows, ends, inlets, layouts of prisms."""
