"""Two fingers squeeze a rubber bar; one finger and a quarter of the bar are modeled, and mirror planes add the rest."""

# %% The finger lies above the mirror plane z = 0, its image below; the bar across them is cut there and at y = 0.
import numpy as np

import turgor as tg
from turgor.units import N, deg, kPa, mm

finger = tg.mesh(tg.FastPneuNet(chambers=2, length=25 * mm).build(), size=4 * mm, cells="hexahedra")
bar = tg.mesh(tg.bodies.RoundBar(radius=5 * mm, length=16 * mm, mirrors="xz").build(), size=4 * mm, cells="hexahedra")
mesh = tg.bodies.together(
    {
        "finger": tg.bodies.placed(finger, shift=(0, 0, 6 * mm)),
        "bar": tg.bodies.placed(bar, axis=(0, 0, 1), angle=90 * deg, shift=(20 * mm, 0, 0)),
    }
)

# %% Contact does not hold a body: the ends of the bar are kept from moving along x; the mirror planes do the rest.
rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
model = tg.Model(
    mesh,
    materials=dict.fromkeys(mesh.regions, rubber),
    supports=[tg.Fixed("fixed_finger"), tg.Fixed("ends_bar", "x")],
    loads=[tg.Pressure("cavity_finger", 10 * kPa)],
)


def squeeze_of(at):
    """Force with which one finger presses on the bar: of the halves with y ≥ 0 and y ≤ 0."""
    nodes = np.unique(mesh.cells[mesh.region("body_bar")])
    touch = at.state.touches.get("self")
    return 0.0 if touch is None else -2 * touch.force[nodes, 2].sum()


squeeze = tg.measures.Measure(
    name="squeeze", unit="N", function=squeeze_of, definition="force of one finger on the bar"
)

# %% They meet at about half of the pressure.
solution = tg.solve(model)
response = tg.measure(solution, squeeze, tg.cavity_volume)
print(f"{solution.message} Each finger presses with {response.column('squeeze')[-1] / N:.3f} N.")
