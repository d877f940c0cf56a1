"""Pictures of molds in docs/howto/export.md, their parts pulled apart.

python docs/mold_picture.py
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import pyvista

import turgor as tg
from turgor.units import deg, mm

IMAGES = Path(__file__).parent / "images"

#: How far each part is moved [mm], and its color.
HALVES = {"lower": ((0, 0, -22), "#8da0b3"), "upper": ((0, 0, 26), "#c9d3dd"), "core": ((-45, 0, 0), "#d98c3f")}
PNEUNET = {"cup": ((0, 0, 34), "#c9d3dd"), "casting": ((0, 0, 8), "#d9b48f"), "core": ((0, 0, -18), "#d98c3f")}


def main() -> None:
    bender = tg.actuators.SemicircularBender(length=60 * mm, inlet_diameter=4 * mm)
    draw("mold.png", tg.cad.casting_mold(bender), HALVES, 22, 1.35)
    finger = tg.actuators.FastPneuNet(chambers=3, length=36 * mm)
    draw("mold-draft.png", tg.cad.casting_mold(finger, tg.cad.MoldSettings(draft=5 * deg)), PNEUNET, 12, 1.0)


def draw(name: str, mold: tg.cad.Mold, moved: dict, elevation: float, zoom: float) -> None:
    plotter = pyvista.Plotter(off_screen=True, window_size=(1200, 760))
    plotter.set_background("white")
    parts = {**mold.parts, "casting": mold.casting}
    with TemporaryDirectory() as folder:
        for part, (away, color) in moved.items():
            tg.files.write_stl(parts[part], f"{folder}/{part}.stl")
            mesh = pyvista.read(f"{folder}/{part}.stl").translate(away)
            plotter.add_mesh(mesh, color=color, split_sharp_edges=True, smooth_shading=True)
            plotter.add_mesh(mesh.extract_feature_edges(35), color="#333333", line_width=1.5)
    plotter.camera_position = "xz"
    plotter.camera.azimuth, plotter.camera.elevation = -35, elevation
    plotter.reset_camera()
    plotter.camera.zoom(zoom)
    plotter.screenshot(IMAGES / name)


if __name__ == "__main__":
    main()
