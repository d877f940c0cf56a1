"""Networks of air: time of a simulated second, agreement with moving finite elements, slow and fast PneuNets.

    python benchmarks/systems/air.py            the page air.md again; some ten minutes

One process with one thread. Meshes are coarse: what is compared has the same mesh on both sides.
"""

import sys
from pathlib import Path
from time import process_time

import numpy as np
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.core.model.model import Model
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.units import kPa, mm

JOB, PAGE = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml", Path(__file__).with_suffix(".md")
OPTIONS = tg.EngineOptions(threads=1)
VALVE = tg.air.Restriction(conductance=0.3e-8, critical_ratio=0.3)
#: Damping by stiffness of what moves, of finite elements and reduced model [s].
DAMPING = 1e-3
TUBE = tg.air.Tubing(diameter=2 * mm, length=1.0)
HEAD = """# Networks of air

Written by `python benchmarks/systems/air.py` in one run with one thread; seconds are processor time. The valve has
0.3 dm³/(s bar), the tube a bore of 2 mm and a length of 1 m unless another is named.

"""


def model_of(family: str, pressure: float, size: str, **actuator: object) -> Model:
    """Four or fewer chambers of a PneuNet of the demo."""
    changes = {
        "actuator": {"type": family, **actuator},
        "mesh.size": size,
        "loads.pressure": f"{pressure / kPa:g} kPa",
    }
    return prepare(read_job(JOB, changes), lambda text: None)[0]


def curve_of(model: Model, steps: int = 10) -> tuple[tg.air.VolumeCurve, tg.Response | tg.air.VolumeCurve]:
    """Pressure–volume curve and response of a static path."""
    solution = tg.solve(model, tg.Static(max_step=1 / steps), options=OPTIONS, progress=False)
    response = tg.measure(solution, tg.bending_angle, tg.cavity_volume, mesh_error=False)
    return tg.air.VolumeCurve.of_response(response), response


def seconds(work: object, repeats: int = 3) -> float:
    """Least processor time of a call [s]."""
    times = []
    for _ in range(repeats):
        began = process_time()
        work()  # type: ignore[operator]
        times.append(process_time() - began)
    return min(times)


def six(volume: tg.air.VolumeCurve) -> tg.air.Network:
    """Six chambers, each with a valve with delays and a tube, filled, closed and vented one after the other."""
    nodes: dict = {"supply": tg.air.Supply(28 * kPa)}
    parts: dict = {}
    for n in range(6):
        nodes[f"outlet_{n}"], nodes[f"chamber_{n}"] = tg.air.junction(), tg.air.Chamber(volume)
        t = 0.02 * n
        command = tg.air.Signal((0.0, t + 0.01, t + 0.05, t + 0.45, t + 0.8), (0, 1, 0, -1, 0))
        parts[f"valve_{n}"] = tg.air.ThreeWayValve("supply", f"outlet_{n}", VALVE, command, on_delay=5e-3)
        parts[f"tube_{n}"] = tg.air.Connection(f"outlet_{n}", f"chamber_{n}", TUBE)
    return tg.air.Network(nodes=nodes, parts=parts)


def speed(curve: tg.air.VolumeCurve) -> list[tuple[str, str, str]]:
    """A second of six chambers."""
    network = six(curve)
    exact = tg.air.simulate(network, 1.0, tolerance=1e-11)
    run = tg.air.simulate(network, 1.0)
    error = max(np.abs(run.pressure(n) - exact.pressure(n)).max() / exact.pressure(n).max() for n in network.nodes)
    return [
        ("six chambers with tables, 1 s", f"{seconds(lambda: tg.air.simulate(network, 1.0)):.2f} s", "0.2 s"),
        ("error of their pressures, over the largest", f"{error:.1e}", ""),
        ("balance of mass", f"{run.balance():.0e}", "1e-9"),
    ]


def reduced_rows() -> list[tuple[str, str, str]]:
    """A second of chambers that are a reduced model, its sampling included."""
    finger = model_of("fast_pneunet", 15 * kPa, "8 mm", chambers=2, length="22 mm")
    one = tg.reduce(
        finger,
        {"loads.pressure": (0.0, 15 * kPa)},
        budget=tg.real_time.Budget(held_out=1, steps=8, modes=8),
        options=OPTIONS,
    )
    bender = prepare(
        read_job(JOB.parent / "actuators" / "bidirectional_bender.toml",
                 {"mesh.size": "10 mm", "actuator.length": "40 mm", "loads.cavity_1.pressure": "15 kPa",
                  "loads.cavity_2": {"pressure": "15 kPa"}}),
        lambda text: None,
    )[0]  # fmt: skip
    ranges = {"loads.cavity_1.pressure": (-1.0 * kPa, 15 * kPa), "loads.cavity_2.pressure": (-1.0 * kPa, 15 * kPa)}
    two = tg.reduce(bender, ranges, budget=tg.real_time.Budget(held_out=1, paths=4, steps=5), options=OPTIONS)

    def single() -> None:
        tg.air.simulate(tg.air.driven(tg.air.VolumeCurve.of_reduced(one), 12 * kPa, VALVE, TUBE), 1.0)

    def coupled() -> None:
        sampled = tg.air.Coupled.of_reduced(two)
        nodes = {"supply": tg.air.Supply(12 * kPa), "a": tg.air.Chamber(sampled.chamber(0)),
                 "b": tg.air.Chamber(sampled.chamber(1))}  # fmt: skip
        parts = {"fill": tg.air.Connection("supply", "a", VALVE), "cross": tg.air.Connection("a", "b", TUBE)}
        tg.air.simulate(tg.air.Network(nodes=nodes, parts=parts), 1.0)

    return [
        ("reduced model of one pressure, 1 s, with 41 states", f"{seconds(single):.2f} s", "1 s"),
        ("reduced model of two coupled chambers, 1 s, with 49 states", f"{seconds(coupled):.2f} s", "1 s"),
    ]


def filled(volume: object, pressure: float, conductance: float, fill: float) -> tg.air.History:
    """The finger is filled for some time, and vented."""
    valve = tg.air.Restriction(conductance=conductance)
    network = tg.air.driven(volume, 2 * pressure, valve, TUBE)  # type: ignore[arg-type]
    push = tg.air.ThreeWayValve("supply", "outlet", valve, tg.air.Signal((0.0, fill), (1, -1)))
    end = 4 * fill
    return tg.air.simulate(network.with_part("valve", push), end, times=np.linspace(0.0, end, 201))


def moved_by(run: tg.air.History, pressure: float) -> tuple[float, float]:
    """Errors of volume and gas: of moving finite elements under the pressures of a network, against the network's."""
    wanted, end = run.pressure("actuator"), float(run.time[-1])
    points = [(0.0, 0.0), *((float(t), float(p / pressure)) for t, p in zip(run.time[1:], wanted[1:], strict=True))]
    model = model_of("fast_pneunet", pressure, "8 mm", chambers=2, length="22 mm")
    load = tg.Pressure("cavity", pressure, history=tg.over_time(points, end))
    model = tg.Model(model.mesh, model.materials, [tg.Fixed("fixed")], [load])
    procedure = tg.Dynamic(duration=end, max_step=end / 200, stiffness_damping=DAMPING)
    moved = tg.solve(model, procedure, options=OPTIONS, progress=False)
    response = tg.measure(moved, tg.cavity_volume, mesh_error=False)
    time, volume = response["time"], response["cavity_volume"]
    own, density = np.interp(time, run.time, run.volume("actuator")), np.interp(time, run.time, wanted + 101_325.0)
    change = np.abs(volume - own).max() / np.abs(own - own[0]).max()
    return change, np.abs(density * (volume - own)).max() / np.ptp(density * own)


def moving(curve: tg.air.VolumeCurve, pressure: float) -> str:
    """Networks against moving finite elements: chambers without inertia, and chambers in motion."""
    finger = model_of("fast_pneunet", 1.3 * pressure, "8 mm", chambers=2, length="22 mm")
    budget = tg.real_time.Budget(held_out=1, steps=8, motion=True)
    reduced = tg.reduce(finger, {"loads.pressure": (0.0, 1.3 * pressure)}, budget=budget, options=OPTIONS)
    chamber = tg.air.MovingActuator(reduced, tg.real_time.Moving(step=0.5e-3, stiffness_damping=DAMPING)).chamber()
    rows = []
    for conductance in (0.01e-8, 0.03e-8):
        valve = tg.air.Restriction(conductance=conductance)
        network = tg.air.driven(curve, 2 * pressure, valve, TUBE)
        fill = tg.air.performance(network, 0.9 * pressure, delays=False).fill_time
        for name, volume in (("no inertia, a table", curve), ("a reduced model in motion", chamber)):
            began = process_time()
            run = filled(volume, pressure, conductance, fill)
            spent = process_time() - began
            change, gas = moved_by(run, pressure)
            balance = ""
            if run.motions:
                energies = run.motions["actuator"].energies
                lost = max(abs(each.kinetic + each.strain + each.dissipated - each.work) for each in energies)
                balance = f"{run.balance():.0e}, {lost / max(each.work for each in energies):.0e}"
            rows.append((f"{fill:.2f} s", name, f"{change:.1%}", f"{gas:.1%}", balance, f"{spent:.2g} s"))
    return table(
        ("filled in", "chamber has", "volume, over its largest change", "gas, over what flows in",
         "balances of mass and energy", "processor time"),
        rows,
    )  # fmt: skip


def at_angle(response: tg.Response, angle: float) -> float:
    """Pressure at an angle."""
    return float(np.interp(angle, response["bending_angle"], response["pressure"]))


def pneunets(angle: float) -> str:
    """Times, gas and flow of both families at the same angle."""
    families = {"fast": ("fast_pneunet", 26 * kPa, "40 mm"), "slow": ("slow_pneunet", 170 * kPa, "39 mm")}
    solved = {
        name: curve_of(model_of(family, most, "5 mm", chambers=4, length=length))
        for name, (family, most, length) in families.items()
    }
    wanted = {name: at_angle(response, np.deg2rad(angle)) for name, (_, response) in solved.items()}

    def ratio(supply: float) -> float:
        fast, slow = (
            tg.air.performance(tg.air.driven(curve, supply, VALVE, TUBE), wanted[name]).fill_time
            for name, (curve, _) in solved.items()
        )
        return slow / fast - 25

    level = brentq(ratio, 1.003 * wanted["slow"], 2 * wanted["slow"], rtol=0.003)
    rows = []
    for supply, tube in (
        (level, TUBE),
        (200 * kPa, TUBE),
        (345 * kPa, TUBE),
        (200 * kPa, tg.air.Tubing(diameter=4 * mm, length=1.0)),
    ):
        results = {}
        for name, (curve, _) in solved.items():
            network = tg.air.driven(curve, supply, VALVE, tube)
            results[name] = tg.air.performance(network, wanted[name])
        fast, slow = results["fast"], results["slow"]
        flows = (fast.volume / fast.fill_time) / (slow.volume / slow.fill_time)
        rows.append(
            (
                f"{supply / kPa:.0f} kPa, {tube.diameter / mm:g} mm",
                f"{fast.pressure / kPa:.3g}, {slow.pressure / kPa:.3g} kPa",
                f"{1e3 * fast.fill_time:.3g}, {1e3 * slow.fill_time:.3g} ms", f"{slow.fill_time / fast.fill_time:.1f}",
                f"{slow.volume / fast.volume:.1f}", f"{flows:.2f}",
                f"{1e3 * fast.vent_time:.3g}, {1e3 * slow.vent_time:.3g} ms",
                f"{fast.bandwidth:.2g}, {slow.bandwidth:.2g} Hz", f"{fast.limiting.part}, {slow.limiting.part}",
            )
        )  # fmt: skip
    head = ("supply, bore", "pressure: fast, slow", "fill time", "slow / fast", "of it gas", "of it flow", "vent time",
            "bandwidth", "limiting part")  # fmt: skip
    return table(head, rows)


def main() -> None:
    """Measure, and write the page."""
    pressure, angle = 12 * kPa, 60.0
    finger = model_of("fast_pneunet", 2.5 * pressure, "8 mm", chambers=2, length="22 mm")
    curve, _ = curve_of(finger)
    rows = [*speed(curve), *reduced_rows()]
    text = HEAD + table(("quantity", "measured", "target"), rows)
    text += "\n\n## Networks against moving finite elements\n\n" + moving(curve, pressure)
    text += (
        "\n\nThe finger has two chambers and is filled and vented. The moving finite elements (`Dynamic`) have its "
        "mesh, density, inertia and damping, and are driven by the pressures of the network: where their volume is "
        "the network's, both together solve the coupled problem. `Dynamic` and `GasMass` are two procedures, of which "
        "a run has one, so the gas is compared by pressure times volume. The target is 2 %. A table has no inertia, "
        "which shows where the finger fills within a few hundredths of a second; a reduced model in motion is stepped "
        "together with the gas."
        "\n\n## Slow and fast PneuNets\n\n"
        f"Four chambers in the same envelope, filled until they bend by {angle:g}°, which is {angle * 11 / 4:g}° of "
        "eleven; 25 times faster is published (Mosadegh et al. 2014). The time ratio is the product of the gas that is "
        "needed and of the mean flow. The gas decides: the slow one needs eight to twelve times as much, for more "
        "volume at more pressure. The flow varies: a supply that hardly exceeds the pressure of the "
        "slow one has little "
        "left to drive it, and at one level the ratio is the published one (first row). The times are "
        "those of the air: "
        "a finger that fills within a few hundredths of a second is late by its own inertia. The mesh leaves the angle "
        "of the slow one uncertain by a tenth.\n\n"
    )
    text += pneunets(angle)
    facts = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    PAGE.write_text(text + "\n\n" + facts + "\n", encoding="utf-8")
    print(PAGE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
