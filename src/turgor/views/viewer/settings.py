"""Settings of the viewer: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ViewerSettings:
    """What a page can hold, and how it looks.

    Parameters
    ----------
    steps : int
        Most steps that it shows: more cannot be distinguished on a slider.
    page_bytes : int
        Size of a page that can be sent by mail. Every second step is left out of a scene that is larger. All steps of
        one part may have half of it, before they are packed: of the surface, beyond which there are fewer steps; of the
        tetrahedra inside, beyond which they have no middle nodes, or are left out; and of threads, beyond which each is
        drawn through every second, third … point.
    least : int
        Fewest states between which the page interpolates; half of them still have the four that a cubic needs.
    jump : float
        Error of a displacement with every other state left out, over the largest, above which a path counts as one that
        jumps. On the demo finger it is 0.03 % with 50 states and 0.4 % with 15.
    height : int
        Height in a notebook, and largest height of a picture on a page [pixels].
    """

    steps: int = 40
    page_bytes: int = 10_000_000
    least: int = 7
    jump: float = 0.05
    height: int = 680

    @property
    def part_bytes(self) -> int:
        """Bytes of all steps of one part."""
        return self.page_bytes // 2


VIEWER = ViewerSettings()
