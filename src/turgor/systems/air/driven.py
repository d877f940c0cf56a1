"""driven: an actuator with a supply, a valve and a tube."""

from turgor.systems.air.fluids import AIR, Fluid
from turgor.systems.air.network import AMBIENT, Network
from turgor.systems.air.nodes import Chamber, Node, Supply, Volume, junction
from turgor.systems.air.parts.connection import Connection
from turgor.systems.air.parts.part import Part
from turgor.systems.air.parts.passages import Passage, Tubing
from turgor.systems.air.parts.valves import ThreeWayValve

#: Names of the nodes and parts of `driven`.
SUPPLY, VALVE, OUTLET, TUBE, ACTUATOR = "supply", "valve", "outlet", "tube", "actuator"


def driven(
    volume: Volume,
    supply: float,
    valve: Passage,
    tube: Tubing | None = None,
    *,
    fluid: Fluid = AIR,
    process: str | float = "isothermal",
) -> Network:
    """Return a network of a supply, a 3/3 valve, a tube and the chamber of an actuator.

    Nodes are ``supply``, ``outlet`` (where there is a tube) and ``actuator``; parts are ``valve`` and ``tube``.

    Parameters
    ----------
    volume : float [m³], tg.air.VolumeCurve or Rigid
        The chamber.
    supply : float [Pa], gauge
    valve : Restriction or Orifice
        Each way of the valve, when it is open.
    tube : tg.air.Tubing, optional
        From the valve to the actuator.
    fluid : Gas or Liquid
    process : str or float
        Of the gas in the chamber, as in `Chamber`.

    Returns
    -------
    Network

    Examples
    --------
    >>> from turgor.systems.air.parts.passages import Restriction
    >>> driven(18e-6, 200e3, Restriction(conductance=1e-9), Tubing(diameter=2e-3, length=1.0))
    Network(supply, outlet, actuator, ambient; valve, tube; air)
    """
    nodes: dict[str, Node] = {SUPPLY: Supply(supply)}
    parts: dict[str, Part] = {}
    end = ACTUATOR
    if tube is not None:
        end = OUTLET
        nodes[OUTLET] = junction()
        parts[TUBE] = Connection(OUTLET, ACTUATOR, tube)
    nodes[ACTUATOR] = Chamber(volume, process=process)
    return Network(
        nodes=nodes, parts={VALVE: ThreeWayValve(SUPPLY, end, valve, 1.0, exhaust=AMBIENT), **parts}, fluid=fluid
    )
