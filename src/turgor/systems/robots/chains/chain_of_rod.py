"""Chain of a rod: each piece turns and stretches in one joint at its middle, as the section says."""

from dataclasses import dataclass

import numpy as np

from turgor.fast_models.rod.loads import ChamberPressure, PlateForce
from turgor.fast_models.rod.model import Rod, RodModel
from turgor.fast_models.rod.path import static
from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError
from turgor.systems.robots.backbone import Array
from turgor.systems.robots.chains.chain import SLIDE, TURN_Y, TURN_Z, Chain, TipForce

#: Strains that the joints have, in their order: curvature about y and z, stretch.
JOINTS = (4, 5, 0)

#: Largest coupling of these strains over the geometric mean of their stiffnesses.
COUPLED = 1e-6

#: Range of a turn [rad], and of a stretch over the length of a piece.
TURN, STRETCH = 1.5, 0.9

#: Tip force of the comparison with the rod, over that which bends it to half its length in the linear theory.
PUSHED = 0.3


@dataclass(frozen=True, eq=False)
class RodChain(Shown):
    """A chain, and how far it is from its rod.

    Parameters
    ----------
    rod : Rod
    chain : Chain
    tips, wanted : (k, 3) arrays [m]
        The tip of the chain and that of the rod at full pressure of each chamber, and with a force across.
    """

    rod: Rod
    chain: Chain
    tips: Array
    wanted: Array

    def __repr__(self) -> str:
        return f"RodChain({self.chain!r}; {self.text})"

    @property
    def error(self) -> float:
        """Largest distance of the tip from that of the rod, over the length."""
        return float(np.linalg.norm(self.tips - self.wanted, axis=1).max()) / self.rod.length

    @property
    def text(self) -> str:
        """What is known of its errors, in one sentence."""
        return (
            f"tip within {100 * self.error:.2g} % of the length of the rod, at full pressure and with a force across; "
            "how far the rod is from finite elements is not measured here"
        )


def chain_of_rod(rod: Rod, links: int = 12, *, pressure: float = 100e3) -> RodChain:
    """Make a chain of rigid links of a rod, and compare it with the rod.

    Shear and twist are left out; the stiffness of the other strains is that of the section where these are free.

    Parameters
    ----------
    rod : Rod
        Straight at rest, of a section whose stretch and curvatures are not coupled.
    links : int
        The error falls in proportion to their number, because a joint stretches after its turn.
    pressure : float [Pa]
        Largest pressure of its chambers.

    Returns
    -------
    RodChain

    Raises
    ------
    TurgorError
        If the rod is bent at rest, its section is coupled, a chamber has a table, or there are no links.

    Examples
    --------
    >>> from turgor.fast_models.rod.sections.section import RodSection
    >>> rod = Rod(section=RodSection.from_moduli(EA=100.0, GA=30.0, EI=1e-3, GJ=7e-4), length=0.1)
    >>> chain_of_rod(rod, 4).chain.springs[:, 0].tolist()[:3]
    [0.04, 0.04, 4000.0]
    """
    if links < 1 or not pressure > 0:
        raise TurgorError(f"a chain of {links} links up to {pressure:g} Pa; at least 1 and above 0 are needed.")
    if any(rod.rest_strain):
        raise TurgorError(f"rod '{rod.name}' is bent at rest, {tuple(rod.rest_strain)}; a chain of it needs zeros.")
    piece = rod.length / links
    springs = np.zeros((3 * links, 3))
    springs[:, 0] = np.tile(_stiffness(rod) / piece, links)
    names, gains = _gains(rod)
    pivots = np.tile([piece, 0.0, 0.0], (links, 1))
    pivots[0, 0] = piece / 2
    chain = Chain(
        base=np.zeros(3), pivots=pivots, end=np.array([piece / 2, 0.0, 0.0]), kinds=(TURN_Y, TURN_Z, SLIDE),
        springs=springs, gains=np.tile(gains, links), growth=np.zeros(len(names)), gravity=np.zeros(3), names=names,
        limits=np.tile([[-TURN, TURN], [-TURN, TURN], [-STRETCH * piece, STRETCH * piece]], (links, 1)),
        high=np.full(len(names), pressure), low=np.zeros(len(names)), **_bodies(rod, links),
    )  # fmt: skip
    return RodChain(rod, chain, *_compared(rod, chain))


def _stiffness(rod: Rod) -> Array:
    """Stiffness (3,) [N m², N m², N] against curvature about y and z and stretch, where shear and twist are free."""
    matrix = np.linalg.inv(np.linalg.inv(np.asarray(rod.section.stiffness))[np.ix_(JOINTS, JOINTS)])
    size = np.sqrt(matrix.diagonal())
    coupling = np.abs(matrix / np.outer(size, size) - np.eye(3)).max()
    if coupling > COUPLED:
        raise TurgorError(
            f"the section of rod '{rod.name}' couples stretch and curvatures, {coupling:.2g} of their stiffness; a "
            "joint of a chain has a spring for each: put the axis where they are not coupled."
        )
    return np.asarray(matrix.diagonal())


def _gains(rod: Rod) -> tuple[tuple[str, ...], Array]:
    """Names of the chambers, and what each sweeps (p, 3) by a turn about y and z and a stretch of a piece."""
    for chamber in rod.section.chambers:
        if chamber.table is not None:
            raise TurgorError(f"chamber '{chamber.name}' of rod '{rod.name}' has a table; a chain of it needs an area.")
    names = tuple(chamber.name for chamber in rod.section.chambers)
    return names, np.array([chamber.wrench_by_pressure[list(JOINTS)] for chamber in rod.section.chambers]).reshape(
        -1, 3
    )


def _bodies(rod: Rod, links: int) -> dict[str, Array]:
    """Masses, centers, inertias and capsules of the links: each goes from its joint to the next one, or to the tip."""
    section, piece = rod.section, rod.length / links
    lengths = np.full(links, piece)
    lengths[-1] = piece / 2
    masses = (section.mass_per_length or 0.0) * lengths
    rotary = np.outer(lengths, section.rotary_inertia or np.zeros(3))
    inertias = rotary + (masses * lengths**2 / 12)[:, None] * np.array([0.0, 1.0, 1.0])
    centers, ends = np.zeros((links, 3)), np.zeros((links, 3))
    centers[:, 0], ends[:, 0] = lengths / 2, lengths
    capsules = np.hstack([np.zeros((links, 3)), ends, np.full((links, 1), section.contact_radius)])
    return {"masses": masses, "centers": centers, "inertias": inertias, "capsules": capsules}


def _compared(rod: Rod, chain: Chain) -> tuple[Array, Array]:
    """Tips (k, 3) [m] of the chain and of the rod, at full pressure of each chamber and with a force across."""
    rest, tips, wanted = np.zeros(len(chain.springs)), [], []
    for place, name in enumerate(chain.names):
        pressures = np.where(np.arange(len(chain.names)) == place, chain.high, 0.0)
        tips.append(chain.tip(chain.placed(chain.equilibrium(pressures, rest))))
        wanted.append(_tip(rod, ChamberPressure(pressure=float(chain.high[place]), chamber=name)))
    force = np.array([0.0, 0.0, -PUSHED * 1.5 * _stiffness(rod)[0] / rod.length**2])
    tips.append(chain.tip(chain.placed(chain.equilibrium(np.zeros(len(chain.names)), rest, TipForce(force)))))
    wanted.append(_tip(rod, PlateForce(force=tuple(force.tolist()))))
    return np.array(tips), np.array(wanted)


def _tip(rod: Rod, load: ChamberPressure | PlateForce) -> Array:
    return np.asarray(static(RodModel(rods=[rod], loads=[load])).tip[-1])
