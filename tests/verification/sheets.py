"""What the tests of shells on tetrahedra share: sheets, and rates of convergence."""

import numpy as np

import turgor as tg


def sheet(modulus, thickness, nu=0.3):
    """A sheet that resists bending."""
    law = tg.laws.Hooke(E=modulus, nu=nu)
    return tg.Shell(tg.Material(name="sheet", law=law), thickness)


def stiffness(modulus, thickness, nu=0.3):
    """Bending stiffness D of a plate [N m]."""
    return modulus * thickness**3 / 12 / (1 - nu**2)


def rates(errors):
    """Orders of convergence between meshes of half the size each."""
    sizes = np.abs(np.asarray(errors, dtype=np.float64))
    return np.log2(sizes[:-1] / sizes[1:])
