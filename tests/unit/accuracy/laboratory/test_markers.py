"""Angles of marker tracks, on an arc whose angles are known."""

import numpy as np
import pytest

from refused import refused
from turgor.accuracy.laboratory.markers import Tracks, read_tracks
from turgor.foundation.response import Column
from turgor.foundation.source import Source

LENGTH = 0.1
TURN = np.radians(np.linspace(0, 170, 18))


def arc(share: float, depth: float = 0.0) -> np.ndarray:
    """A point at a share of the length of an arc that bends downwards, at every frame."""
    theta = np.maximum(TURN * share, 1e-12)
    radius = LENGTH * share / theta
    flat = np.column_stack([radius * np.sin(theta), -radius * (1 - np.cos(theta))])
    return np.column_stack([flat[:, 0], np.full(len(TURN), depth), flat[:, 1]])


def tracks(points: dict[str, np.ndarray]) -> Tracks:
    time = Column("time", "s", np.arange(len(TURN), dtype=float))
    return Tracks(drive=time, points=points, source=Source(text="a camera"))


@pytest.fixture
def finger() -> Tracks:
    normal = np.column_stack([np.sin(TURN), np.zeros(len(TURN)), np.cos(TURN)])
    tip = arc(1.0)
    return tracks({"base": arc(0.0), "middle": arc(0.5), "tip": tip, "above": tip + 5e-3 * normal})


def test_the_three_angles_of_an_arc(finger: Tracks) -> None:
    np.testing.assert_allclose(finger.angle("tangent", "tip", "above")["bending_angle"], TURN, atol=1e-9)
    np.testing.assert_allclose(finger.angle("chord", "base", "tip")["bending_angle"], TURN / 2, atol=1e-9)
    np.testing.assert_allclose(
        finger.angle("three_point", "base", "middle", "tip")["bending_angle"], TURN / 2, atol=1e-9
    )


def test_more_than_half_a_turn_is_followed() -> None:
    turn = np.radians(np.linspace(0, 400, 41))
    pin = np.column_stack([np.cos(turn), np.sin(turn)])
    result = Tracks(
        drive=Column("time", "s", np.arange(41.0)), source=Source(text="a camera"),
        points={"a": np.zeros((41, 2)), "b": pin},
    ).angle("tangent", "a", "b")  # fmt: skip
    np.testing.assert_allclose(result["bending_angle"], turn, atol=1e-9)


def test_the_motion_of_the_clamp_is_taken_out(finger: Tracks) -> None:
    rng = np.random.default_rng(1)
    turned = {name: np.empty_like(track) for name, track in finger.points.items()}
    feet = {f"foot{n}": np.tile(rng.normal(size=3), (len(TURN), 1)) for n in range(3)}
    still = {**finger.points, **feet}
    turned = {name: np.empty_like(track) for name, track in still.items()}
    for n in range(len(TURN)):
        angle, shift = 0.02 * n, rng.normal(size=3)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        first = np.eye(3) if n == 0 else turn
        for name, track in still.items():
            turned[name][n] = first @ track[n] + (shift if n else 0)
    result = tracks(turned).relative_to("foot0", "foot1", "foot2")
    np.testing.assert_allclose(result.of("tip"), still["tip"], atol=1e-12)
    with refused("relative_to", 3, 2):
        tracks(turned).relative_to("foot0", "foot1")


def test_displacement(finger: Tracks) -> None:
    result = finger.displacement("tip")["tip_displacement"]
    assert result[-1] == pytest.approx(np.linalg.norm(arc(1.0)[-1] - arc(1.0)[0]))


def test_bad_questions(finger: Tracks) -> None:
    with refused("angle", "'cord'", "'chord'"):
        finger.angle("cord", "base", "tip")
    with refused("chord angle", 2, 1):
        finger.angle("chord", "tip")
    with refused("marker 'tipp'", "'tip'", "base, middle"):
        finger.angle("chord", "base", "tipp")


def test_reading(tmp_path) -> None:
    file = tmp_path / "video.csv"
    file.write_text("frame,tip_x (mm),tip_y (mm),base_x (mm),base_y (mm)\n0,100,0,0,0\n1,98,5,0,0\n", encoding="utf-8")
    result = read_tracks(file)
    assert list(result.points) == ["tip", "base"]
    np.testing.assert_allclose(result.of("tip")[1], [0.098, 0.005])
    assert result.drive.name == "frame"
    file.write_text("frame,tip_x,tip_y\n0,100,0\n1,98,5\n", encoding="utf-8")
    with refused(file.name, "'tip'", "tip_x (mm)"):
        read_tracks(file)
    file.write_text("frame,tip\n0,100\n1,98\n", encoding="utf-8")
    with refused(file.name, "frame, tip", "tip_y (mm)"):
        read_tracks(file)
