"""Files of FEBio's own test suite as jobs: how many are read, run and agree, and why the others are not.

python benchmarks/job/febio.py FOLDER STANDARDS     the tables of febio.md: the folder `Verify` and the file
                                                    `code/linuxGoldStandards.py` of github.com/febiosoftware/TestSuite
python benchmarks/job/febio.py FOLDER STANDARDS ma01 mi09        some files only

The suite states one number of a solution: the norm of the displacements of all degrees of freedom that are free, at the
end of the last step. It is compared with that of turgor at the same nodes.
"""

import ast
import re
import signal
import sys
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.shared.tables import table
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.deck import read_deck
from turgor.job.decks.febio.elements import read_elements
from turgor.job.decks.febio.meshes import read_mesh
from turgor.job.decks.importing import import_deck
from turgor.job.decks.steps import path_of
from turgor.job.decks.tracks import SHIFT
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of
from turgor.job.read import read_job

#: Largest number of unknowns that is solved here, and largest file, so that all files take minutes.
MOST_UNKNOWNS, MOST_BYTES = 40_000, 3_000_000

#: Largest difference of the norm that counts as agreement: cells differ.
AGREE = 0.05

#: Processor time after which a file is given up [s].
MOST_SECONDS = 60

#: Units that are taken, whatever the file states, and their length [m]; the second where a part is below 1 mm.
UNITS = (("mm, N, MPa", 1e-3), ("m, N, Pa", 1.0))


def main(folder: Path, standards: Path, chosen: list[str]) -> None:
    """Print a row for each file that is understood, and why the others are not."""
    expected = ast.literal_eval(standards.read_text().partition("=")[2].strip())
    rows, reasons, modules, count = [], Counter[str](), Counter[str](), 0
    signal.signal(signal.SIGPROF, _too_long)
    for file in sorted(folder.glob("*.feb")):
        if chosen and file.stem not in chosen:
            continue
        count += 1
        signal.setitimer(signal.ITIMER_PROF, MOST_SECONDS)
        try:
            if file.stat().st_size > MOST_BYTES:
                raise TurgorError("more than 3 MB")
            row = row_of(file, expected.get(file.stem))
        except TurgorError as error:
            known = reasons if _is_solid(file) else modules
            known.update(reasons_of(str(error)))
            if chosen:
                sys.stdout.write(f"{error}\n")
            continue
        except TimeoutError:
            row = [file.stem, "", "", "", "", f"{MOST_SECONDS}", "too long here"]
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        rows.append(row)
        sys.stderr.write(f"{row}\n")
    sys.stdout.write(f"{count} files, {sum(modules.values())} of them of other physics\n\n")
    sys.stdout.write(table(["file", "unknowns", "norm", "of FEBio", "difference", "CPU s", "verdict"], rows))
    sys.stdout.write("\n\n" + table(["what a job lacks", "files"], [[why, str(n)] for why, n in reasons.most_common()]))


def _too_long(number: int, frame: object) -> None:
    raise TimeoutError


def _is_solid(file: Path) -> bool:
    root = read_elements(file)
    module = root.first("Module")
    return root.tag == "febio_spec" and (module is None or module.given.get("type") == "solid")


def row_of(file: Path, expected: list[object] | None) -> list[str]:
    """Import a file, solve it, and compare it with what FEBio's developers state."""
    points = np.array(list(read_deck(file).place.values()))
    units, length = UNITS[int(np.ptp(points, axis=0).max() < 1)]
    with TemporaryDirectory() as place:
        job = read_job(import_deck(file, units=units).write(place))
        model = model_of(job, mesh_of(job, job.geometry()))
    count = model.mesh.unknown_count
    if count > MOST_UNKNOWNS:
        return [file.stem, f"{count:,}", "", "", "", "", "too large here"]
    begin = process_time()
    solution = tg.solve(model, job.procedure, throw=False)
    seconds = f"{process_time() - begin:.1f}"
    if solution.status.name.lower() != "converged":
        return [file.stem, f"{count:,}", "", "", "", seconds, f"stops: {solution.status.name.lower()}"]
    ours, theirs = free_norm(solution, file, length), float(str(expected[6])) if expected else 0.0
    if not theirs:
        return [file.stem, f"{count:,}", f"{ours:.4g}", "", "", seconds, "no number to compare"]
    difference = ours / theirs - 1
    verdict = "agrees" if abs(difference) < AGREE else "differs"
    return [file.stem, f"{count:,}", f"{ours:.5g}", f"{theirs:.5g}", f"{100 * difference:+.2g} %", seconds, verdict]


def free_norm(solution: tg.Solution, file: Path, length: float) -> float:
    """Norm of the displacements that nothing prescribes, at the nodes of the file, in its unit of length [m]."""
    deck = read_deck(file)
    path = path_of(deck, {}, Account())
    moved = {target[1:] for target in path.tracks.of if isinstance(target, tuple) and target[0] == SHIFT}
    mesh = solution.model.mesh
    mesh_of_file, _ = read_mesh(read_elements(file))
    shells = {
        node for part, solid in mesh_of_file.solids.items() if not solid
        for nodes in mesh_of_file.parts[part].values() for node in nodes
    }  # fmt: skip
    last = max(mesh_of_file.points) + len(shells)  # later ones lie between the faces of shells
    nodes = [node for node in deck.solid_nodes.tolist() if node <= last]
    _, rows = cKDTree(mesh.points).query(length * np.array([deck.place[node] for node in nodes]))
    values = solution.states[-1].displacement[rows] / length
    free = [[(node, k) not in path.fixed and (node, k) not in moved for k in (1, 2, 3)] for node in nodes]
    return float(np.linalg.norm(values[np.array(free)]))


def reasons_of(message: str) -> set[str]:
    """Elements that a refused file names, without their names, or its one sentence."""
    named = set()
    for tag, given in re.findall(r":\d+ <(\w+)([^>]*)> is missing", message):
        kind = re.search(r'type="([^"]*)"', given)
        named.add(f"<{tag}{f' {kind[0]}' if kind else ''}>")
    return (
        {each for each in named if not each.startswith(("<Elements", "<SolidDomain"))}
        or named
        or {re.sub(r"'[^']*'|line \d+", "…", message)[:90]}
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:])
