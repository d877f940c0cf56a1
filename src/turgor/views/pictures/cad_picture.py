"""Picture of an inspected CAD part: transparent walls, with cavities and named faces in color."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import NDArray

from turgor.core.geometry.cad.inspection import Inspection
from turgor.units import mm
from turgor.views.pictures.settings import LOOK
from turgor.views.plots.figures import check_ending, write_figure

Array = NDArray[np.float64]

#: Colors of named faces, distinct for color-blind readers too (Okabe and Ito 2008); the outside is gray.
COLORS = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#f0e442")

#: The two views: elevation above the horizon and azimuth around z [degrees].
VIEWS = ((22, -60), (-22, 120))


def write_cad_picture(path: str | Path, part: Inspection) -> None:
    """Draw a part from two sides as PNG, with one color for each named face.

    Parameters
    ----------
    path : str or Path
        PNG file to write.
    part : Inspection
        Result of `inspect_cad`.
    """
    check_ending(path, "picture")
    openings = [center for cavity in part.cavities for _, center in cavity.openings]
    faces = [(face.name, face.triangles) for face in part.faces]
    write_figure(path, named_faces_figure(part.name, faces, openings), kind="picture")


def named_faces_figure(title: str, faces: Sequence[tuple[str, Array]], marks: Sequence[Sequence[float]] = ()) -> Figure:
    """Draw named faces from two sides, with one color for each name and a transparent outside.

    Parameters
    ----------
    title : str
        Line above the views; the size follows it.
    faces : sequence of (str, (t, 3, 3) array [m])
        Name and triangles of each face.
    marks : sequence of (3,) [m]
        Points to mark, such as openings.

    Returns
    -------
    matplotlib.figure.Figure
    """
    names = sorted({name for name, _ in faces} - {"outside"}, key=lambda n: (not n.startswith("cavity"), n))
    colors = {name: COLORS[i % len(COLORS)] for i, name in enumerate(names)}
    figure = Figure(figsize=(12, 4.8), dpi=130)
    FigureCanvasAgg(figure)
    low = np.min([triangles.min(axis=(0, 1)) for _, triangles in faces], axis=0) / mm
    high = np.max([triangles.max(axis=(0, 1)) for _, triangles in faces], axis=0) / mm
    for i, (raised, turned) in enumerate(VIEWS):
        axes = figure.add_subplot(1, 2, i + 1, projection="3d", computed_zorder=False)
        for name, triangles in sorted(faces, key=lambda face: face[0] in colors):
            named = name in colors
            axes.add_collection3d(
                Poly3DCollection(
                    triangles / mm,
                    facecolors=colors.get(name, "#808080"),
                    alpha=LOOK.overlay if named else LOOK.outside,
                    edgecolors="none",
                )
            )
        for place in marks:
            axes.scatter(*(value / mm for value in place), color="#d00000", s=14, depthshade=False)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        axes.set(xlabel="x [mm]", ylabel="y [mm]", zlabel="z [mm]")
        axes.set_box_aspect(np.maximum(high - low, 0.05 * float((high - low).max())), zoom=1.15)
        for axis, ends in zip((axes.xaxis, axes.yaxis, axes.zaxis), zip(low, high, strict=True), strict=True):
            axis.set_ticks([round(float(end), 3) for end in ends])  # the labels of more ticks may overlap
        axes.view_init(raised, turned)
    patches = [Patch(color=color, alpha=LOOK.overlay, label=name) for name, color in colors.items()]
    figure.legend(handles=patches, loc="lower center", ncols=min(len(patches), 6) or 1, frameon=False)
    size = f"{' × '.join(f'{side:.4g}' for side in high - low)} mm"
    figure.suptitle(f"{title} · {size}" if title else size)
    return figure
