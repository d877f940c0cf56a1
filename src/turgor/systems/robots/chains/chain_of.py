"""Chain of a reduced model, with its error at pressures to which it was not fitted."""

from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import qmc

from turgor.core.engine.runtime import EngineOptions
from turgor.core.model.loads.gravity import Gravity
from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.reduced.states.reduced import Reduced
from turgor.systems.robots.backbone import Array, Backbone, backbone_of
from turgor.systems.robots.chains.chain import SLIDE, Chain
from turgor.systems.robots.chains.chain_fit import Answers, Samples, fitted_chain
from turgor.systems.robots.chains.chain_shape import Shape, bodies_of, shape_of
from turgor.systems.robots.tip_response import TipResponse, tip_response

#: States that a chain of one pressure, or of several, is fitted to, and those at which its error is measured.
FITTED, OF_SEVERAL, TESTED = 25, 60, 20

#: Joints slide only where that brings the error below this share of the one without.
WORTH = 0.5

#: Numbers of links that are tried, and the distance of the tip over the length with which fewest are enough.
MOST_LINKS, ENOUGH = (4, 16), 0.003

#: The first state whose tangent is used: at rest there is nothing but round-off to compare a residual with.
NEAR_REST = 0.02

#: Range of a coordinate beyond that of the samples, over its largest size.
BEYOND = 0.5


@dataclass(frozen=True, eq=False)
class FittedChain(Shown):
    """A chain, and how far it is from the reduced model.

    Parameters
    ----------
    reduced : Reduced
    chain : Chain
    tested : (20, p) array [Pa]
        Pressures to which it was not fitted.
    tips, wanted : (20, 3) arrays [m]
        The tip of the chain and that of the reduced model there.
    length : float [m]
    stiffness_error : float [-]
        Largest error of the motion of the tip under a small moment at the states whose tangent was used.
    """

    reduced: Reduced
    chain: Chain
    tested: Array
    tips: Array
    wanted: Array
    length: float
    stiffness_error: float

    def __repr__(self) -> str:
        return f"FittedChain({self.chain!r}; {self.text})"

    @property
    def error(self) -> float:
        """Largest distance of the tip from that of the reduced model, over the length."""
        return float(np.linalg.norm(self.tips - self.wanted, axis=1).max()) / self.length

    @property
    def travel(self) -> float:
        """Largest way of the tip from rest, over the length."""
        rest = self.chain.tip(self.chain.placed(np.zeros(len(self.chain.springs))))
        return float(np.linalg.norm(self.wanted - rest, axis=1).max()) / self.length

    @property
    def text(self) -> str:
        """What is known of its errors, in one sentence."""
        held_out = self.reduced.held_out
        known = ""
        if len(held_out.inputs):
            known = f"; the reduced model is within {100 * held_out.worst:.2g} % of its largest displacement"
        return (
            f"tip within {100 * self.error:.2g} % of the length, {100 * self.error / self.travel:.2g} % of its largest "
            f"way, at {len(self.tested)} pressures to which the chain was not fitted, "
            f"stiffness of the tip within {100 * self.stiffness_error:.2g} %{known}"
        )


def chain_of(
    reduced: Reduced, links: int | None = None, *, slide: bool | None = None, options: EngineOptions | None = None
) -> FittedChain:
    """Make a chain of rigid links of a reduced model.

    Parameters
    ----------
    reduced : Reduced
        Of an actuator along x that is fixed where x is smallest. Its inputs that are no pressures stay at zero, or at
        the end of their range that is closest to it.
    links : int, optional
        By default the smallest number, from 4 to 16, of rigid links that reach the tip where they turn as the actuator
        does.
    slide : bool, optional
        Whether joints slide along the axis, too; by default where that halves the error.
    options : EngineOptions, optional
        Of the full model, whose tangent at a few states gives the stiffness of the joints.

    Returns
    -------
    FittedChain

    Raises
    ------
    TurgorError
        If no input is a pressure, or dead loads other than gravity act.
    NotSolved
        If the chain has no stable equilibrium at a pressure of the range.
    """
    pressed, options = pressed_inputs(reduced), options or EngineOptions()
    fit, test = sampled_inputs(reduced, pressed)
    q = [reduced.at(values).q for values in fit]
    backbone = _best_backbone(reduced, q) if links is None else backbone_of(reduced, links)
    states = [reduced.at(values) for values in _few(reduced, pressed)]
    bends = shape_of(backbone, [backbone.frames(each) for each in q], False).kinds
    answered = [tip_response(state, backbone, bends, options) for state in states]
    question = _Question(reduced, pressed, backbone, (fit, test), tuple(q), tuple(answered))
    if slide is not None:
        return _fitted(question, slide)
    rigid = _fitted(question, False)
    with suppress(NotSolved):
        sliding = _fitted(question, True)
        return sliding if sliding.error < WORTH * rigid.error else rigid
    return rigid


@dataclass(frozen=True, slots=True, eq=False)
class _Question:
    """What a chain is to follow: slices, inputs to fit and to test, coordinates at the former, answers of the tip."""

    reduced: Reduced
    pressed: list[int]
    backbone: Backbone
    inputs: tuple[Array, Array]
    q: tuple[Array, ...]
    answered: tuple[TipResponse, ...]


def _fitted(question: _Question, slide: bool) -> FittedChain:
    """Fit a chain and measure its error."""
    reduced, backbone, pressed, (fit, test) = question.reduced, question.backbone, question.pressed, question.inputs
    frames = [backbone.frames(q) for q in question.q]
    shape = shape_of(backbone, frames, slide)
    x = np.array([shape.coordinates(each) for each in frames])
    limits = np.column_stack([x.min(axis=0), x.max(axis=0)])
    limits += np.abs(limits).max(axis=1, keepdims=True) * BEYOND * np.array([-1, 1])
    chain = replace(_bare(reduced, backbone, shape, pressed), limits=limits)
    known = tuple(_answers(chain, shape, each, pressed) for each in question.answered)
    gains = _rates(backbone, shape, question.answered[0])[:, pressed] / known[0].compliance[:, None]
    chain = fitted_chain(chain, Samples(x, fit[:, pressed], known), gains.T)
    tips = np.array([chain.tip(chain.placed(_solved(chain, values[pressed]))) for values in test])
    wanted = np.array([backbone.frames(reduced.at(values).q)[1][-1] for values in test])
    return FittedChain(reduced, chain, test[:, pressed], tips, wanted, backbone.length, _stiffness_error(chain, known))


def pressed_inputs(reduced: Reduced) -> list[int]:
    """Places of the inputs that are pressures."""
    pressed = [int(k) for k in np.flatnonzero(reduced.equations.pressures[:, 1:].any(axis=0))]
    if not pressed:
        raise TurgorError(f"no input of the reduced model is a pressure: {', '.join(reduced.inputs.keys)}.")
    weights = [load for load in reduced.model.loads if isinstance(load, Gravity)]
    if reduced.equations.pressures[:, 0].any() or (reduced.equations.forces[:, 0].any() and not weights):
        raise TurgorError("a chain has pressures as inputs and gravity; other loads of this reduced model act always.")
    return pressed


def sampled_inputs(reduced: Reduced, pressed: list[int]) -> tuple[Array, Array]:
    """Inputs to fit (s, n) and to test (20, n)."""
    box = reduced.inputs
    calm = np.clip(0.0, box.low, box.high)
    if len(pressed) == 1:
        shares = [np.linspace(0, 1, FITTED)[:, None], (np.arange(TESTED)[:, None] + 0.5) / TESTED]
    else:
        some = qmc.Sobol(len(pressed), seed=0).random(128)
        corners = np.array(np.meshgrid(*[[0.0, 1.0]] * len(pressed))).reshape(len(pressed), -1).T
        shares = [np.concatenate([corners[:32], some[: OF_SEVERAL - min(len(corners), 32)]]), some[-TESTED:]]
    out = []
    for share in shares:
        rows = np.tile(calm, (len(share), 1))
        rows[:, pressed] = box.low[pressed] + share * (box.high - box.low)[pressed]
        out.append(rows)
    return out[0], out[1]


def near_rest(reduced: Reduced, pressed: list[int]) -> Array:
    """Inputs (n,) near rest."""
    calm = np.clip(0.0, reduced.inputs.low, reduced.inputs.high)
    calm[pressed] += NEAR_REST * (reduced.inputs.high - calm)[pressed]
    return calm


def _few(reduced: Reduced, pressed: list[int]) -> list[Array]:
    """Inputs (k, n) of the states whose tangent is used: near rest first."""
    box, calm = reduced.inputs, np.clip(0.0, reduced.inputs.low, reduced.inputs.high)
    rows = [near_rest(reduced, pressed)]
    for k in pressed:
        for share in (0.5, 1.0) if len(pressed) == 1 else (1.0,):
            row = calm.copy()
            row[k] = share * box.high[k]
            rows.append(row)
    return rows


def _bare(reduced: Reduced, backbone: Backbone, shape: Shape, pressed: list[int]) -> Chain:
    """The chain without springs and gains."""
    pivots, box = shape.pivots(backbone.base), reduced.inputs
    bodies = bodies_of(reduced.model, len(pivots), np.cumsum(pivots, axis=0))
    weights = [np.array(load.falling) for load in reduced.model.loads if isinstance(load, Gravity)]
    d, p = len(pivots) * len(shape.kinds), len(pressed)
    return Chain(
        base=backbone.base, pivots=pivots, end=shape.behind[-1], kinds=shape.kinds, springs=np.zeros((d, 3)),
        gains=np.zeros((p, d)),
        growth=np.zeros(p), masses=bodies.masses, centers=bodies.centers, inertias=bodies.inertias,
        gravity=np.sum(weights, axis=0) if weights else np.zeros(3), limits=np.zeros((d, 2)),
        capsules=bodies.capsules, names=tuple(box.keys[k].removeprefix("loads.") for k in pressed),
        high=box.high[pressed], low=box.low[pressed],
    )  # fmt: skip


def _best_backbone(reduced: Reduced, q: list[Array]) -> Backbone:
    """The fewest slices whose rigid links reach the tip well; shorter ones than the mesh has nodes for are left out."""
    tried = [backbone_of(reduced, MOST_LINKS[0])]
    with suppress(TurgorError):
        for count in range(MOST_LINKS[0] + 1, MOST_LINKS[1] + 1):
            tried.append(backbone_of(reduced, count))
    lost = np.array([_lost(each, q) for each in tried])
    return tried[int(np.argmax(lost <= max(ENOUGH, 1.2 * lost.min())))]


def _lost(backbone: Backbone, q: list[Array]) -> float:
    """Largest distance of the tip of rigid links that turn as the slices do, over the length."""
    frames = [backbone.frames(each) for each in q]
    shape, worst = shape_of(backbone, frames, False), 0.0
    pivots = shape.pivots(backbone.base)
    for turns, places in frames:
        tip = pivots[0] + np.einsum("mab,mb->a", turns[1:-1], pivots[1:]) + turns[-1] @ shape.behind[-1]
        worst = max(worst, float(np.linalg.norm(tip - places[-1])))
    return worst / backbone.length


def _answers(chain: Chain, shape: Shape, state: TipResponse, pressed: list[int]) -> Answers:
    """Coordinates at a state, and their rates by the loads on the tip."""
    x = shape.coordinates(state.frames)
    rates = np.array([
        (shape.coordinates(moved) - x) / share for moved, share in zip(state.moved, state.share, strict=True)
    ])  # fmt: skip
    at, last = chain.placed(x), chain.links - 1
    loads = np.array([chain.work(at, last, chain.tip(at), load.force, load.moment) for load in state.loads])
    heavier = [
        (chain.weight(chain.placed(x + share * rate)) - chain.weight(at)) / share
        for rate, share in zip(rates, state.share, strict=True)
    ]
    bends = [kind for kind in shape.kinds if kind != SLIDE]
    own = [len(bends) if kind == SLIDE else bends.index(kind) for kind in shape.kinds]
    return Answers(x, state.answer.inputs[pressed], rates, loads + np.array(heavier), np.tile(own, chain.links))


def _rates(backbone: Backbone, shape: Shape, state: TipResponse) -> Array:
    """Rates (d, n) of the coordinates by the inputs."""
    answer, columns = state.answer, []
    q, box = answer.q, answer.reduced.inputs
    for rate, size in zip(answer.rates[: len(q)].T, box.high - box.low, strict=True):
        step = 1e-4 * size
        ends = [shape.coordinates(backbone.frames(q + sign * step * rate)) for sign in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2 * step))
    return np.array(columns).T


def _solved(chain: Chain, pressures: Array) -> Array:
    """Equilibrium by steps where one is too long."""
    x = np.zeros(len(chain.springs))
    for count in (1, 4, 16):
        try:
            for share in np.arange(1, count + 1) / count:
                x = chain.equilibrium(share * pressures, x)
            return x
        except NotSolved:
            x = np.zeros(len(chain.springs))
    return chain.equilibrium(pressures)


def _stiffness_error(chain: Chain, known: tuple[Answers, ...]) -> float:
    """Largest error of the turn of the tip under its moments, over this turn."""
    worst = 0.0
    for each in known:
        tangent = chain.tangent(each.x, each.pressures)
        for rate, load in zip(each.rates[:-1], each.loads[:-1], strict=True):
            made = np.linalg.solve(tangent, load)
            worst = max(worst, abs(load @ made / (load @ rate) - 1))
    return worst
