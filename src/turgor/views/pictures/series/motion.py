"""Motion: the path of an actuator as an animation (GIF, WebP, MP4) or as a moving body (GLB)."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.store.atomic_files import whole
from turgor.views.pictures.colors import VON_MISES, Field, field_of
from turgor.views.pictures.rendering import View
from turgor.views.pictures.series.frames import frames
from turgor.views.pictures.series.gltf import write_glb
from turgor.views.pictures.state_picture import Style, pixels_of, shared_view

Bytes = NDArray[np.uint8]

#: Endings of files with motion.
ENDINGS = (".gif", ".webp", ".mp4", ".glb")

#: Shapes between which a GLB file moves.
KEY_SHAPES = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """How a path moves in a file.

    Parameters
    ----------
    seconds : float [s]
        How long it takes from rest to the last state.
    rate : int [1/s]
        Pictures for each second.
    back : bool
        Whether it plays back to rest, and again.
    width : int
        Width of the pictures in pixels, 400 or more.

    Examples
    --------
    >>> Motion(seconds=2.0).count
    30
    """

    seconds: float = 2.0
    rate: int = 15
    back: bool = True
    width: int = 640

    def __post_init__(self) -> None:
        for name, low, high in (("seconds", 0.2, 120.0), ("rate", 2, 60), ("width", 400, 4000)):
            if not low <= getattr(self, name) <= high:
                raise TurgorError(f"{name} of a motion is {getattr(self, name)}; allowed is {low:g} to {high:g}.")

    @property
    def count(self) -> int:
        """Pictures from rest to the last state."""
        return max(2, round(self.seconds * self.rate))


def write_motion(
    path: str | Path,
    solution: Solution,
    *,
    color_by: str | Field = VON_MISES,
    motion: Motion | None = None,
    style: Style | None = None,
) -> Path:
    """Write the motion along a path, as the ending of the file says: GIF, WebP, MP4, or GLB for 3-D viewers.

    All pictures have the same view, scale and colors. A GLB file holds the surface of the whole actuator with its
    shapes along the path as morph targets; colors move with them where the viewer knows how.

    Parameters
    ----------
    path : str or Path
        File to write.
    solution : Solution
        The path, complete or not.
    color_by : str or Field
        See `shared_view`.
    motion : Motion, optional
        Time, rate and size.
    style : Style, optional
        Cut away, transparent, with edges; not of GLB files.

    Returns
    -------
    Path

    Raises
    ------
    TurgorError
        If the ending is unknown, nothing moves, or MP4 is requested without the extra ``motion``.
    """
    path, motion = Path(path), motion or Motion()
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise unknown("ending of a file with motion", ending or str(path), ENDINGS)
    encoder = _encoder() if ending == ".mp4" else None
    if ending == ".glb":
        shapes = list(frames(solution, field_of(color_by), KEY_SHAPES))
        view = shared_view(shapes, motion.width, color_by)
        with whole(path) as part:
            write_glb(part, shapes, view, seconds=motion.seconds, back=motion.back)
        return path
    images = moving_pictures(solution, color_by, motion, style)
    with whole(path) as part:
        if encoder is not None:
            _write_mp4(encoder, part, images, motion)
        else:
            _write_animation(part, ending, images, motion)
    return path


def moving_pictures(
    solution: Solution, color_by: str | Field = VON_MISES, motion: Motion | None = None, style: Style | None = None
) -> list[Bytes]:
    """Draw the pictures of a motion from rest to the last state, all of one size, (h, w, 3) each.

    Parameters
    ----------
    solution, color_by, motion, style
        See `write_motion`.
    """
    motion = motion or Motion()
    shapes = list(frames(solution, field_of(color_by), motion.count))
    view = shared_view(shapes, motion.width, color_by)
    drawn, tops = [], []
    for shape in shapes:
        drawn.append(pixels_of(shape, view, style=style))
        tops.append(_top(shape.points, view, shape.facts.images))
    return _stacked(drawn, tops, view)


def _top(points: NDArray[np.float64], view: View, images: Sequence[Any]) -> float:
    """Vertical coordinate of the middle of the actuator in a picture [m]."""
    flat = np.concatenate([view.eye.project(image.of(points))[:, 1] for image in images])
    return float((flat.max() + flat.min()) / 2)


def _stacked(drawn: list[Bytes], middles: list[float], view: View) -> list[Bytes]:
    """Put pictures whose middles are at given heights [m] onto canvases of one size, with even sides for MP4."""
    above = [round(middle / view.pixel) + each.shape[0] // 2 for each, middle in zip(drawn, middles, strict=True)]
    below = [top - each.shape[0] for top, each in zip(above, drawn, strict=True)]
    height, width = max(above) - min(below), drawn[0].shape[1]
    size = height + height % 2, width + width % 2
    out = []
    for each, top in zip(drawn, above, strict=True):
        canvas = np.full((*size, 3), 255, dtype=np.uint8)
        first = max(above) - top
        canvas[first : first + each.shape[0], :width] = each
        out.append(canvas)
    return out


def _write_animation(path: Path, ending: str, images: list[Bytes], motion: Motion) -> None:
    played = images + (images[-2:0:-1] if motion.back else [])
    first, *rest = [Image.fromarray(each) for each in played]
    shown = round(1000 / motion.rate)
    if ending == ".gif":
        colors = first.quantize(255, method=Image.Quantize.MEDIANCUT) if not rest else _palette([first, *rest])
        first, *rest = [each.quantize(palette=colors, dither=Image.Dither.NONE) for each in (first, *rest)]
        first.save(path, format="GIF", save_all=True, append_images=rest, duration=shown, loop=0)
    else:
        first.save(path, format="WEBP", save_all=True, append_images=rest, duration=shown, loop=0, quality=70, method=4)


def _palette(pictures: list[Image.Image]) -> Image.Image:
    """One palette for all pictures, so that colors do not flicker."""
    some = pictures[:: max(1, len(pictures) // 6)]
    joined = Image.new("RGB", (some[0].width, sum(each.height for each in some)))
    for number, each in enumerate(some):
        joined.paste(each, (0, number * some[0].height))
    return joined.quantize(255, method=Image.Quantize.MEDIANCUT)


def _encoder() -> Any:
    """OpenCV, whose wheels hold an LGPL build of FFmpeg; those of PyAV and imageio-ffmpeg have GPL parts."""
    try:
        return import_module("cv2")
    except ImportError:
        raise TurgorError(
            "MP4 needs OpenCV, which is not installed: pip install 'turgor[motion]'. GIF, WebP and GLB need nothing."
        ) from None


def _write_mp4(cv2: Any, path: Path, images: list[Bytes], motion: Motion) -> None:
    height, width = images[0].shape[:2]
    temporary = path.with_name(path.name + ".mp4")  # OpenCV chooses the container by the ending
    writer = cv2.VideoWriter(str(temporary), cv2.VideoWriter_fourcc(*"mp4v"), float(motion.rate), (width, height))
    if not writer.isOpened():
        raise TurgorError("OpenCV cannot write MP4 on this machine; write .gif or .webp instead.")
    for each in images + (images[-2::-1] if motion.back else []):
        writer.write(np.ascontiguousarray(each[..., ::-1]))
    writer.release()
    temporary.replace(path)
