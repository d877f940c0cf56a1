"""Follow a path: pressures that bend a finger as wanted, and a loop with a finger that is stiffer than its model."""

# %% A reduced model of a short finger: half a minute of full solves.
import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm, ms

finger = tg.actuators.FastPneuNet(chambers=2, length=22 * mm).build()
rubber = tg.from_library("ecoflex-00-30", record="yeoh-steck-2019")
model = tg.Model(
    mesh=tg.mesh(finger, size=8 * mm),
    materials={"body": rubber, "base": rubber},
    supports=(tg.Fixed("fixed"),),
    loads=(tg.Pressure("cavity", 1 * kPa),),
)
budget = tg.real_time.Budget(steps=8, modes=8, held_out=0)
reduced = tg.reduce(model, {"loads.pressure": (0 * kPa, 3 * kPa)}, budget=budget)

# %% The bending angle swings twice, and the pressure rises by 10 kPa a second at most.
most = tg.bending_angle(reduced.solve(2.5 * kPa).state())
times = np.linspace(0.0, 2.0, 101)
wanted = most * (0.5 - 0.5 * np.cos(2 * np.pi * times))
limits = tg.control.Limits(rate=10 * kPa)
track = tg.control.track(reduced, wanted, times=times, output=tg.control.Angle(), limits=limits)
print(f"largest angle {most / deg:.1f}°, largest distance {track.distance.max() / deg:.1e}°")
print(f"largest pressure {track.inputs.max() / kPa:.2f} kPa")

# %% A loop: the real finger is stiffer by a tenth, pressures come 10 ms late, and the sensor has noise.
period = 5 * ms
times = np.arange(0.0, 2.0, period)
wanted = most * (0.5 - 0.5 * np.cos(np.pi * times))
controller = tg.control.Controller(reduced, period=period, output=tg.control.Angle(), air=tg.control.Air(delay=10 * ms))
real = tg.control.Plant(reduced=reduced, air=tg.control.Air(delay=10 * ms), stiffness=1.1, noise=0.02 * deg)
run = tg.control.run_loop(controller, real, wanted[:, None])
print(f"root mean square of the distance {run.rms() / deg:.3f}°, {run.rms() / most:.1%} of the swing")
