"""Strains: segments of piecewise constant strain with linear stiffness, as SoRoMoX takes them.

A segment is a piece of a line whose strain is constant: curvatures about y and z and the stretch along x answer to
pressures, twist and shear stay as at rest. Stiffness is linear, K (ξ − ξ₀) = Rᵀ p, with K from the tangent of the full
model near rest and R the rates of swept volumes by strains, fitted to equilibria of the reduced model.
"""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from turgor.core.engine.runtime import EngineOptions
from turgor.fast_models.rod.frames import exponential, logarithm
from turgor.foundation.display import Shown
from turgor.foundation.store.atomic_files import whole
from turgor.reduced.states.reduced import Reduced
from turgor.systems.robots.backbone import Array, Backbone, backbone_of
from turgor.systems.robots.chains.chain_of import near_rest, pressed_inputs, sampled_inputs
from turgor.systems.robots.chains.chain_shape import bodies_of
from turgor.systems.robots.tip_response import TipResponse, tip_response

#: Places of the strains that answer, in the order of SoRoMoX: twist, curvatures about y and z, stretch, shears.
ACTIVE = 1, 2, 3

#: Smallest eigenvalue of a compliance whose diagonal is scaled to one, up to which bending and stretch are uncoupled.
UNCOUPLED = 0.05


@dataclass(frozen=True, kw_only=True, eq=False)
class StrainSegments(Shown):
    """Segments of constant strain.

    Parameters
    ----------
    lengths : (n,) array [m]
    rest : (n, 6) array
        Strains at rest: twist, curvatures about y and z [1/m], stretch, shears.
    active : (n, 6) bool array
    stiffness : (n, 6, 6) array
        Of a whole segment: its forces by its strains, zero where they do not answer.
    routing : (p, n, 6) array
        Rates of the swept volume of each pressure by the strains [m⁴, m³].
    density : (n,) array [kg/m³]
    radius : (n,) array [m]
        Of a round section with the same mass.
    names : tuple of str
        Of the pressures.
    high : (p,) array [Pa]
        Largest pressures.
    error : float [-]
        Largest distance of the tip from that of the reduced model, over the length, at 20 pressures.
    base : (3,) array [m]
        Where the line begins.
    """

    lengths: Array
    rest: Array
    active: Array
    stiffness: Array
    routing: Array
    density: Array
    radius: Array
    names: tuple[str, ...]
    high: Array
    error: float
    base: Array

    def __repr__(self) -> str:
        return f"StrainSegments({len(self.lengths)} segments, tip within {100 * self.error:.2g} % of the length)"

    def strains(self, pressures: Array) -> Array:
        """Strains (n, 6) at pressures (p,) [Pa]."""
        out = self.rest.copy()
        for k, active in enumerate(self.active):
            forces = pressures @ self.routing[:, k, active]
            out[k, active] += np.linalg.solve(self.stiffness[k][np.ix_(active, active)], forces)
        return out

    def tip(self, strains: Array) -> Array:
        """Place (3,) [m] of the end of the line."""
        return placed(self.base, self.lengths, strains)

    def document(self) -> dict[str, object]:
        """All numbers as plain values, in SI units."""
        keys = ("lengths", "rest", "active", "stiffness", "routing", "density", "radius", "base")
        named = {key: getattr(self, key).tolist() for key in keys}
        named["largest_pressures"] = self.high.tolist()
        return {"pressures": list(self.names), "tip_error_over_length": self.error, **named}

    def save(self, path: str | Path) -> Path:
        """Write them as JSON; ``docs/howto/robots.md`` has the lines that make a robot of SoRoMoX of it."""
        file = Path(path)
        with whole(file) as part:
            part.write_text(json.dumps(self.document(), indent=1), encoding="utf-8")
        return file


def strain_segments(reduced: Reduced, segments: int = 4, *, options: EngineOptions | None = None) -> StrainSegments:
    """Make segments of constant strain of a reduced model.

    Parameters
    ----------
    reduced : Reduced
        As for `chain_of`.
    segments : int
    options : EngineOptions, optional
        Of the full model, whose tangent gives the stiffness.

    Returns
    -------
    StrainSegments
    """
    pressed, backbone = pressed_inputs(reduced), backbone_of(reduced, segments)
    fit, test = sampled_inputs(reduced, pressed)
    still = backbone.frames(np.zeros(reduced.tip.shape[1]))
    lengths = np.linalg.norm(np.diff(still[1], axis=0), axis=1)
    sampled = np.array([_strains(backbone.frames(reduced.at(values).q), lengths) for values in fit])
    rest = _strains(still, lengths)
    bends = [axis for axis in (1, 2) if np.ptp(sampled[:, :, axis]) > 1e-3 * np.ptp(sampled[:, :, 1:3])]
    active = np.zeros((segments, 6), dtype=bool)
    active[:, [*bends, 3]] = True
    own = [*bends, 3]
    state = tip_response(reduced.at(near_rest(reduced, pressed)), backbone, tuple(bends), options or EngineOptions())
    stiffness, routing = np.zeros((segments, 6, 6)), np.zeros((len(pressed), segments, 6))
    for k, block in enumerate(_stiffness(state, lengths, own)):
        stiffness[k][np.ix_(own, own)] = block
        forces = (sampled[:, k] - rest[k])[:, own] @ block
        routing[:, k, own] = np.linalg.lstsq(fit[:, pressed], forces, rcond=None)[0]
    bodies, box = bodies_of(reduced.model, segments, at_base=True), reduced.inputs
    radius = bodies.capsules[:, 6]
    made = StrainSegments(
        lengths=lengths, rest=rest, active=active, stiffness=stiffness, routing=routing, radius=radius,
        density=bodies.masses / (np.pi * radius**2 * lengths), high=box.high[pressed], error=0.0,
        names=tuple(box.keys[k].removeprefix("loads.") for k in pressed), base=backbone.base,
    )  # fmt: skip
    return _with_error(made, reduced, backbone, (test, test[:, pressed]))


def _stiffness(state: TipResponse, lengths: Array, own: list[int]) -> list[Array]:
    """Stiffness of each segment: the forces that loads on the tip cause in it, by the strains that they cause.

    Ends of an actuator are no pieces of a rod. Where bending and stretch do not couple as in one, they do not here.
    """
    before, places = _strains(state.frames, lengths), state.frames[1]
    moved = zip(state.moved, state.share, strict=True)
    rates = np.array([(_strains(frames, lengths) - before) / share for frames, share in moved])
    blocks = []
    for k, length in enumerate(lengths):
        arm = places[-1] - (places[k] + places[k + 1]) / 2
        forces = [np.append(load.moment + np.cross(arm, load.force), load.force) for load in state.loads]
        compliance = np.linalg.solve(length * np.array(forces)[:, own], rates[:, k, own])
        compliance = 0.5 * (compliance + compliance.T)
        if np.linalg.eigvalsh(compliance / np.sqrt(np.outer(*[np.diag(compliance)] * 2)))[0] <= UNCOUPLED:
            compliance = np.diag(np.diag(compliance))
        blocks.append(np.linalg.inv(compliance))
    return blocks


def _with_error(
    made: StrainSegments, reduced: Reduced, backbone: Backbone, test: tuple[Array, Array]
) -> StrainSegments:
    """Measure the error of the tip at inputs that were not fitted."""
    away = [
        np.linalg.norm(made.tip(made.strains(p)) - backbone.frames(reduced.at(values).q)[1][-1])
        for values, p in zip(*test, strict=True)
    ]
    return replace(made, error=float(max(away)) / backbone.length)


def placed(base: Array, lengths: Array, strains: Array) -> Array:
    """End (3,) of a line of segments with strains (n, 6)."""
    turn, place = np.eye(3), base
    for length, strain in zip(lengths, strains, strict=True):
        rotation, shift = exponential(length * np.concatenate([strain[3:], strain[:3]])[None])
        turn, place = turn @ rotation[0], place + turn @ shift[0]
    return place


def _strains(frames: tuple[Array, Array], lengths: Array) -> Array:
    """Strains (n, 6) of the pieces between frames (n + 1)."""
    turns, places = frames
    back = np.swapaxes(turns[:-1], 1, 2)
    twists = logarithm(back @ turns[1:], np.einsum("mab,mb->ma", back, np.diff(places, axis=0)))
    return np.concatenate([twists[:, 3:], twists[:, :3]], axis=1) / lengths[:, None]
