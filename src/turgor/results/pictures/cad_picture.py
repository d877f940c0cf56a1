"""Picture of an inspected CAD part: transparent walls, with cavities and named faces in color."""

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

from turgor.geometry.cad.inspection import Inspection
from turgor.units import mm

#: Colors of named faces, distinct for color-blind readers too (Okabe and Ito 2008); the outside is gray.
COLORS = ("#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#f0e442")

#: Opacity of the outside and of named faces.
FAINT, CLEAR = 0.08, 0.55

#: The two views: elevation above the horizon and azimuth around z [degrees].
VIEWS = ((22, -60), (-22, 120))


def write_cad_picture(path: str | Path, part: Inspection) -> None:
    """Draw a part from two sides as PNG, with one color for each named face.

    Parameters
    ----------
    path : str or Path
        File to write.
    part : Inspection
        What `inspect_cad` found.
    """
    names = sorted({face.name for face in part.faces} - {"outside"}, key=lambda n: (not n.startswith("cavity"), n))
    colors = {name: COLORS[i % len(COLORS)] for i, name in enumerate(names)}
    figure = Figure(figsize=(12, 4.8), dpi=130)
    FigureCanvasAgg(figure)
    low = np.min([face.triangles.min(axis=(0, 1)) for face in part.faces], axis=0) / mm
    high = np.max([face.triangles.max(axis=(0, 1)) for face in part.faces], axis=0) / mm
    for i, (raised, turned) in enumerate(VIEWS):
        axes = figure.add_subplot(1, 2, i + 1, projection="3d", computed_zorder=False)
        for face in sorted(part.faces, key=lambda face: face.name in colors):
            named = face.name in colors
            axes.add_collection3d(
                Poly3DCollection(
                    face.triangles / mm,
                    facecolors=colors.get(face.name, "#808080"),
                    alpha=CLEAR if named else FAINT,
                    edgecolors="none",
                )
            )
        for cavity in part.cavities:
            for _, center in cavity.openings:
                axes.scatter(*(value / mm for value in center), color="#d00000", s=14, depthshade=False)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        axes.set(xlabel="x [mm]", ylabel="y [mm]", zlabel="z [mm]")
        axes.set_box_aspect(np.maximum(high - low, 0.05 * float((high - low).max())), zoom=1.15)
        axes.locator_params(nbins=4)
        axes.view_init(raised, turned)
    patches = [Patch(color=color, alpha=CLEAR, label=name) for name, color in colors.items()]
    figure.legend(handles=patches, loc="lower center", ncols=min(len(patches), 6) or 1, frameon=False)
    figure.suptitle(f"{part.name} · {' × '.join(f'{side / mm:.4g}' for side in part.size)} mm")
    figure.savefig(path)
