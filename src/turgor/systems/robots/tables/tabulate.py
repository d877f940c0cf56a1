"""Tables: what an actuator does over the range of its inputs, and polynomials of it with their errors."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.stats import qmc

from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.systems.control.outputs import Angle
from turgor.systems.robots.backbone import Array, Backbone, backbone_of
from turgor.systems.robots.tables.arc import arc_of
from turgor.systems.robots.tables.polynomial import Polynomial, fitted
from turgor.systems.robots.tables.tip_forces import tip_forces_of

#: Slices for the arc.
SLICES = 10

#: Columns that have no polynomial: they follow from others, or are errors.
DERIVED = ("curvature", "bending_direction", "arc_misfit", "estimated_error")


@dataclass(frozen=True, eq=False)
class RobotTable(Shown):
    """What an actuator does at many inputs.

    Parameters
    ----------
    reduced : Reduced
    response : Response
        A row for each input: the inputs, then curvatures and length of the arc that is closest to its shape, the place
        of the tip, its rotation vector, volumes, and stiffness and blocked force where forces on the tip are inputs.
    polynomials : mapping of str to Polynomial
        By the names of columns.
    tested : int
        The last rows, to which no polynomial was fitted.
    """

    reduced: Reduced
    response: Response
    polynomials: Mapping[str, Polynomial]
    tested: int

    def __repr__(self) -> str:
        return f"RobotTable({len(self.response)} rows, {len(self.polynomials)} polynomials)"

    @property
    def errors(self) -> dict[str, float]:
        """Errors that are known besides those of the polynomials: of the mesh, of the reduced model, and of its arc."""
        held_out, response, measures = self.reduced.held_out, self.response, self.reduced.measures
        known = {
            "largest_estimated_error_of_displacement_over_largest": float(response["estimated_error"].max()),
            "largest_distance_from_arc_m": float(response["arc_misfit"].max()),
        }
        if len(held_out.inputs):
            known |= {
                "held_out_displacement_over_largest": held_out.worst,
                "held_out_tip_over_travel": float(held_out.tip.max()),
                "held_out_volume_relative": float(held_out.volume.max()),
            }
        columns = zip(measures.names, measures.mesh.T, strict=True) if measures.names else ()
        return known | {f"mesh_{name}": float(np.nanmax(e)) for name, e in columns if np.isfinite(e).any()}  # [SI]

    def save(self, folder: str | Path, name: str) -> tuple[Path, Path]:
        """Write the table as CSV and the polynomials with all errors as JSON.

        Parameters
        ----------
        folder : str or Path
        name : str
            Of both files, without ending.

        Returns
        -------
        tuple of Path
        """
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        table, document = place / f"{name}-table.csv", place / f"{name}-polynomials.json"
        self.response.to_csv(table)
        with whole(document) as part:
            part.write_text(json.dumps(self.document(name), indent=1), encoding="utf-8")
        return table, document

    def document(self, name: str) -> dict[str, object]:
        """Polynomials and errors as plain values."""
        box = self.reduced.inputs
        terms = {
            key: {
                "unit": self.response.find(key).si_unit,
                "largest_error": each.error,
                "exponents": each.exponents.tolist(),
                "coefficients": each.coefficients.tolist(),
            }
            for key, each in self.polynomials.items()
        }
        return {
            "name": name,
            "units": "SI; angles in rad",
            "formula": "sum of coefficient * product of t_i**exponent_i, t_i = 2 (s_i - low_i) / (high_i - low_i) - 1",
            "inputs": [
                {"key": key, "low": low, "high": high}
                for key, low, high in zip(box.keys, box.low.tolist(), box.high.tolist(), strict=True)
            ],
            "rows_fitted": len(self.response) - self.tested,
            "rows_tested": self.tested,
            "polynomials": terms,
            "errors": self.errors,
        }


def tabulate(reduced: Reduced, samples: int = 64) -> RobotTable:
    """Answer at many inputs, and fit polynomials to two thirds of the rows; the others state their errors.

    Parameters
    ----------
    reduced : Reduced
        Of an actuator along x that is fixed where x is smallest.
    samples : int
        Rows, 12 or more.

    Returns
    -------
    RobotTable

    Raises
    ------
    TurgorError
        If there are fewer rows, or the mesh is no actuator along x.
    NotSolved
        If the reduced model refuses an input.
    """
    if samples < 12:
        raise TurgorError(f"a table of {samples} rows is too short; 12 are needed at least.")
    box = reduced.inputs
    shares, tested = _points(len(box.keys), samples)
    inputs = box.at_shares(shares)
    backbone, forces = backbone_of(reduced, SLICES), tip_forces_of(reduced)
    angle = Angle().of(reduced) if "tip" in reduced.model.mesh.faces else None
    rows = []
    for values in inputs:
        answer = reduced.at(values)
        bent = {} if angle is None else {("bending_angle", "deg"): float(angle.at(answer)[0][0])}
        rows.append(_row(answer, backbone) | bent | forces.row(answer) | {("estimated_error", ""): answer.estimate})
    columns = [Column(key.replace(".", "_"), box.units[k], inputs[:, k]) for k, key in enumerate(box.keys)]
    columns += [Column(name, unit, np.array([row[name, unit] for row in rows])) for name, unit in rows[0]]
    response = Response(columns=tuple(columns), source=Source(text=f"the reduced model of {reduced.model.mesh.name}"))
    cut, polynomials = samples - tested, {}
    for column in columns[len(box.keys) :]:
        known = np.isfinite(column.values)
        if column.name in DERIVED or known[:cut].sum() < 6 or not known[cut:].any():
            continue
        fit, test = np.flatnonzero(known[:cut]), cut + np.flatnonzero(known[cut:])
        values = (inputs[fit], column.values[fit]), (inputs[test], column.values[test])
        polynomials[column.name] = fitted(*values, (box.low, box.high))
    return RobotTable(reduced, response, polynomials, tested)


def _points(count: int, samples: int) -> tuple[Array, int]:
    """Shares (samples, count) of the ranges, and how many of the last ones are for tests: inside of the others."""
    tested = samples // 3
    if count == 1:
        every = np.linspace(0.0, 1.0, samples)
        test = np.arange(1, samples - 1, 3)[:tested]
        return np.concatenate([np.delete(every, test), every[test]])[:, None], len(test)
    shares = qmc.Sobol(count, seed=0).random(1 << (samples - 1).bit_length())[:samples]
    corners = np.array(np.meshgrid(*[[0.0, 1.0]] * count)).reshape(count, -1).T
    few = min(len(corners), (samples - tested) // 2)
    shares[:few] = corners[:few]
    return shares, tested


def _row(answer: ReducedState, backbone: Backbone) -> dict[tuple[str, str], float]:
    """Numbers of an answer by name and unit."""
    turns, places = backbone.frames(answer.q)
    rest = np.concatenate([backbone.base[None], np.array([each.center for each in backbone.slices])])
    arc = arc_of(places, turns, rest)
    row = {
        ("curvature", "1/m"): arc.curvature,
        ("bending_direction", "deg"): arc.direction,
        ("curvature_y", "1/m"): arc.curvature * np.cos(arc.direction),
        ("curvature_z", "1/m"): arc.curvature * np.sin(arc.direction),
        ("arc_length", "mm"): arc.length,
        ("arc_misfit", "mm"): arc.misfit,
    }
    row |= {(f"tip_{axis}", "mm"): float(x) for axis, x in zip("xyz", places[-1], strict=True)}
    row |= {(f"tip_turn_{axis}", "deg"): float(x) for axis, x in zip("xyz", whole_turn(turns), strict=True)}
    return row | {(f"volume_{face}", "mL"): volume for face, volume in answer.volumes.items()}


def whole_turn(turns: Array) -> Array:
    """Rotation vector (3,) [rad] of the last of some frames (m, 3, 3), which may be more than half a turn."""
    steps = Rotation.from_matrix(np.swapaxes(turns[:-1], 1, 2) @ turns[1:]).as_rotvec()
    rough = np.einsum("mab,mb->a", turns[:-1], steps)
    vector = Rotation.from_matrix(turns[-1]).as_rotvec()
    size = float(np.linalg.norm(vector))
    axis = vector / size if size > 1e-9 else rough / max(float(np.linalg.norm(rough)), 1e-300)
    return np.asarray(vector + axis * 2 * np.pi * np.round((rough @ axis - size) / (2 * np.pi)))
