"""An inverse network: pressures that bend a finger as wanted against a force, learned from derivatives."""

# %% A reduced model of a soft finger under pressure and a force on its tip: a quarter of a minute of full solves.
import numpy as np
from scipy.optimize import least_squares

import turgor as tg
from turgor.units import deg, kPa, mm

finger = tg.actuators.RectangularBender(length=60 * mm, top_wall=1.2 * mm, floor=3 * mm).build()
rubber = tg.from_library("ecoflex-00-30", record="yeoh-steck-2019")
model = tg.Model(
    mesh=tg.mesh(finger, size=8 * mm),
    materials={"body": rubber, "base": rubber},
    supports=(tg.Fixed("fixed"),),
    loads=(tg.Pressure("cavity", 1 * kPa), tg.loads.Force("tip", (0.0, 0.0, 1e-3))),
)
inputs = {"loads.pressure": (0 * kPa, 6 * kPa), "loads.tip.vector.3": (0.0, 5e-3)}  # the force straightens it
reduced = tg.reduce(model, inputs, budget=tg.real_time.Budget(steps=5, paths=4, held_out=0))
angle = tg.learning.function(reduced, [tg.control.Angle()])

# %% A network of eight neurons: pressure of a wanted angle and a force. No pressure is given to learn from.
HIGH, MOST, STRONG, NEURONS = 6 * kPa, 10 * deg, 5e-3, 8


def pressure(weights, wanted, force):
    """Pressure, and its derivatives by the weights."""
    a, b, c, d = weights[:-1].reshape(4, NEURONS)
    x, y = np.atleast_1d(wanted)[:, None] / MOST, np.atleast_1d(force)[:, None] / STRONG
    hidden = np.tanh(a * x + b * y + c)
    share = 1 / (1 + np.exp(-(hidden @ d + weights[-1])))  # between 0 and 1: never outside of the trained range
    inner = d * (1 - hidden**2)
    slopes = np.hstack([inner * x, inner * y, inner, hidden, np.ones((len(x), 1))])
    return HIGH * share, HIGH * (share * (1 - share))[:, None] * slopes


random = np.random.default_rng(1)
wanted, force = random.uniform(0.05 * MOST, MOST, 40), random.uniform(0, STRONG, 40)


def errors(weights):
    """Angles of the actuator minus the wanted ones."""
    return (angle(np.column_stack([pressure(weights, wanted, force)[0], force]))[:, 0] - wanted) / MOST


def slopes(weights):
    """Derivatives of the errors by the weights: those of the actuator times those of the network."""
    values, by_weights = pressure(weights, wanted, force)
    _, rates = angle.with_rates(np.column_stack([values, force]))
    return rates[:, 0, :1] * by_weights / MOST


first = np.append(random.normal(scale=0.5, size=4 * NEURONS), 0.0)
trained = least_squares(errors, first, slopes, method="lm", max_nfev=30)
print(f"root mean square of the training errors {np.sqrt(np.mean(trained.fun**2)):.1e} of the largest angle")

# %% A path that it has never seen: two swings, while the force grows.
times = np.linspace(0.0, 1.0, 41)
path = MOST * (0.5 - 0.4 * np.cos(4 * np.pi * times))
pull = STRONG * times
pressures, _ = pressure(trained.x, path, pull)
reached = angle(np.column_stack([pressures, pull]))[:, 0]
rms = float(np.sqrt(np.mean((reached - path) ** 2)))
print(f"root mean square of the errors along the path {rms / deg:.3f}°")

# %% The full model at some times says the same.
full = {}
for row in (5, 10, 20, 30):
    answer = reduced.at(np.array([pressures[row], pull[row]]))
    full[row] = tg.bending_angle(tg.real_time.verified(answer).state)
    print(f"{pressures[row] / kPa:.2f} kPa, {pull[row] * 1e3:.2f} mN: {full[row] / deg:.2f}° of {path[row] / deg:.2f}°")

# %% What the force costs: the pressure for 5° without and with 5 mN.
free, loaded = pressure(trained.x, [5 * deg, 5 * deg], [0.0, STRONG])[0]
print(f"5° take {free / kPa:.2f} kPa, and {loaded / kPa:.2f} kPa against 5 mN")
