"""Decks of CalculiX's own test collection as jobs: how many are read, run and agree, and why the others are not.

python benchmarks/job/decks.py FOLDER      the tables of decks.md; FOLDER has NAME.inp and NAME.dat.ref, packed or not
python benchmarks/job/decks.py FOLDER beamnh beamog      some decks only

Decks that differ are solved again with the cells of CalculiX, where it is installed (``ccx``): 20 nodes, full
integration, and no mean stress of their own, on both sides; and with small displacements where the deck has them.

The collection is in the Debian package calculix-ccx-test (GPL), or at www.dhondt.de as ccx_2.20.test.tar.bz2. A deck is
in scope if it is static and of solid or plane cells; displacements that it prints are compared with those of
turgor at the same nodes and the ends of the same steps.
"""

import gzip
import re
import shutil
import signal
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.job.raised import raised
from benchmarks.shared.tables import table
from turgor.foundation.errors import TurgorError
from turgor.job.decks.deck import read_deck
from turgor.job.decks.importing import import_deck
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of
from turgor.job.read import read_job

#: Largest number of unknowns that is solved here, so that all decks take minutes.
MOST_UNKNOWNS = 40_000

#: Largest difference of displacements, over the largest displacement, that counts as agreement: cells differ.
AGREE = 0.05

#: Processor time after which a deck is given up [s].
MOST_SECONDS = 60

#: Displacement over the size of the part where a deck has small ones: their square is below what counts.
SMALL = 1e-4

#: Units that are tried in this order: a part must be 1 mm to 2 m long.
UNITS = ("mm, N, MPa", "m, N, Pa")


def main(folder: Path, chosen: list[str]) -> None:
    """Print a row for each deck that is understood, and why the others are not."""
    rows, reasons = [], Counter[str]()
    signal.signal(signal.SIGPROF, _too_long)
    for packed in sorted(folder.glob("*.inp*")):
        name = packed.name.split(".inp")[0]
        if (chosen and name not in chosen) or (
            packed.name in (f"{name}.inp.gz",) and (folder / f"{name}.inp").exists()
        ):
            continue
        with TemporaryDirectory() as place:
            deck = Path(place) / f"{name}.inp"
            deck.write_bytes(_bytes(packed))
            reference = next(iter(folder.glob(f"{name}.dat.ref*")), None)
            signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
            try:
                row = row_of(deck, "" if reference is None else _bytes(reference).decode(errors="replace"))
            except TurgorError as error:
                for reason in reasons_of(str(error)):
                    reasons[reason] += 1
                if chosen:
                    sys.stdout.write(f"{error}\n")
                continue
            except TimeoutError:
                row = [name, "", "", "", "", f"{MOST_SECONDS}", "too long here"]
            finally:
                signal.setitimer(signal.ITIMER_PROF, 0)
        rows.append(row)
        sys.stderr.write(f"{row}\n")
    sys.stdout.write(table(["deck", "unknowns", "states", "difference", "same cells", "CPU s", "verdict"], rows))
    sys.stdout.write("\n\n" + table(["what a job lacks", "decks"], [[why, str(n)] for why, n in reasons.most_common()]))


def _too_long(number: int, frame: object) -> None:
    raise TimeoutError


def row_of(deck: Path, reference: str) -> list[str]:
    """Import a deck, solve it, and compare it with what CalculiX printed."""
    imported, units = _imported(deck)
    job = read_job(imported.write(deck.parent))
    model = model_of(job, mesh_of(job, job.geometry()))
    count = model.mesh.unknown_count
    if count > MOST_UNKNOWNS:
        return [deck.stem, f"{count:,}", "", "", "", "", "too large here"]
    begin = process_time()
    solution = tg.solve(model, job.procedure, throw=False)
    seconds = process_time() - begin
    if solution.status.name.lower() != "converged":
        return [deck.stem, f"{count:,}", "", "", "", f"{seconds:.1f}", f"{solution.status.name.lower()}"]
    states, difference = compared(solution, deck, reference, units)
    if not states:  # it prints no displacements
        states, difference = compared(solution, deck, by_calculix(printing(deck)), units)
    if not states:
        return [deck.stem, f"{count:,}", "0", "", "", f"{seconds:.1f}", "prints no displacements"]
    same = "" if difference < AGREE else with_same_cells(solution, job, deck, units)
    verdict = "agrees" if difference < AGREE else "agrees with its cells" if _small(same) else "differs"
    return [deck.stem, f"{count:,}", str(states), f"{100 * difference:.3g} %", same, f"{seconds:.1f}", verdict]


def _small(same: str) -> bool:
    return bool(same) and float(same.rstrip(" %")) < 100 * AGREE


def with_same_cells(solution: tg.Solution, job: tg.jobs.Job, deck: Path, units: float) -> str:
    """Difference between both programs with the same cells; empty where one of them cannot solve it so."""
    model, text = solution.model, printing(deck)
    if model.mesh.cells.shape[1] != 27 or "C3D" not in text.upper() or model.mesh.revolved:
        return ""
    text = raised(text) if "C3D8" in text.upper() else re.sub("C3D20R", "C3D20", text, flags=re.IGNORECASE)
    theirs = by_calculix(text)
    mesh, extent = replace(model.mesh, serendipity=True), np.ptp(model.mesh.points, axis=0).max()
    plain = tg.Model(
        mesh, model.materials, model.supports, model.loads, "displacement", model.reinforcements, model.contact
    )
    procedure, moved = job.procedure, float(np.abs(solution.states[-1].displacement).max())
    is_linear = "NLGEOM" not in text.upper() and isinstance(procedure, tg.Static)
    factor = 1.0 if not is_linear else min(1.0, SMALL * extent / moved)
    if factor < 1:
        procedure = tg.Static(at=(factor,), first_step=factor)
    again = tg.solve(plain, procedure, throw=False)
    if factor < 1:
        state = min(again.states, key=lambda each: abs(each.load_factor - factor))
        end = SimpleNamespace(load_factor=1.0, displacement=state.displacement / factor)
        again = SimpleNamespace(model=plain, states=[end])
    states, difference = compared(again, deck, theirs, units)
    return f"{100 * difference:.2g} %" if states else ""


def printing(deck: Path) -> str:
    """A deck that prints the displacements of all nodes of cells at the end of each step."""
    own = [f"{node}," for node in read_deck(deck).solid_nodes.tolist()]
    printed_set = "\n".join(["*NSET, NSET=OFCELLS", *own])
    lines: list[str] = []
    for line in deck.read_text(errors="replace").splitlines():
        word = line.split(",")[0].replace(" ", "").upper()
        if word == "*STEP" and "OFCELLS" not in "".join(lines):
            lines.append(printed_set)
        if word == "*ENDSTEP":
            lines.append("*NODE PRINT, NSET=OFCELLS, FREQUENCY=1000000\nU")
        lines.append(line)
    return "\n".join(lines) + "\n"


def by_calculix(text: str) -> str:
    """What CalculiX prints for a deck; empty where it is not installed or fails."""
    if shutil.which("ccx") is None:
        return ""
    with TemporaryDirectory() as place:
        (Path(place) / "deck.inp").write_text(text)
        subprocess.run(["ccx", "deck"], cwd=place, capture_output=True, check=False, timeout=600)
        printed_by = Path(place) / "deck.dat"
        return printed_by.read_text() if printed_by.exists() else ""


def _imported(deck: Path) -> tuple[tg.files.DeckImport, float]:
    points = np.array(list(read_deck(deck).place.values()))
    extent = np.ptp(points, axis=0).max()
    units = UNITS[0] if 1 <= extent <= 2000 else UNITS[1]
    return import_deck(deck, units=units), {"mm": 1e-3, "m": 1.0}[units.split(",")[0]]


def compared(solution: tg.Solution, deck: Path, reference: str, length: float) -> tuple[int, float]:
    """Number of printed states, and the largest difference of displacements over the largest displacement."""
    from scipy.spatial import cKDTree

    read = read_deck(deck)
    place = {node: read.place[node] for node in read.solid_nodes.tolist()}  # what others print may be turns
    mesh = solution.model.mesh
    tree, near = cKDTree(mesh.points), 1e-3 if mesh.revolved else 1e-6  # rings lie a little outside their circles
    blocks = printed(reference)
    total = max((time for time, _ in blocks), default=0.0)
    states, worst = 0, 0.0
    for time, values in blocks:
        state = min(solution.states, key=lambda each: abs(each.load_factor - time / total))
        nodes = [node for node in values if node in place]
        away, pairs = tree.query(length * np.array([place[node] for node in nodes]), k=2)
        rows, same = pairs[:, 0], near * np.ptp(mesh.points, axis=0).max()
        known = (away[:, 0] < same) & (away[:, 1] > same)  # no number tells two nodes at one place apart
        theirs = length * np.array([values[node] for node in nodes])[known]
        if abs(state.load_factor - time / total) > 1e-9 or not known.any():
            continue
        ours = state.displacement[rows[known]]
        largest = float(np.linalg.norm(theirs, axis=1).max())
        if largest > 0:
            states += 1
            worst = max(worst, float(np.linalg.norm(ours - theirs, axis=1).max()) / largest)
    return states, worst


def printed(text: str) -> list[tuple[float, dict[int, list[float]]]]:
    """Times and displacements by node that a .dat file holds."""
    blocks: list[tuple[float, dict[int, list[float]]]] = []
    reading = False
    for line in text.splitlines():
        head = re.match(r"\s*displacements \(vx,vy,vz\).* time\s+(\S+)", line)
        if head:
            blocks.append((float(head[1]), {}))
            reading = True
        elif reading and (words := line.split()):
            if not words[0].isdigit():
                reading = False
            elif len(words) == 4:
                blocks[-1][1][int(words[0])] = [float(word) for word in words[1:]]
    return [block for block in blocks if block[1]]


def reasons_of(message: str) -> set[str]:
    """Keywords that a refused deck names, or its one sentence."""
    named = set(re.findall(r"\*([A-Z][A-Z -]*[A-Z])[^:]* is missing", message))
    if named:
        return {f"*{each}" for each in named}
    return {re.sub(r"'[^']*'|\d[\d.e-]*", "…", message)[:90]}


def _bytes(file: Path) -> bytes:
    return gzip.decompress(file.read_bytes()) if file.suffix == ".gz" else file.read_bytes()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
