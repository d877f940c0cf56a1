"""Source archive and wheel, checked and tried: `make dist`.

The wheel is built from the unpacked source archive, which shows that nothing is missing there. For each Python that the
project names and that is found, an empty environment gets the wheel with the locked versions of its parts, and solves a
small job in an empty folder.
"""

import argparse
import csv
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from email import message_from_bytes
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PARTS = ("turgor/", f"turgor-{PROJECT['version']}.dist-info/")
PYTHONS = re.findall(r"Python :: (3\.\d+)", " ".join(PROJECT["classifiers"]))

#: Changes that make the demo small: two chambers, a coarse mesh, a small pressure.
SMALL = (
    "actuator.chambers=2",
    "actuator.length=20 mm",
    "mesh.size=4 mm",
    "loads.pressure=2 kPa",
    "output.report=false",
    "output.mesh_error=false",
)


def build(folder: Path) -> tuple[Path, Path]:
    """Build the source archive, and the wheel from what it holds."""
    shutil.rmtree(folder, ignore_errors=True)
    run(sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", str(folder))
    (archive,) = folder.glob("*.tar.gz")
    with TemporaryDirectory() as place:
        with tarfile.open(archive) as packed:
            packed.extractall(place, filter="data")
        (inside,) = Path(place).iterdir()
        run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder), at=inside)
    (wheel,) = folder.glob("*.whl")
    return archive, wheel


def mistakes(archive: Path, wheel: Path) -> list[str]:
    """List what is wrong with the two files."""
    with zipfile.ZipFile(wheel) as packed:
        held = packed.namelist()
        metadata = message_from_bytes(packed.read(next(name for name in held if name.endswith("/METADATA"))))
        damaged = packed.testzip()
    text = str(metadata.get_payload())
    found = [f"{wheel.name}: {damaged} is damaged"] if damaged else []
    for key, wanted in (("Name", "name"), ("Version", "version"), ("Requires-Python", "requires-python")):
        if metadata[key] != PROJECT[wanted]:
            found.append(f"{wheel.name}: {key} is {metadata[key]}, not {PROJECT[wanted]}")
    if metadata["Description-Content-Type"] != "text/markdown" or not text.startswith("# turgor"):
        found.append(f"{wheel.name}: the description is not the README")
    if metadata["License-Expression"] != PROJECT["license"]:
        found.append(f"{wheel.name}: License-Expression is {metadata['License-Expression']}")
    found += [f"{wheel.name}: the description links to the file {each}" for each in files_linked(text)]
    found += [f"{wheel.name}: {name} is no part of the package" for name in held if not name.startswith(PARTS)]
    with tarfile.open(archive) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    needed = ("LICENSE", "README.md", "pyproject.toml", "src/turgor/__init__.py", "tests/conftest.py")
    return found + [f"{archive.name}: {name} is missing" for name in needed if name not in names]


def files_linked(text: str) -> list[str]:
    """List the targets of links and pictures that are files."""
    targets = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"(?:src|href)=\"([^\"]+)\"", text)
    return [target for target in targets if not re.match(r"[a-z]+:|#", target)]


def python(version: str) -> str | None:
    """Find an interpreter of a version; None where there is none."""
    ask = ("-c", "import sys; print('{}.{}'.format(*sys.version_info))")
    for name in (f"python{version}", sys.executable):
        path = shutil.which(name)
        answer = subprocess.run([path, *ask], capture_output=True, text=True, check=False) if path else None
        if path and answer is not None and answer.stdout.strip() == version:
            return path
    return None


def demo(interpreter: str, wheel: Path) -> str:
    """Install the wheel into an empty environment, solve the small job there, and return the last bending angle."""
    with TemporaryDirectory() as place:
        run(interpreter, "-m", "venv", "env", at=Path(place))
        inside = Path(place) / "env" / ("Scripts" if os.name == "nt" else "bin")
        locked = ("-c", str(ROOT / "requirements" / "run.lock"))
        run(str(inside / "python"), "-m", "pip", "install", "--quiet", *locked, str(wheel.resolve()), at=Path(place))
        turgor = str(inside / "turgor")
        run(turgor, "init", "fast_pneunet", "--output", "finger.toml", at=Path(place))
        changes = [part for change in SMALL for part in ("--set", change)]
        run(turgor, "run", "finger.toml", "--output", "results", "--quiet", *changes, at=Path(place))
        with (Path(place) / "results" / "response.csv").open(encoding="utf-8") as file:
            *_, last = csv.DictReader(file)
    angle = float(last["bending_angle_deg"])
    if not 1 < angle < 90:
        raise SystemExit(f"the bending angle of the demo is {angle:g} deg.")
    return f"{angle:.2f} deg"


def run(*command: str, at: Path = ROOT) -> None:
    """Run a command without what this environment adds; end with its output where it fails."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}
    done = subprocess.run(command, cwd=at, env=kept, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")


def main() -> None:
    """Build, check and try; exit with 1 where something is wrong."""
    parser = argparse.ArgumentParser(description="Build, check and try source archive and wheel.")
    parser.add_argument("--pythons", nargs="*", default=PYTHONS, help="versions to try, by default all that are found")
    chosen = parser.parse_args()
    archive, wheel = build(ROOT / "dist")
    found = mistakes(archive, wheel)
    if found:
        raise SystemExit("\n".join(found))
    for file in (archive, wheel):
        print(f"{file.relative_to(ROOT)}: {file.stat().st_size / 1e6:.2f} MB, checked")
    found_any = False
    for version in chosen.pythons:
        interpreter = python(version)
        found_any = found_any or interpreter is not None
        said = "not found, left out" if interpreter is None else f"the demo bends {demo(interpreter, wheel)}"
        print(f"Python {version}: {said}", flush=True)
    if chosen.pythons and not found_any:
        raise SystemExit(f"none of Python {', '.join(chosen.pythons)} is found.")


if __name__ == "__main__":
    main()
