"""Symmetric tensors as six components 11 22 33 12 23 13, in the order of VTK."""

#: Row and column of each component.
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))

ROWS, COLUMNS = (list(each) for each in zip(*PAIRS, strict=True))
