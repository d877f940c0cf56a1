"""The environment passes Gymnasium's own checker, its seeds give the same episodes, and its air is that of `tg.air`."""

import warnings
from dataclasses import replace

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from learning_cases import pushed

import turgor as tg
from refused import refused

VALVES = tg.learning.Valves(supply=50e3, valve=tg.air.Restriction(conductance=5e-11), band=20.0)


def task(**given):
    return tg.learning.FollowTask(reduced=pushed(), **{"steps": 25, **given})


def episode(env, seed, shares):
    rows = [(env.reset(seed=seed)[0], 0.0)]
    for share in shares:
        seen, reward, _, ended, _ = env.step(np.array([share], dtype=np.float32))
        rows.append((seen, reward))
    assert ended
    return np.array([[*seen, reward] for seen, reward in rows])


@pytest.mark.parametrize("air", [tg.control.Air(delay=40e-3, lag=30e-3), VALVES], ids=["lag", "valves"])
def test_the_checker_of_gymnasium_finds_nothing(air):
    gymnasium.register("turgor/Follow-v0", lambda task, render_mode=None: tg.learning.environment(task))
    env = gymnasium.make("turgor/Follow-v0", task=task(air=air, noise=1e-5, pressure_noise=5.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)
    gymnasium.registry.pop("turgor/Follow-v0")


def test_a_seed_gives_the_same_episode_and_another_seed_another_one():
    env = tg.learning.environment(task(noise=1e-5, pressure_noise=5.0))
    shares = np.random.default_rng(0).uniform(-1, 1, 25)
    first = episode(env, 3, shares)
    assert (first == episode(tg.learning.environment(env.task), 3, shares)).all()
    assert (first[1:] != episode(env, 4, shares)[1:]).any(axis=1).all()


def test_observation_and_reward_are_what_the_documentation_says():
    path = np.array([pushed().solve({"pressure": p, "tip.vector.3": 0.0}).tip for p in (0.0, 200.0, 400.0)])
    limits = tg.control.Limits(low={"tip.vector.3": 0.0}, high={"tip.vector.3": 0.0}, rate={"pressure": 10e3})
    env = tg.learning.environment(task(path=path, limits=limits, air=tg.control.Air(), effort=0.5))
    seen, info = env.reset(seed=0)
    reach = env.episode.reach
    assert seen == pytest.approx([0, 0, 0, *path[1] / reach, *path[2] / reach, -1, -1], abs=1e-6)
    seen, reward, lost, ended, info = env.step(np.array([0.0], dtype=np.float32))
    assert info["pressures"] == pytest.approx([200.0])  # 500 Pa are wanted, and 10 kPa/s times 20 ms allowed
    assert seen == pytest.approx([*path[1] / reach, *path[2] / reach, *path[2] / reach, -0.6, 0.0], abs=1e-5)
    assert info["distance"] == pytest.approx(0.0, abs=1e-9)
    assert reward == pytest.approx(-0.5)  # the action has changed by 1
    reward = env.step(np.array([0.0], dtype=np.float32))[1]
    assert reward == pytest.approx(0.0, abs=1e-6)
    reward = env.step(np.array([0.0], dtype=np.float32))[1]
    assert reward == pytest.approx(-np.linalg.norm(env.episode.value - path[2]) / reach)
    assert not (lost or ended)


def test_a_command_arrives_after_the_delay_and_with_the_lag():
    env = tg.learning.environment(task(air=tg.control.Air(delay=40e-3, lag=20e-3)))
    env.reset(seed=1)
    pressures = [env.step(np.array([1.0], dtype=np.float32))[4]["pressures"][0] for _ in range(5)]
    assert pressures == pytest.approx([0, 0, *(1e3 * (1 - np.exp(-np.arange(1, 4))))])


@pytest.mark.parametrize(("first", "command"), [(0.0, 1000.0), (1000.0, 0.0)], ids=["fill", "vent"])
def test_valves_fill_and_vent_as_a_network_of_air(first, command):
    pressures = np.linspace(0, 1e3, 21)
    volumes = [pushed().solve({"pressure": p, "tip.vector.3": 0}).volumes["cavity"] for p in pressures.tolist()]
    valves = replace(VALVES, supply=5e3, valve=tg.air.Restriction(conductance=3e-11))
    chamber = tg.air.Chamber(tg.air.VolumeCurve(pressures, volumes), pressure=first)
    other = tg.air.Supply(5e3 if command > first else 0.0)
    valve = tg.air.Connection("other", "chamber", valves.valve)
    network = tg.air.Network(nodes={"other": other, "chamber": chamber}, parts={"valve": valve})
    state, reached = pushed().solve({"pressure": first, "tip.vector.3": 0}), []
    while abs(command - state.inputs[0]) > 100.0:  # where the valve is fully open
        reached.append(valves.after(state, np.array([command]), 4e-3)[0])
        state = pushed().solve({"pressure": reached[-1], "tip.vector.3": 0})
    times = 4e-3 * np.arange(1, len(reached))
    expected = tg.air.simulate(network, times[-1], times=times).pressure("chamber")
    assert len(times) > 4
    assert reached[:-1] == pytest.approx(expected, abs=0.01 * 1e3)


def test_tasks_that_cannot_be_are_refused():
    with refused("period", "0 s"):
        task(period=0.0)
    with refused("noise", -1):
        task(noise=-1.0)
    with refused("cavity"):
        task(limits=tg.control.Limits(volume={"cavity": (0.0, 1.0)}))
    with refused("tip_x", "(3, 2)"):
        task(path=np.zeros((3, 2)))
    with refused("supply", "-5"):
        tg.learning.Valves(supply=-5.0, valve=VALVES.valve)
