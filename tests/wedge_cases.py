"""Parts that are the same after each of n turns about x, as STEP files in millimeters."""

from netgen.occ import Axis, Box, Cylinder, Pnt, X, Y
from turgor.cad import WithNormal

ENDS = {"fixed": WithNormal("-x"), "tip": WithNormal("+x")}
AXIS = Axis(Pnt(0, 0, 0), X)


def written(shape, path):
    shape.WriteStep(str(path))
    return path


def tube():
    """A tube of radii 6 and 8 with closed ends."""
    return Cylinder(Pnt(0, 0, 0), X, r=8, h=24) - Cylinder(Pnt(2, 0, 0), X, r=6, h=20)


def finned(fins=4, angle=35.0):
    """The same with straight fins that lie askew on it: no plane maps it onto itself."""
    shape = tube()
    fin = Box(Pnt(5, 7, -1), Pnt(19, 11, 1)).Rotate(Axis(Pnt(12, 0, 0), Y), angle)
    for turn in range(fins):
        shape = shape + fin.Rotate(AXIS, 360 / fins * turn)
    return shape


def chambers(count=6, at=(0.0, 0.0)):
    """A rod with round chambers around its axis."""
    y, z = at
    body = Cylinder(Pnt(0, y, z), X, r=10, h=16)
    for turn in range(count):
        body = body - Cylinder(Pnt(2, y + 6, z), X, r=2, h=12).Rotate(Axis(Pnt(0, y, z), X), 360 / count * turn)
    return body


def lobed(lobes=6, wall=1.0, length=30.0):
    """A bellows of round lobes around its axis, with closed ends."""

    def bundle(start, end, less):
        shape = Cylinder(Pnt(start, 0, 0), X, r=9 - less, h=end - start)
        lobe = Cylinder(Pnt(start, 9, 0), X, r=4 - less, h=end - start)
        for turn in range(lobes):
            shape = shape + lobe.Rotate(AXIS, 360 / lobes * turn)
        return shape

    return bundle(0, length, 0.0) - bundle(2 * wall, length - 2 * wall, wall)
