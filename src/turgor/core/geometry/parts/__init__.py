"""Parts of several actuator families: rows of chambers, bellows, ends, inlets, layouts of prisms."""
