"""Settings of pictures: every number that was chosen, with its reason.

Shares are of the size of the actuator, the longest side of its bounding box, unless it is stated otherwise. The tests
of pictures and the pictures of the documentation need them: another number gives another picture.
"""

from dataclasses import dataclass

from turgor.units import deg


@dataclass(frozen=True, slots=True)
class RenderingSettings:
    """How finely a picture is computed.

    Parameters
    ----------
    samples : int
        Samples along each side of a pixel (supersampling).
    rows : int
        Rows of pixels that are rendered together, to save memory.
    parts, triangles : int
        Parts of each side of a six-node triangle, so that curved faces look curved; two parts where there would be
        more flat triangles than this, because the mesh is fine enough.
    sharp_edge : float [rad]
        Surfaces that meet at more than this angle at rest have a sharp edge between them.
    sky_rays, sky_reach : int, float
        Rays from a point for the ambient occlusion, and their length as a share.
    depth_jump : float
        A jump in depth of more than this share is an edge. A thread no deeper than it is visible, and walls closer to
        each other count as touching.
    unseen : float
        No one sees less than this share: fields of such a share of their colors need no color bar.
    """

    samples: int = 2
    rows: int = 96
    parts: int = 4
    triangles: int = 60_000
    sharp_edge: float = 30 * deg
    sky_rays: int = 32
    sky_reach: float = 0.12
    depth_jump: float = 0.006
    unseen: float = 1e-3


RENDERING = RenderingSettings()


@dataclass(frozen=True, slots=True)
class LookSettings:
    """Light and opacities of pictures.

    Parameters
    ----------
    lamp, lamp_place : float, (3,) floats
        Share of the light from the lamp, and its direction along right, up and forward. The rest is ambient light,
        which the ambient occlusion reduces.
    shadow, deep_shadow : float
        Largest share of the light that shadow takes from a color that means a value, and from plain rubber.
    overlay : float
        Opacity of what is drawn over the actuator: threads, contact patches behind it, obstacles, and named faces.
    faint_pressure : float
        Smallest contact pressure that is drawn, as a share of the upper end of the colors. Smaller ones occur in the
        last cells of a patch, where the pressure decays.
    outside : float
        Opacity of the outside of a part.
    """

    lamp: float = 0.45
    lamp_place: tuple[float, float, float] = (-0.45, 0.75, -0.65)
    shadow: float = 0.26
    deep_shadow: float = 0.62
    overlay: float = 0.75
    faint_pressure: float = 0.06
    outside: float = 0.08


LOOK = LookSettings()


@dataclass(frozen=True, slots=True)
class FramingSettings:
    """Directions and margins of pictures. Lengths are pixels of a picture of full width.

    Parameters
    ----------
    front : float [rad]
        Azimuth of the camera. For contact pressure it is twice as much: the walls between chambers are visible more
        from the side.
    full_width, design_width : int
        Width of a large picture, and of a small one, as of a design in a study or in a notebook [pixels]. Between them
        letters and bands grow in proportion to the width.
    narrowest : float
        A picture is at least this share of its width wide, however slender the actuator is: its legend needs room.
    margin : int
        Around the actuator, and height of the captions of a sheet. The title above takes twice as much, the color bar
        below three times.
    around : float
        Share around the actuator in which obstacles are shown.
    """

    front: float = 20 * deg
    full_width: int = 1600
    design_width: int = 700
    narrowest: float = 0.6
    margin: int = 50
    around: float = 0.3


FRAMING = FramingSettings()


@dataclass(frozen=True, slots=True)
class MarkSettings:
    """Marks of supports and loads. Lengths are pixels of a picture of full width.

    Parameters
    ----------
    most : int
        Most marks of one face or place: enough for its corners, and few enough to see the actuator.
    apart : float
        Marks of one face are at least this share of the size of the actuator apart, so that they do not touch.
    factors : int
        Load factors, 0 first, among which the largest prescribed displacement is looked for.
    size, arrow : int
        Height of a triangle, and length of an arrow or a spring; an arrow fits into the margin.
    shortest : float
        A foreshortened arrow has at least this share of its length, so that there is a line behind its head.
    head_on : float
        Directions of which less than this share lies in the picture are drawn as a circle.
    hidden : float
        Opacity of marks behind the actuator.
    aside : float
        Share of the length of a body at which the level of a pool is marked beyond its ends, within the margin.
    """

    most: int = 6
    apart: float = 0.1
    factors: int = 9
    size: int = 18
    arrow: int = 44
    shortest: float = 0.55
    head_on: float = 0.1
    hidden: float = 0.35
    aside: float = 0.02


MARKS = MarkSettings()
