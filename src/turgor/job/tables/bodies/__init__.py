"""Bodies of a job file: the parts of a hand or an arm, and what is rigid among them."""
