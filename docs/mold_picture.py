"""Picture of a mold in docs/howto/export.md: the halves and the core, pulled apart.

python docs/mold_picture.py
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import pyvista

import turgor as tg
from turgor.units import mm

FILE = Path(__file__).parent / "images" / "mold.png"

#: How far each part is moved [mm], and its color.
PARTS = {"lower": ((0, 0, -22), "#8da0b3"), "upper": ((0, 0, 26), "#c9d3dd"), "core": ((-45, 0, 0), "#d98c3f")}


def main() -> None:
    mold = tg.cad.casting_mold(tg.actuators.SemicircularBender(length=60 * mm, inlet_diameter=4 * mm))
    plotter = pyvista.Plotter(off_screen=True, window_size=(1200, 760))
    plotter.set_background("white")
    with TemporaryDirectory() as folder:
        for name, (away, color) in PARTS.items():
            tg.files.write_stl(mold.parts[name], f"{folder}/{name}.stl")
            mesh = pyvista.read(f"{folder}/{name}.stl").translate(away)
            plotter.add_mesh(mesh, color=color, split_sharp_edges=True, smooth_shading=True)
            plotter.add_mesh(mesh.extract_feature_edges(35), color="#333333", line_width=1.5)
    plotter.camera_position = "xz"
    plotter.camera.azimuth, plotter.camera.elevation = -35, 22
    plotter.reset_camera()
    plotter.camera.zoom(1.35)
    plotter.screenshot(FILE)


if __name__ == "__main__":
    main()
