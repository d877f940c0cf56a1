"""V24: with the right body force the discrete solution tends to a chosen one, at the rates of the element.

Problem: plane strain unit square (one layer of cells between frictionless walls), incompressible neo-Hookean, chosen
solution x = X + A sin(kY), y = Y (volume-preserving), A = 0.2, k = π, multiplier p = −μ + p₀ cos(πX/2) cos(πY) with p₀
= μ/2. With the whole boundary prescribed the mean stress of an incompressible body would be open by a constant; here p
is chosen so that the normal traction at X = 1 vanishes and that side is free along x, which fixes the constant.
Exact: body force B_X = μ A k² sin kY − p,X, B_Y = A k cos kY p,X − p,Y; our mean stress, which belongs to Ī₁, is p + μ
I₁/3 with I₁ = 3 + A² k² cos² kY.
Source: method of manufactured solutions. Expected rates of Taylor–Hood: displacement 3 in L², 2 in H¹, mean stress 2.
Tolerance: a rate may be 0.25 below the theoretical one on the last halving, because meshes of 4 to 16 cells are not
yet at the limit, and the errors themselves must be small (1e-3 of A, 1 % of μ).
"""

import numpy as np
from chosen_solution import A, errors_of, manufactured


def test_convergence_orders(record_verification):
    errors = np.array([errors_of(manufactured(count)) for count in (4, 8, 16)])
    rates = np.log2(errors[:-1] / errors[1:])
    record_verification(
        claim="manufactured solution, 8 to 16 cells a side: rate of u in L², u in H¹, mean stress in L²",
        source="V24, theory of Taylor–Hood elements",
        expected=[3, 2, 2],
        got=rates[-1],
        tolerance="0.25 below",
    )
    record_verification(
        claim="manufactured solution, 16 cells: L² error of u over A, of ∇u, of the mean stress over μ",
        source="V24, exact",
        expected=[0.0, 0.0, 0.0],
        got=errors[-1] / [A, 1, 1],
        tolerance="1e-3, 1e-2, 1e-2",
    )
    assert (rates[-1] > [2.75, 1.75, 1.75]).all()
    assert (errors[-1] < [1e-3 * A, 1e-2, 1e-2]).all()
