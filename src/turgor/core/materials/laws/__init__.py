"""Laws: strain energies, their derivatives, curves of homogeneous deformations and stability."""
