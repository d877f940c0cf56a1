"""History: what a network did over time."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.systems.air.equations import Equations
from turgor.systems.air.nodes import Chamber
from turgor.systems.air.volumes.curve import VolumeCurve

if TYPE_CHECKING:
    from turgor.reduced.states.following import Followed

Array = NDArray[np.float64]

#: Columns of a table that say how an actuator is bent.
SHAPES = ("bending_angle", "twist_angle", "curvature_y", "curvature_z", "twist", "stretch", "tip_displacement")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class History(Shown):
    """States of a network over time.

    Parameters
    ----------
    equations : Equations
        What was integrated.
    time : (n,) array [s]
    unknowns : (n, m) array
        Of the equations.
    evaluations : int
        How often rates were computed.
    motions : mapping of str to Followed
        States, velocities and energies of actuators in motion, by the nodes that are their chambers.
    """

    equations: Equations
    time: Array
    unknowns: Array
    evaluations: int
    motions: Mapping[str, "Followed"] = field(default_factory=dict)

    def __repr__(self) -> str:
        nodes, parts = ", ".join(self.equations.names), ", ".join(self.equations.part_names)
        return f"History({self.time[-1]:.4g} s, {len(self.time)} states; {nodes}; {parts})"

    def _node(self, name: str) -> int:
        if name not in self.equations.names:
            raise unknown("node", name, self.equations.names)
        return self.equations.names.index(name)

    def _rows(self) -> list[tuple[float, list[float]]]:
        return list(zip(self.time.tolist(), self.unknowns.tolist(), strict=True))

    def pressure(self, name: str) -> Array:
        """Gauge pressure (n,) [Pa] of a node."""
        node, ambient = self._node(name), self.equations.around.ambient
        return np.array([self.equations.ports(time, y)[node][0] - ambient for time, y in self._rows()])

    def temperature(self, name: str) -> Array:
        """Temperature (n,) [K] of a node."""
        node = self._node(name)
        return np.array([self.equations.ports(time, y)[node][1] for time, y in self._rows()])

    def volume(self, name: str) -> Array:
        """Volume (n,) [m³] of a chamber, without that of tubes that end there."""
        node = self._node(name)
        return np.array(
            [self.equations.read(lambda store, own: store.volumes(t, own), y)[node] for t, y in self._rows()]  # noqa: B023
        )

    def mass(self, name: str) -> Array:
        """Mass (n,) [kg] of the fluid in a chamber, with tubes; of a supply, what it has received."""
        node = self._node(name)
        return np.array([self.equations.read(lambda store, own: store.masses(own), y)[node] for _, y in self._rows()])

    def received(self, name: str) -> Array:
        """Mass (n,) [kg] that a node has received since the start."""
        return np.asarray(self.unknowns[:, self.equations.mass_place[self._node(name)]])

    def flow(self, name: str) -> Array:
        """Mass flow (n,) [kg/s] of a part from its start to its end; of a valve of two ways, that of one of them."""
        if name not in self.equations.part_names:
            raise unknown("part", name, self.equations.part_names)
        place = self.equations.part_names.index(name)
        return np.array([self.equations.flows(time, y)[place] for time, y in self._rows()])

    def measure(self, node: str, name: str) -> Array:
        """Measure (n,) of an actuator, such as its ``bending_angle``, from the response that is its table."""
        law = getattr(self.equations.network.all_nodes[self.equations.names[self._node(node)]], "volume", None)
        if not isinstance(law, VolumeCurve):
            raise TurgorError(f"node '{node}' has no table of measures; a `VolumeCurve.of_response` is needed.")
        return law.measure(name, self.volume(node))

    def _shapes(self, node: str) -> list[Column]:
        """Columns of the shape of an actuator."""
        if node in self.motions:
            return [Column(f"tip_displacement_{node}", "mm", np.linalg.norm(self.motions[node].tip, axis=1))]
        law = getattr(self.equations.network.all_nodes[node], "volume", None)
        table = law.table if isinstance(law, VolumeCurve) else None
        if table is None:
            return []
        columns = [table.find(name) for name in SHAPES if name in table]
        return [Column(f"{each.name}_{node}", each.unit, self.measure(node, each.name)) for each in columns]

    def balance(self) -> float:
        """Largest error of the balance of mass, over the largest mass that a node received."""
        places = list(self.equations.mass_place.values())
        moved = float(np.abs(self.unknowns[:, places]).max())
        return float(np.abs(self.unknowns[:, places].sum(axis=1)).max()) / moved if moved else 0.0

    def response(self, name: str = "") -> Response:
        """Return it as columns: time, gauge pressures, volumes and temperatures that change, shapes, flows.

        Shapes are bending angle, twist and displacement of the tip, where a response is the table of a chamber.

        Flows are volumes at 100 kPa and 20 °C, as data sheets state them; those of liquids at the pressure around.

        Parameters
        ----------
        name : str
            Where it comes from.
        """
        eq, around = self.equations, self.equations.around
        nodes = eq.network.all_nodes
        rows = self._rows()
        ports = np.array([eq.ports(time, y) for time, y in rows])
        flows = np.array([eq.flows(time, y) for time, y in rows]) / around.fluid.reference_density
        volumes = np.array([eq.read(lambda store, own: store.volumes(t, own), y) for t, y in rows])  # noqa: B023
        columns = [Column("time", "s", self.time)]
        shown = [n for n, each in enumerate(eq.names) if each in eq.network.nodes or each == "ambient"]
        shown = [n for n in shown if eq.names[n] != "ambient"]
        columns += [Column(f"pressure_{eq.names[n]}", "kPa", ports[:, n, 0] - around.ambient) for n in shown]
        for n in shown:
            if isinstance(nodes[eq.names[n]], Chamber) and np.ptp(volumes[:, n]) > 0:
                columns.append(Column(f"volume_{eq.names[n]}", "mL", volumes[:, n]))
        for n in shown:
            if isinstance(nodes[eq.names[n]], Chamber) and np.ptp(ports[:, n, 1]) > 1e-9:
                columns.append(Column(f"temperature_{eq.names[n]}", "K", ports[:, n, 1]))
        columns += [each for n in shown for each in self._shapes(eq.names[n])]
        for n, part in enumerate(eq.part_names):
            if "_part_" not in part:
                columns.append(Column(f"flow_{part}", "L/min", flows[:, n]))
        return Response(columns=tuple(columns), source=Source(text=f"a network of {around.fluid.name}", detail=name))

    def plot(self) -> Any:
        """Draw pressures, flows and volumes against time; the figure is that of matplotlib."""
        from turgor.views.plots.systems.air_plot import air_figure  # few need it

        return air_figure(self.response())
