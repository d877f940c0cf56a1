"""Findings of contact: walls that met without it, walls that overlap at rest, contact that gave way too far."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest
import results_cases as cases
from netgen.occ import Box, Cylinder, Pnt, Z

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.generate import mesh
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.mirror_gap import find_mirror_walls, mirror_gap
from turgor.core.meshing.quality.overlaps import find_overlaps
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.solvers.checks.contact import check_contact, deep_penetrations, meeting_walls
from turgor.core.solvers.solution import Touch
from turgor.units import kPa, mm

OFF = Contact(self_contact=False)


@pytest.fixture(scope="module")
def finger():
    return mesh(FastPneuNet(chambers=3, length=32 * mm, gap=1 * mm).build(), size=4 * mm)


def model(of, contact=None, pressure=10 * kPa):
    faces = [Pressure("cavity", pressure)] if of.cavities else []
    return Model(of, dict.fromkeys(of.regions, cases.RUBBER), [Fixed("fixed")], faces, contact=contact)


def shrunk(question, factor):
    """The actuator pressed together along x: its gaps are closed at load factor 2/3."""
    return replace(
        cases.state(question, lambda points: points * [1 - 1.5 * factor, 1, 1], factor), touches=MappingProxyType({})
    )


def path(question, move=shrunk):
    return [move(question, factor) for factor in (0.0, 0.5, 1.0)]


# --- walls that met ----------------------------------------------------------------------------------------------


def test_walls_that_met_without_contact_are_an_error(finger):
    question = model(finger, OFF)
    (finding,) = meeting_walls(question, path(question))
    assert str(finding).startswith("B02 error: Outer walls met at 6.67 kPa; beyond it they pass through each other")
    assert "Switch self-contact on" in finding.advice


@pytest.mark.parametrize("contact", [None, Contact(self_contact=True)])
def test_walls_that_contact_stops_are_not_looked_at(finger, contact):
    question = model(finger, contact)
    assert meeting_walls(question, path(question)) == ()


def test_a_wall_that_meets_its_mirror_image():
    """The half body moves across its mirror plane: only nodes that were off the plane count."""
    half = cases.body(half=True, shift=5 * mm)

    question = model(half)  # no walls face each other: contact is not on by itself
    assert question.contact.for_mesh(half) is None
    states = [cases.state(question, moved(half, 8 * mm * f), f) for f in (0.0, 0.5, 1.0)]
    (result,) = meeting_walls(question, states)
    # the nearest nodes off the plane are half a brick, 2.5 mm, away: 8 mm · f = 2.5 mm
    assert result.message.startswith("Outer walls met their mirror image at 3.12 kPa; beyond it")
    on = model(half, Contact(self_contact=True))
    assert meeting_walls(on, states) == ()


def moved(half, distance):
    """Move everything that does not lie in the mirror plane across it."""
    off = half.points[:, 1] > 5 * mm + 1e-9
    return lambda points: points - np.outer(off, [0, distance, 0])


def test_distance_from_the_mirror_plane():
    half = cases.body(half=True, shift=5 * mm)
    (walls,) = find_mirror_walls(half)
    assert (walls.axis, walls.side, walls.level) == (1, 1.0, pytest.approx(5 * mm))
    assert mirror_gap((walls,), half.points) == pytest.approx(2.5 * mm)
    assert mirror_gap((walls,), half.points - [0, 4 * mm, 0]) == pytest.approx(-1.5 * mm)
    turned = Mesh(points=half.points * [1, -1, 1], cells=half.cells, regions=half.regions, faces=half.faces)
    (other,) = find_mirror_walls(turned)
    assert other.side == -1
    assert mirror_gap((other,), turned.points) == pytest.approx(2.5 * mm)
    assert not np.isin(walls.nodes, half.face_nodes("cavity")).any()
    (inside,) = find_mirror_walls(half, "cavity")
    assert np.isin(inside.nodes, half.face_nodes("cavity")).all()
    assert mirror_gap(find_mirror_walls(cases.body()), half.points) == np.inf


def test_walls_that_only_come_near_are_no_finding(finger):
    question = model(finger, OFF)
    assert meeting_walls(question, path(question)[:2]) == ()


# --- overlaps at rest --------------------------------------------------------------------------------------------


def boxes(*corners):
    """Boxes [mm] of one mesh that know nothing of each other."""
    return bodies(*(Box(Pnt(*low), Pnt(*high)) for low, high in corners))


def bodies(*shapes, sizes=(3 * mm, 3 * mm)):
    """Shapes [mm], each meshed alone with a size of its own."""
    points, cells, count = [], [], 0
    for shape, size in zip(shapes, sizes, strict=True):
        shape.mat("body")
        shape.faces.name = "outside"
        part = mesh(
            Geometry(name="part", smallest_wall=2 * mm, cavity_volumes={}, solid_volume=shape.mass * mm**3,
                     shape=shape, regions=("body",), faces=("outside",)), size=size,
        )  # fmt: skip
        points.append(part.points)
        cells.append(part.cells + count)
        count += len(part.points)
    joined, nodes = np.concatenate(points), np.concatenate(cells)
    corner = np.zeros(count, dtype=bool)
    corner[nodes[:, :4]] = True
    order = np.argsort(~corner, kind="stable")
    place = np.argsort(order)
    return Mesh(
        points=joined[order], cells=place[nodes], regions={"body": np.arange(len(nodes))}, faces={}, name="boxes"
    )


def bare(of, contact=None):
    return Model(of, {"body": cases.RUBBER}, [], [], contact=contact)


@pytest.mark.parametrize("inset", [2, 0])  # flush sides never cross each other
def test_bodies_that_overlap_at_rest_are_found(inset):
    low, high = (8, inset, inset), (20, 10 - inset, 10 - inset)  # 2 mm deep
    two = boxes(((0, 0, 0), (10, 10, 10)), (low, high))
    places = find_overlaps(two) / mm
    assert len(places) > 5
    assert (places >= np.array(low) - 1e-9).all()
    assert (places <= np.array([10, *high[1:]]) + 1e-9).all()
    (result,) = check_contact(bare(two))
    assert str(result).startswith("B07 warning: The mesh overlaps itself at rest, for instance at (")
    assert check_contact(bare(two, OFF)) == ()


def test_a_body_inside_another_one_is_found():
    nested = boxes(((0, 0, 0), (10, 10, 10)), ((2, 2, 2), (8, 8, 8)))  # no edge sticks through anything
    assert len(find_overlaps(nested)) > 5


@pytest.mark.parametrize("gap", [0.0, -1e-6, 0.2])  # 1 nm is round-off
def test_bodies_that_touch_or_keep_apart_do_not_overlap(gap):
    two = boxes(((0, 0, 0), (10, 10, 10)), ((10 + gap, 2, 2), (20, 7, 7)))
    assert len(find_overlaps(two)) == 0
    assert check_contact(bare(two)) == ()


def test_round_bodies_that_fit_do_not_overlap():
    """A plug in a ring, with facets that stick through each other; a plug that is too large does overlap."""

    def fitted(radius):
        ring = Cylinder(Pnt(0, 0, 0), Z, 8, 6) - Cylinder(Pnt(0, 0, 0), Z, 5, 6)
        return find_overlaps(bodies(ring, Cylinder(Pnt(0, 0, -1), Z, radius, 8), sizes=(3 * mm, 2 * mm)))

    assert len(fitted(5.0)) == 0
    assert len(fitted(6.0)) > 10


def test_an_actuator_does_not_overlap_itself_until_it_is_crushed(finger):
    assert len(find_overlaps(finger)) == 0
    leaning = finger.points.copy()
    middle = np.abs(leaning[:, 0] - 16 * mm) < 5 * mm
    leaning[middle, 0] += 0.2 * leaning[middle, 2]  # the middle chamber leans into the next one
    assert len(find_overlaps(finger, leaning)) > 10


# --- penetration -------------------------------------------------------------------------------------------------


def touched(question, name, share):
    nothing = np.zeros_like(question.mesh.points)
    touch = Touch(force=nothing, pressure=nothing[:, 0], area=0.0, penetration=30e-6, place=np.zeros(3), share=share)
    return replace(cases.state(question), touches=MappingProxyType({name: touch}))


def test_contact_that_gave_way_further_than_its_tolerance(finger):
    question = model(finger)
    (result,) = deep_penetrations([touched(question, SELF, 1.5)])
    assert str(result).startswith(
        "B06 warning: Walls of the actuator penetrate each other by up to 30 µm in the last state, at the worst place "
        "1.5 times as deep as the tolerance allows."
    )
    (result,) = deep_penetrations([touched(question, "plate", 1.5)])
    assert result.message.startswith("The actuator penetrates 'plate' by up to 30 µm")
    assert deep_penetrations([touched(question, SELF, 1.0)]) == ()
    assert deep_penetrations([touched(question, SELF, 1.5), cases.state(question)]) == ()  # it is the end that counts
    assert deep_penetrations([]) == ()
