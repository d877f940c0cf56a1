"""Histories of loads: points, expressions that can do arithmetic and nothing else, times."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from refused import refused
from turgor.core.model.drive import extremes, kinks
from turgor.core.model.history import checked, over_time, peak_of, points_of, share_at, turns_of
from turgor.core.model.loads import Gravity, Pressure


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("s", lambda s: s),
        ("sin(2*pi*s)", lambda s: np.sin(2 * np.pi * s)),
        ("-s**2 / 2 + 0.5*s", lambda s: -(s**2) / 2 + s / 2),
        ("min(1, 4*s) - max(0, 2*s - 1)", lambda s: min(1, 4 * s) - max(0, 2 * s - 1)),
        ("tanh(3*s) * exp(-s) * cos(s)", lambda s: np.tanh(3 * s) * np.exp(-s) * np.cos(s)),
        ("sqrt(abs(s))", np.sqrt),
    ],
)
def test_an_expression_is_what_it_says(text: str, expected: Any) -> None:
    load = Pressure("cavity", 2e3, text)
    for s in (0.0, 0.1, 0.37, 1.0):
        assert load.at(s) == pytest.approx(2e3 * expected(s), abs=1e-9)
        assert Gravity((0, 0, -1), 9.81, text).share(s) == pytest.approx(expected(s), abs=1e-12)
    assert turns_of(load.history) == ()


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("__import__('os').system('true')", ("__import__('os').system('true')", "s, pi, + - * / **")),
        ("().__class__", ("().__class__", "s, pi, + - * / **")),
        ("open('x')", ("open('x')", "'open'", "abs, cos")),
        ("sin(s, key=1)", ("sin(s, key=1)", "s, pi, + - * / **")),
        ("[s for s in (1, 2)]", ("[s for s in (1, 2)]", "s, pi, + - * / **")),
        ("lambda: 1", ("lambda: 1", "s, pi, + - * / **")),
        ("'a'", ("'a'", "s, pi, + - * / **")),
        ("True", ("True", "s, pi, + - * / **")),
        ("s s", ("'s s'", "no expression")),
        ("t", ("'t'", "pi, s")),
        ("sine(s)", ("sine(s)", "'sine'", "'sin'")),
        ("cos(s)", ("'cos(s)'", "0 at s = 0")),
        ("2*s", ("'2*s'", "-1 and 1")),
        ("s / (s - 0.5)", ("'s / (s - 0.5)'", "s = 0 and 1")),
        ("sqrt(-s)", ("'sqrt(-s)'", "s = 0 and 1")),
        ("sin(s, s)", ("'sin(s, s)'", "s = 0 and 1")),
        ("s**(-1)", ("'s**(-1)'", "s = 0 and 1")),
        ("(-s)**0.5", ("'(-s)**0.5'", "s = 0 and 1")),
        ("exp(1e4*s) - 1", ("'exp(1e4*s) - 1'", "s = 0 and 1")),
    ],
)
def test_what_is_no_history_is_refused(
    text: str, facts: tuple, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with refused(*facts):
        checked(text, "pressure")
    assert list(tmp_path.iterdir()) == []


def test_times_become_load_factors() -> None:
    assert over_time([(0, 0), (0.5, 1), (2, 0)], 2.0) == ((0.0, 0.0), (0.25, 1.0), (1.0, 0.0))
    turned = over_time("sin(2*pi*t/0.3)", 1.5)
    for time in (0.0, 0.2, 1.1):
        assert share_at(turned, time / 1.5) == pytest.approx(np.sin(2 * np.pi * time / 0.3), abs=1e-12)
    with refused("duration", "0 s", "more than 0"):
        over_time("t", 0.0)
    with refused("history", "'t +'", "no expression"):
        over_time("t +", 1.0)


def test_where_a_load_is_largest() -> None:
    assert peak_of("sin(2*pi*s)") == 0.25
    assert peak_of(((0, 0), (0.3, -1), (1, 0.5))) == 0.3
    assert len(points_of("s")) == 201


class CountedPoint(tuple[float, float]):
    """A point that counts how often it is looked at."""

    looks = 0

    def __getitem__(self, place: Any) -> Any:
        CountedPoint.looks += 1
        return super().__getitem__(place)


def test_a_share_is_found_without_a_look_at_every_point() -> None:
    random = np.random.default_rng(0)
    factors = np.unique(np.concatenate([[0, 1], random.random(2000)]))
    shares = random.uniform(-1, 1, len(factors))
    points = tuple(CountedPoint(point) for point in zip(factors.tolist(), shares.tolist(), strict=True))
    at = [*random.random(50), *factors[:5], 0.0, 1.0, -0.1, 1.1]
    np.testing.assert_allclose([share_at(points, s) for s in at], np.interp(at, factors, shares), rtol=1e-13)
    assert CountedPoint.looks < 20 * len(at)


def test_a_model_knows_the_extremes_of_its_loads() -> None:
    import turgor as tg
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet

    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.5e5), density=1e3)
    loads = [Pressure("cavity", 1e3, "sin(pi*s)"), Gravity((0, 0, -1), history=[(0, 0), (0.2, 1), (1, 0)])]
    model = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], loads)
    assert kinks(model) == (0.2,)
    assert extremes(model) == (0.2, 0.5, 1.0)
    factors = np.linspace(0, 1, 5001)
    measured = [(s, share) for s, share in zip(factors.tolist(), (np.sin(7 * factors) / 2).tolist(), strict=True)]
    alone = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [Pressure("cavity", 1e3, measured)])
    highest, lowest = factors[np.argmax(np.sin(7 * factors))], factors[np.argmin(np.sin(7 * factors))]
    assert extremes(alone) == pytest.approx((highest, lowest, 1.0))  # three of 5,001 points have to be looked at


def test_paths_of_obstacles_have_kinks() -> None:
    import turgor as tg
    from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet

    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.5e5), density=1e3)
    path = [(0, (0, 0, 0)), (0.3, (0, 0, -1e-3)), (1, (1e-3, 0, -1e-3))]
    plate = tg.obstacles.Obstacle(
        name="plate", shape=tg.obstacles.Plane(point=(0, 0, 0.05), normal=(0, 0, -1)), path=path
    )
    contact = tg.Contact(obstacles=[plate])
    model = tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [], contact=contact)
    assert kinks(model) == (0.3,)


@pytest.mark.parametrize(
    "points",
    [[1], [[0, 0], [1]], [[0, 0], "ab"], 5, None, [["a", "b"]], [[0, 0], [np.nan, 1]], [], [[0, 0], [1, False]]],
)
def test_malformed_points_are_told(points: Any) -> None:
    with refused(f"time is {points}", "in seconds"):
        over_time(points, 2.0)
    with refused(f"pressure: history is {points}", "load factor"):
        checked(points, "pressure")


@pytest.mark.parametrize("text", ["(" * 5000 + "s" + ")" * 5000, "+".join(["s"] * 20000)])
def test_an_endless_expression_is_refused(text: str) -> None:
    with refused("'cavity'", "expression"):
        Pressure("cavity", 2e3, text)


@pytest.mark.parametrize("text", ["-" * 2000 + "t", "t" + " + t" * 2000])
def test_an_expression_without_end_is_told(text):
    with refused("history", "expression"):
        checked(over_time(text, 1.0), "pressure")
