"""Fields: values at the points of a state, from which measures, pictures and files are made."""
