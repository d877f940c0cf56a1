"""Formats: files of a reduced model for other programs, each with what is known of its error."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from turgor.core.engine.runtime import EngineOptions
from turgor.foundation.errors import TurgorError, unknown
from turgor.reduced.states.reduced import Reduced
from turgor.systems.robots.chains.chain_of import FittedChain, chain_of
from turgor.systems.robots.chains.mjcf import write_mjcf
from turgor.systems.robots.chains.urdf import write_urdf
from turgor.systems.robots.strains import strain_segments
from turgor.systems.robots.tables.tabulate import tabulate


@dataclass(frozen=True, eq=False)
class Question:
    """What is exported.

    Parameters
    ----------
    reduced : Reduced
    links : int or None
        Of chains and segments; None leaves the choice.
    options : EngineOptions
    """

    reduced: Reduced
    links: int | None
    options: EngineOptions

    @cached_property
    def chain(self) -> FittedChain:
        """The chain, which two formats share."""
        return chain_of(self.reduced, self.links, options=self.options)


@dataclass(frozen=True, slots=True)
class Format:
    """A format.

    Parameters
    ----------
    endings : tuple of str
        Of its files, after the name.
    write : callable
        ``write(question, folder, name)`` writes them and returns what is known of the error, as a sentence.
    """

    endings: tuple[str, ...]
    write: Callable[[Question, Path, str], str]


def _table(question: Question, folder: Path, name: str) -> str:
    table = tabulate(question.reduced)
    table.save(folder, name)
    chosen = [key for key in table.polynomials if key.startswith(("arc_length", "volume"))]
    worst = max(table.polynomials[key].error / float(table.response[key].max()) for key in chosen)
    return f"polynomials of length and volume within {100 * worst:.2g} % at rows that they were not fitted to"


def _mujoco(question: Question, folder: Path, name: str) -> str:
    write_mjcf(question.chain, folder / f"{name}.xml")
    return question.chain.text


def _urdf(question: Question, folder: Path, name: str) -> str:
    write_urdf(question.chain, folder / f"{name}.urdf")
    return f"{question.chain.text}; URDF has no springs, they stand in comments"


def _soromox(question: Question, folder: Path, name: str) -> str:
    made = strain_segments(question.reduced, question.links or 4, options=question.options)
    made.save(folder / f"{name}-segments.json")
    return f"tip within {100 * made.error:.2g} % of the length at 20 pressures; stiffness and gains are linear"


def _fmu(question: Question, folder: Path, name: str) -> str:
    from turgor.systems.exports.fmu import write_fmu

    write_fmu(question.reduced, folder / f"{name}.fmu")
    return "the unit answers as the reduced model does, with its estimate"


def _sofa(question: Question, folder: Path, name: str) -> str:
    from turgor.systems.exports.sofa import write_sofa

    scene = write_sofa(question.reduced.model, folder / f"{name}-sofa")
    laws = ", ".join(
        f"{region} within {100 * law.error:.2g} % of the stress" for region, law in scene.materials.items()
    )
    return f"linear tetrahedra of the full model, fitted laws ({laws}); not run in SOFA"


#: Formats by their names.
FORMATS: Mapping[str, Format] = {
    "table": Format(("-table.csv", "-polynomials.json"), _table),
    "mujoco": Format((".xml",), _mujoco),
    "urdf": Format((".urdf",), _urdf),
    "soromox": Format(("-segments.json",), _soromox),
    "fmu": Format((".fmu",), _fmu),
    "sofa": Format(("-sofa",), _sofa),
}


def export_reduced(
    reduced: Reduced,
    folder: str | Path,
    formats: Collection[str],
    *,
    name: str = "robot",
    links: int | None = None,
    force: bool = False,
) -> dict[Path, str]:
    """Write a reduced model as files for other programs.

    Parameters
    ----------
    reduced : Reduced
    folder : str or Path
        Created if it does not exist.
    formats : collection of str
        ``"table"``: numbers over the range of the inputs, and polynomials. ``"mujoco"``: a chain of rigid links with
        springs, and pressures as controls. ``"urdf"``: the same chain for ROS. ``"soromox"``: segments of constant
        strain. ``"fmu"``: a unit for co-simulation (`write_fmu`). ``"sofa"``: a folder with a scene of the full model
        (`write_sofa`).
    name : str
        Of the files, without ending.
    links : int, optional
        Links of chains, or segments.
    force : bool
        Whether existing files are replaced.

    Returns
    -------
    dict of Path to str
        Files that were written, each with what is known of its error.

    Raises
    ------
    TurgorError
        If a format is unknown, or a file exists already.
    """
    for each in formats:
        if each not in FORMATS:
            raise unknown("format", each, FORMATS)
    place = Path(folder)
    taken = [place / f"{name}{ending}" for each in formats for ending in FORMATS[each].endings]
    taken = [file for file in taken if file.exists()]
    if taken and not force:
        raise TurgorError(
            f"'{taken[0]}' is there already.",
            python="Choose another folder, or replace it with force=True.",
            command="Choose another folder with --output, or replace it with --force.",
        )
    place.mkdir(parents=True, exist_ok=True)
    question, written = Question(reduced, links, EngineOptions()), dict[Path, str]()
    for each in dict.fromkeys(formats):
        text = FORMATS[each].write(question, place, name)
        written |= {place / f"{name}{ending}": text for ending in FORMATS[each].endings}
    return written
