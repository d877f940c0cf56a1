"""Contact forces on an obstacle that follow a target."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import LENGTH, pressing, reduced

import turgor as tg
from refused import refused
from turgor.core.results.measures.contact_measures import force_on
from turgor.systems.control.forces import continued
from turgor.units import kPa, mm

FORCES = np.array([0.2, 0.8, 1.0, 0.3, 0.0, 0.4])


def limits(**changes):
    """The plate stays 3 mm before the bellows."""
    place = {"point.1": LENGTH + 3 * mm}
    return tg.control.Limits(low=place, high=place, **changes)


def test_force_follows_a_target_and_is_that_of_the_full_model():
    """From a first target that no contact meets, and again after contact was lost."""
    path = np.concatenate([[0.0], FORCES])
    track = tg.control.track(pressing(), path, output=tg.control.ContactForce("plate"), limits=limits())
    assert track.reached[:, 0] == pytest.approx(path, rel=1e-3, abs=1e-5)
    assert track.response()["force_plate"] == pytest.approx(path, rel=1e-3, abs=1e-5)
    for row in (1, 3):
        full = tg.real_time.verified(track.states[row], tg.EngineOptions(threads=1)).state
        assert force_on("plate")(full) == pytest.approx(path[row], rel=0.005)


def test_rate_limits_the_approach_and_the_force():
    track = tg.control.track(
        pressing(),
        FORCES,
        times=np.arange(6.0),
        output=tg.control.ContactForce(),
        limits=limits(rate={"pressure": 1 * kPa}),
    )
    assert np.abs(np.diff(track.inputs[:, 0])).max() <= 1 * kPa * (1 + 1e-9)
    assert track.reached[1, 0] < 0.8 - 0.05
    assert track.active[1] == ("loads.pressure rate",)


@pytest.mark.parametrize("inputs", [(0.5 * kPa, LENGTH + 3 * mm), (4 * kPa, LENGTH + 3 * mm)])
def test_derivatives_are_exact_with_and_without_contact(inputs):
    of, state = tg.control.ContactForce().of(pressing()), pressing().at(np.array(inputs))
    value, slopes = continued(of, state)
    assert (value[0] > 0) == (inputs[0] > 1 * kPa)
    for place, step in enumerate((1.0, 1e-6)):
        ends = [
            continued(of, pressing().at(state.inputs + sign * step * np.eye(2)[place], state))[0] for sign in (1, -1)
        ]
        assert slopes[0, place] == pytest.approx((ends[0] - ends[1])[0] / (2 * step), rel=1e-3)


def test_controller_brings_a_free_actuator_to_a_force():
    controller = tg.control.Controller(pressing(), period=5e-3, output=tg.control.ContactForce(), limits=limits())
    controller.reset(pressing().solve({"pressure": 0.0, "point.1": LENGTH + 3 * mm}))
    run = tg.control.run_loop(controller, tg.control.Plant(reduced=pressing()), np.full((20, 1), 0.6))
    assert run.reached[0, 0] == 0.0
    assert run.reached[-1, 0] == pytest.approx(0.6, rel=0.01)


def test_forces_that_make_no_sense_are_refused():
    with refused("obstacle"):
        tg.control.ContactForce().of(reduced())
    with refused("plat", "plate"):
        tg.control.ContactForce("plat").of(pressing())
    (part,) = pressing().equations.obstacles
    two = replace(pressing().equations, obstacles=(part, replace(part, name="floor")))
    with refused("plate", "floor"):
        tg.control.ContactForce().of(replace(pressing(), equations=two))
    untouched = replace(pressing().equations, obstacles=(replace(part, largest=0.0),))
    with refused("plate", "touched"):
        tg.control.ContactForce().of(replace(pressing(), equations=untouched))
