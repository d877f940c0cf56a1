"""Make the STEP files of this folder and examples/cad_file.step with build123d 0.13.

Run it in an environment of its own, with nothing of turgor in it: build123d and netgen carry different versions of
the CAD kernel and must not meet in one process.

    pip install build123d==0.13.0
    python make_fixtures.py
"""

from pathlib import Path

from build123d import (
    Align,
    Axis,
    Box,
    Color,
    Compound,
    Cylinder,
    Part,
    Plane,
    Polyline,
    Pos,
    Rot,
    Text,
    export_step,
    extrude,
    fillet,
    make_face,
    revolve,
)

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[3] / "examples"
LOW = (Align.MIN, Align.CENTER, Align.MIN)


def solid(shape, label, color):
    """A part with a label and a color."""
    part = Part(shape.wrapped)
    part.label, part.color = label, Color(*color)
    return part


def tube():
    """A closed tube along x, 50 mm long, with a radial inlet through its seam: one cavity."""
    shape = Rot(0, 90, 0) * Cylinder(10, 50) - Rot(0, 90, 0) * Cylinder(8, 40)
    shape -= Cylinder(2, 20, align=(Align.CENTER, Align.CENTER, Align.MIN))
    return solid(shape, "finger tube", (1, 0, 0))


def cup_and_plate():
    """An open cup upside down with an axial inlet, and the plate that closes it, moved there in an assembly."""
    cup = Box(40, 20, 10, align=LOW) - Pos(3, 0, 0) * Box(34, 14, 8, align=LOW)
    cup -= Pos(-1, 0, 4) * Rot(0, 90, 0) * Cylinder(1.5, 10)
    plate = Box(40, 20, 2.5, align=LOW)
    top = Pos(0, 0, 2.5) * solid(cup, "top", (0, 0.5, 0))
    base = solid(plate, "base plate", (0, 0, 1))
    # as FreeCAD writes a part within an assembly
    return Compound(label="Assembly", children=[Compound(label="Part", children=[top]), base])


def finger():
    """A PneuNet of four chambers, open below, with an axial inlet, and its base plate."""
    chambers, pitch, gap, wall, width, height = 4, 10.0, 1.5, 1.5, 16.0, 13.0
    top = Box(chambers * pitch - gap, width, height, align=LOW)
    for i in range(chambers - 1):
        slot = Box(gap, width, height, align=LOW) - Box(gap, 6, 5, align=LOW)
        top -= Pos(i * pitch + pitch - gap, 0, 0) * slot
    for i in range(chambers):
        room = Box(pitch - gap - 2 * wall, width - 2 * wall, height - wall, align=LOW)
        top -= Pos(i * pitch + wall, 0, 0) * room
    top -= Pos(wall, 0, 0) * Box(chambers * pitch - gap - 2 * wall, 3, 3, align=LOW)
    top -= Pos(-1, 0, 4) * Rot(0, 90, 0) * Cylinder(1.2, 8)
    plate = Box(chambers * pitch - gap, width, 2.5, align=LOW)
    parts = [Pos(0, 0, 2.5) * solid(top, "top", (0.9, 0.6, 0.2)), solid(plate, "base", (0.3, 0.3, 0.8))]
    return Compound(label="finger", children=parts)


def lobes(wall, start, end):
    """A quarter of a solid of revolution about x with six lobes, whose edges have fillets of 0.8 mm.

    The outer surface has wall = 0; the air within has the wall's thickness and ends at other places.
    """
    root, crest, pitch, width = 8.0, 14.0, 6.5, 4.0
    corners = [(start, 0), (start, root - wall)]
    for i in range(6):
        a = 5.5 + i * pitch
        b = a + width
        corners += [
            (a + wall, root - wall),
            (a + wall, crest - wall),
            (b - wall, crest - wall),
            (b - wall, root - wall),
        ]
    corners += [(end, root - wall), (end, 0)]
    face = make_face(Polyline(*corners, close=True).edges())
    rounded = fillet([v for v in face.vertices() if start < v.X < end], 0.8)
    return revolve(rounded, Axis.X, 90)


def bellows():
    """A quarter of a closed bellows of six lobes along x, with a wall of 1 mm and fillets of 0.8 mm."""
    return solid((lobes(0, 0, 47.5) - lobes(1, 3, 44.5)).solid(), "bellows", (0.2, 0.6, 0.9))


def labeled_box():
    """A closed box with walls of 2 mm and text engraved 0.4 mm deep in its roof."""
    box = Box(50, 16, 12, align=LOW) - Pos(2, 0, 2) * Box(46, 12, 8, align=LOW)
    text = Pos(25, 0, 12) * extrude(Plane.XY * Text("soft", font_size=6), amount=-0.4)
    return solid((box - text).solid(), "box", (0.8, 0.8, 0.2))


if __name__ == "__main__":
    export_step(tube(), HERE / "tube_radial_inlet.step", write_pcurves=False)
    export_step(cup_and_plate(), HERE / "cup_and_plate.step", write_pcurves=False)
    export_step(bellows(), HERE / "bellows.step", write_pcurves=False)
    export_step(labeled_box(), HERE / "labeled_box.step", write_pcurves=False)
    export_step(finger(), EXAMPLES / "cad_file.step", write_pcurves=False)
