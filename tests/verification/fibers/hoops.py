"""The tube of V07, whose outer radius is held: its dimensions, points of its exact curve, and its model."""

import problems
import slices
import turgor as tg

INNER, OUTER = 6.35 * problems.MM, 8.35 * problems.MM
STRETCH = (1.02, 1.05, 1.10, 1.20, 1.30, 1.50, 2.00)
PRESSURE = {  # MPa
    "neo-Hookean": (0.009216795, 0.02183597, 0.04021383, 0.06974935, 0.09294828, 0.1288545, 0.1944420),
    "Yeoh": (0.008454466, 0.02009811, 0.03743099, 0.06749241, 0.09495944, 0.1506312, 0.3318453),
}
CONTACT = (0.00592104, 0.0142830, 0.0270475, 0.0492514, 0.0683665, 0.101022, 0.167777)  # MPa, neo-Hookean
LAW = {"neo-Hookean": problems.NEO_HOOKE, "Yeoh": problems.YEOH}
STIFF_HOOPS = 1e5 * 1e3  # N/m
HELD = (tg.Fixed("outside", "xy"),)


def model_of(name, way, inner=INNER):
    mesh = slices.quarter(inner, OUTER)
    if way == "held":
        return slices.wound(mesh, LAW[name], supports=HELD)
    return slices.wound(mesh, LAW[name], [slices.family(STIFF_HOOPS, 0.0)])
