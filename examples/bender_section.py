"""What a long fiber-reinforced bender does, from its cross-section alone: curvature, ballooning, stiffness."""

# %% The section: a half disc, hoops of thread around it, a grid of threads on its flat side.
import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

finger = tg.actuators.FiberReinforcedBender(radius=8 * mm, wall=2 * mm, base=2 * mm, skin=0.0, length=160 * mm)
silicone = tg.Material(name="silicone", law=tg.laws.NeoHooke(C10=0.12e6))
flat = "strain_limiting_layer"


def threads(face, angle, spacing):
    """Kevlar threads as rods, which resist compression too."""
    winding = tg.Winding(angle_from_axis=angle, spacing=spacing)
    kevlar = tg.Material(name="Kevlar", law=tg.laws.Hooke(E=31067e6, nu=0.36))
    return tg.Fibers(face=face, material=kevlar, diameter=0.1778 * mm, winding=winding, compression=1.0)


hoops = threads(("outside", flat), 90 * deg, 3 * mm)
grid = [threads(flat, angle, 1.187 * mm) for angle in (0 * deg, 90 * deg)]
section = tg.Section(finger, {"body": silicone}, reinforcements=[hoops, *grid])

# %% Twenty pressures take two seconds; the whole finger would take minutes.
solution = section.solve(np.linspace(2.5, 50, 20) * kPa)
response = solution.response
angle = response["curvature_y"][-1] * finger.length / deg
ballooning = response["cavity_ballooning"][-1] - 1
print(f"At 50 kPa, 160 mm of it bend by {angle:.1f} deg, and the cavity is {ballooning:.0%} wider.")

# %% The stiffness at that pressure, for a rod model: stretch, twist, curvatures about y and z.
print(f"Its bending stiffness there is {solution.stiffness().bending[0] * 1e6:,.0f} N mm².")

# %% V21 of the verification has 28.09 deg, from elements of higher order on the same section.
assert abs(angle - 28.09) < 0.01 * 28.09, "the section bends as converged elements do"
