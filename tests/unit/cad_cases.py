"""CAD shapes with hollows of known volume, in millimeters, as a user would draw them."""

from math import pi
from pathlib import Path

import numpy as np
from netgen.occ import Box, Cylinder, Glue, Pnt, X, Y, Z

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.units import mm

DATA = Path(__file__).parent / "data" / "cad"

FINGER = FastPneuNet(symmetric=False, chambers=3, length=38 * mm)


def finger():
    """A closed fast PneuNet without any name, in one body."""
    shape = FINGER.build().shape
    bodies = list(shape.solids)
    joined = (bodies[0] + bodies[1]).UnifySameDomain()
    joined.faces.name = ""
    return joined


def finger_with_inlet():
    """The same with an inlet of 2.4 mm along x, through the end wall of 2 mm."""
    return finger() - Cylinder(Pnt(-1, 0, 10), X, 1.2, 3 + FINGER.end_wall / mm - 2)


def tube(*, inlet=None, bore=(5.0, 40.0)):
    """A tube of radius 10 and length 50 with a bore of radius 8, and perhaps a radial inlet of radius 2."""
    shape = Cylinder(Pnt(0, 0, 0), X, 10, 50) - Cylinder(Pnt(bore[0], 0, 0), X, 8, bore[1])
    return shape if inlet is None else shape - Cylinder(Pnt(25, 0, 0), {"y": Y, "z": Z}[inlet], 2, 20)


def radial_inlet_volume():
    """Volume between the bore and the outer cylinder within the inlet, up to the cap over its saddle [mm³]."""
    # integrals over the disc of the inlet of the heights of the two cylinders; the cap's fan starts at the mean height
    # of its rim and rises in straight lines, so a third of the height at the rim and two thirds of the mean count
    angle = (np.arange(4000) + 0.5) / 4000 * 2 * pi
    rim = np.sqrt(100 - (2 * np.cos(angle)) ** 2)
    cap = pi * 4 * (2 / 3 * rim.mean() + rim.mean() / 3)
    radius = (np.arange(2000) + 0.5) / 2000 * 2
    within = np.sqrt(64 - (radius[:, None] * np.cos(angle)) ** 2)
    bore = float((within.mean(axis=1) * radius).sum() * 2 * pi * 2 / 2000)
    return cap - bore


def cup_and_plate(gap=0.0):
    """An open cup upside down with an axial inlet, and the plate that closes it: two bodies, not glued."""
    cup = (
        Box(Pnt(0, 0, 2.5), Pnt(40, 20, 12))
        - Box(Pnt(3, 3, 2.5), Pnt(37, 17, 10))
        - Cylinder(Pnt(-1, 10, 6), X, 1.5, 5)
    )
    return [cup, Box(Pnt(0, 0, 0), Pnt(40, 20, 2.5 - gap))]


CUP_VOLUME = 34 * 14 * 7.5 + 3 * pi * 1.5**2


def three_chambers():
    """A cylinder with three chambers, each with an inlet through the end at x = 0; the first one at +z."""
    shape = Cylinder(Pnt(0, 0, 0), X, 10, 50)
    for angle in (0, 2 * pi / 3, 4 * pi / 3):
        y, z = -5 * np.sin(angle), 5 * np.cos(angle)
        shape = shape - Cylinder(Pnt(5, y, z), X, 2, 40) - Cylinder(Pnt(-1, y, z), X, 0.7, 10)
    return shape


CHAMBER_VOLUME = pi * 4 * 40 + pi * 0.49 * 5


def written(folder, shape, name="part.step"):
    """Write a shape, or bodies side by side, and return the path."""
    path = Path(folder) / name
    shape = Glue(shape) if isinstance(shape, list) else shape
    if path.suffix == ".brep":
        shape.WriteBrep(str(path))
    else:
        shape.WriteStep(str(path))
    return path


def write_stl(path, triangles, text=False):
    """Write triangles (t, 3, 3) as STL."""
    if text:
        lines = ["solid part"]
        for corners in triangles:
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {x:.9e} {y:.9e} {z:.9e}" for x, y, z in corners]
            lines += ["endloop", "endfacet"]
        path.write_text("\n".join([*lines, "endsolid part", ""]), encoding="ascii")
        return path
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows = np.zeros(len(triangles), dtype=kind)
    rows["corners"] = triangles
    path.write_bytes(b"\0" * 80 + len(rows).to_bytes(4, "little") + rows.tobytes())
    return path
