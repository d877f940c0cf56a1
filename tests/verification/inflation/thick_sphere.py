"""The thick sphere of V04: its radii, its laws, and points of its exact curve."""

import problems
import turgor as tg

INNER, OUTER = 10 * problems.MM, 15 * problems.MM
STRETCHES = (1.05, 1.10, 1.20, 1.30, 1.50, 1.75, 2.00, 2.50, 3.00)
PRESSURES = {  # MPa
    "neo-Hookean": (
        *(0.02979924, 0.05286328, 0.08435991, 0.1026194, 0.1171621),
        *(0.1167118, 0.1094654, 0.09253745, 0.07857042),
    ),
    "Mooney-Rivlin": (
        *(0.03012610, 0.05404203, 0.08825649, 0.1100007, 0.1323506),
        *(0.1417381, 0.1438191, 0.1440454, 0.1459242),
    ),
    "Yeoh": (0.02744444, 0.04931612, 0.08227340, 0.1065123, 0.1421018, 0.1762342, 0.2061163, 0.2618670, 0.3160445),
    "Ogden": (
        *(0.003106557, 0.005538117, 0.008912546, 0.01092093, 0.01264869),
        *(0.01292056, 0.01265550, 0.01276220, 0.01484939),
    ),
}
LAWS = {
    "neo-Hookean": problems.NEO_HOOKE,
    "Mooney-Rivlin": tg.laws.MooneyRivlin(C10=0.10 * problems.MPA, C01=0.02 * problems.MPA),
    "Yeoh": problems.YEOH,
    "Ogden": problems.OGDEN,
}
