"""Accuracy: the error of the mesh, derivatives by the numbers of a model, and the comparison with measurements."""
