"""Renew the WebGL library of the viewer: `python release/three_js.py [VERSION]` (needs npm).

It takes three.js (MIT) and the bundler esbuild (MIT) from npm and writes one script with the parts that the viewer
uses, which a page can hold and open without a server. The license is written beside it.
"""

import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

TO = Path(__file__).parents[1] / "src" / "turgor" / "results" / "viewer" / "vendor"

#: Versions that the script in the package was made with.
THREE, ESBUILD = "0.187.0", "0.28.2"

#: What the viewer uses; a script of the page names these as ``THREE.Mesh`` and so on.
PARTS = (
    "AlwaysStencilFunc", "AmbientLight", "BackSide", "Box3", "BufferAttribute", "BufferGeometry", "DataTexture",
    "DecrementWrapStencilOp", "DirectionalLight", "DoubleSide", "FrontSide", "IncrementWrapStencilOp",
    "LineBasicMaterial", "LineSegments", "LinearFilter", "Matrix4", "Mesh", "MeshBasicMaterial",
    "MeshLambertMaterial", "NotEqualStencilFunc", "OrthographicCamera", "Plane", "PlaneGeometry", "Raycaster",
    "RGBAFormat", "SRGBColorSpace", "Scene", "Vector2", "Vector3", "WebGLRenderer",
)  # fmt: skip


def renew(version: str) -> Path:
    """Bundle three.js of a version; return the script."""
    with TemporaryDirectory() as place:
        at = Path(place)
        subprocess.run(
            ["npm", "install", "--no-audit", "--no-fund", f"three@{version}", f"esbuild@{ESBUILD}"], cwd=at, check=True
        )
        (at / "entry.js").write_text(
            f'export {{ {", ".join(PARTS)} }} from "three";\n'
            'export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";\n',
            encoding="utf-8",
        )
        script = TO / "three.min.js"
        subprocess.run(
            [
                str(at / "node_modules" / ".bin" / "esbuild"), "entry.js", "--bundle", "--minify", "--format=iife",
                "--global-name=THREE", "--target=es2020", "--legal-comments=eof", f"--outfile={script}",
            ],
            cwd=at,
            check=True,
        )  # fmt: skip
        shutil.copy(at / "node_modules" / "three" / "LICENSE", TO / "LICENSE-three.txt")
    return script


if __name__ == "__main__":
    made = renew(sys.argv[1] if len(sys.argv) > 1 else THREE)
    print(f"{made.name}: {made.stat().st_size / 1000:.0f} kB")
