"""Settings of the viewer: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ViewerSettings:
    """What a page can hold, and how it looks.

    Parameters
    ----------
    steps : int
        Most steps that it shows: more cannot be distinguished on a slider.
    surface_bytes, inside_bytes : int
        Bytes of all steps before they are packed, about as many as on the page: of the surface, beyond which there are
        fewer steps, and of the tetrahedra inside, beyond which they have no middle nodes, or are left out.
    page_bytes : int
        Size of a page that can be sent by mail. Every second step is left out of a scene that is larger.
    thread_points : int
        Points of all threads beyond which each is drawn through every second, third … point.
    height : int
        Height in a notebook [pixels].
    """

    steps: int = 40
    surface_bytes: int = 8_000_000
    inside_bytes: int = 3_000_000
    page_bytes: int = 10_000_000
    thread_points: int = 20_000
    height: int = 680


VIEWER = ViewerSettings()
