"""MJCF: a chain as a model of MuJoCo, with pressures as controls and the mesh as skin."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from turgor.core.meshing.exchange.formats.write_stl import closed_surface
from turgor.core.model.obstacles.rigid_shape import RigidShape
from turgor.foundation.errors import TurgorError
from turgor.foundation.registry import name_in
from turgor.foundation.store.atomic_files import whole
from turgor.job.tables.obstacles import SHAPES
from turgor.systems.robots.chains.chain import SLIDE, Chain
from turgor.systems.robots.chains.chain_of import FittedChain

#: Names of the coordinates of a joint.
COORDINATES = {1: "bend_y", 2: "bend_z", SLIDE: "stretch"}


@dataclass(frozen=True, slots=True)
class MjcfSettings:
    """Settings of models of MuJoCo.

    Parameters
    ----------
    endless : float [m]
        Half of the length of a cylinder without ends: MuJoCo has none, and no arm is nearly as long.
    """

    endless: float = 1.0


MJCF = MjcfSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class MjcfOptions:
    """How a chain moves in MuJoCo.

    Parameters
    ----------
    step : float [s]
        Time step.
    damping_time : float [s]
        Damping of a joint over its stiffness at rest: a mode of angular frequency ω has the damping ratio ω times half
        of it. At least half of the time step, for then no stiff joint can make the motion unstable.
    skin : bool
        Whether the surface of the mesh is written as skin.

    Examples
    --------
    >>> MjcfOptions(step=0.001).damping_time
    0.05
    """

    step: float = 0.002
    damping_time: float = 0.05
    skin: bool = True

    def __post_init__(self) -> None:
        if not 0 < self.step <= 0.1:
            raise TurgorError(f"step is {self.step:g} s; allowed is more than 0 s to 0.1 s.")
        if not 0.5 * self.step <= self.damping_time <= 10:
            raise TurgorError(
                f"damping_time is {self.damping_time:g} s; allowed is half of the step, {0.5 * self.step:g} s, to 10 s."
            )


def write_mjcf(fitted: FittedChain, path: str | Path, options: MjcfOptions | None = None) -> Path:
    """Write a chain as a model of MuJoCo (MJCF), for version 3.5 or later.

    Controls are gauge pressures in Pa. x points from the base to the tip, z up, as in the mesh. The error stands in a
    comment, and as ``custom/numeric`` named ``tip_error_over_length``.

    Parameters
    ----------
    fitted : FittedChain
        From `chain_of`.
    path : str or Path
        The file, such as ``finger.xml``.
    options : MjcfOptions, optional

    Returns
    -------
    Path
    """
    chosen = options or MjcfOptions()
    root = chain_element(fitted.chain, fitted.reduced.model.mesh.name, chosen)
    root.insert(0, Xml.Comment(f" {_comment(fitted)} "))
    custom = Xml.SubElement(root, "custom")
    Xml.SubElement(custom, "numeric", name="tip_error_over_length", data=numbers(fitted.error))
    Xml.SubElement(custom, "numeric", name="tip_stiffness_error", data=numbers(fitted.stiffness_error))
    Xml.SubElement(custom, "text", name="error", data=fitted.text)
    if chosen.skin:
        _add_skin(root, fitted)
    file = Path(path)
    with whole(file) as part:
        part.write_text(text_of(root), encoding="utf-8")
    return file


def write_mechanism(
    chains: Mapping[str, Chain], shape: RigidShape | None, path: str | Path, *, name: str = "robot"
) -> Path:
    """Write chains by the names of their arms, and an object that does not move, as a model of MuJoCo.

    Parameters
    ----------
    chains : mapping of str to Chain
        As the states of a `Mechanism` have them.
    shape : RigidShape or None
        A sphere, plane, cylinder or box. Rounded edges of a box become sharp, at the same faces, and a comment says
        so; surfaces of triangles are left out, and a comment says so.
    path : str or Path
    name : str
    """
    root = chains_element({f"{arm}_": chain for arm, chain in chains.items()}, name, MjcfOptions(skin=False))
    if shape is not None:
        world = root.find("worldbody")
        assert world is not None
        _add_object(world, shape)
    file = Path(path)
    with whole(file) as part:
        part.write_text(text_of(root), encoding="utf-8")
    return file


def _add_object(world: Xml.Element, shape: RigidShape) -> None:
    """Add an object to the element ``worldbody``; what MuJoCo has no geometry for is a comment."""
    given: Any = shape
    match name_in(SHAPES, shape):
        case "sphere":
            geometry = {"type": "sphere", "size": numbers(given.radius), "pos": numbers(given.center)}
        case "plane":  # sizes of 0: without end
            geometry = {"type": "plane", "size": "0 0 0.01", "pos": numbers(given.point)}
            geometry["zaxis"] = numbers(given.normal)
        case "cylinder":
            half = MJCF.endless if given.length is None else given.length / 2
            geometry = {"type": "cylinder", "size": numbers([given.radius, half]), "pos": numbers(given.center)}
            geometry["zaxis"] = numbers(given.axis)
        case "box":
            if given.rounding:
                world.append(Xml.Comment(f" the edges of the object are sharp here: {shape.text()} "))
            half_sizes = [length / 2 for length in given.size]
            geometry = {"type": "box", "size": numbers(half_sizes), "pos": numbers(given.center)}
        case _:
            world.append(Xml.Comment(f" the object is left out: {shape.text()} "))
            return
    Xml.SubElement(world, "geom", {"name": "object", **geometry})


def chain_element(chain: Chain, name: str, options: MjcfOptions) -> Xml.Element:
    """Return a chain as the element ``mujoco``."""
    return chains_element({"": chain}, name, options)


def chains_element(chains: Mapping[str, Chain], name: str, options: MjcfOptions) -> Xml.Element:
    """Return chains, by what their names begin with, as the element ``mujoco``."""
    root = Xml.Element("mujoco", model=name)
    Xml.SubElement(root, "compiler", angle="radian", autolimits="true")
    gravity = next(iter(chains.values())).gravity
    Xml.SubElement(root, "option", timestep=numbers(options.step), integrator="implicitfast", gravity=numbers(gravity))
    world = Xml.SubElement(root, "worldbody")
    parts = [Xml.SubElement(root, part) for part in ("tendon", "actuator", "sensor")]
    for prefix, chain in chains.items():
        _add_links(Xml.SubElement(world, "body", name=f"{prefix}base"), chain, options, prefix)
        _add_pressures(parts, chain, prefix)
    return root


def text_of(root: Xml.Element) -> str:
    """Return an element as the text of a file."""
    Xml.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + Xml.tostring(root, encoding="unicode") + "\n"


def _comment(fitted: FittedChain) -> str:
    text = (
        f"Chain of rigid links made by turgor. {fitted.text[0].upper()}{fitted.text[1:]}. Controls are gauge pressures "
        "in Pa. A pressure does the work p dV, V = L + growth L^2 / 2, L the length of its tendon in m3. Left out: "
        "twist, stiffness against shear, and what loads other than those on the tip do to the section."
    )
    return text.replace("--", "-")


def _add_links(base: Xml.Element, chain: Chain, options: MjcfOptions, prefix: str) -> None:
    """Nest the links, each with its joints, inertia and capsule."""
    parent, count = base, len(chain.kinds)
    for link in range(chain.links):
        parent = Xml.SubElement(parent, "body", name=f"{prefix}link_{link + 1}", pos=numbers(chain.pivots[link]))
        if chain.rolls is not None:
            x, y, z, w = Rotation.from_matrix(chain.rolls[link]).as_quat()
            parent.set("quat", numbers([w, x, y, z]))
        for place, kind in enumerate(chain.kinds):
            k = link * count + place
            name, motion = f"{prefix}{COORDINATES[kind]}_{link + 1}", "slide" if kind == SLIDE else "hinge"
            Xml.SubElement(
                parent, "joint", name=name, type=motion,
                axis=numbers(np.eye(3)[kind]), stiffness=numbers(chain.springs[k]), range=numbers(chain.limits[k]),
                damping=numbers(options.damping_time * chain.springs[k, 0]),
            )  # fmt: skip
        Xml.SubElement(
            parent, "inertial", pos=numbers(chain.centers[link]), mass=numbers(chain.masses[link]),
            diaginertia=numbers(chain.inertias[link]),
        )  # fmt: skip
        # links touch what is around them, not each other: walls that meet are in the springs
        Xml.SubElement(
            parent, "geom", name=f"{prefix}capsule_{link + 1}", type="capsule",
            fromto=numbers(chain.capsules[link, :6]), size=numbers(chain.capsules[link, 6]),
            contype="0", conaffinity="1", group="3",
        )  # fmt: skip
    Xml.SubElement(parent, "site", name=f"{prefix}tip", pos=numbers(chain.end), size="0.001")


def _add_pressures(parts: list[Xml.Element], chain: Chain, prefix: str) -> None:
    """A tendon for each pressure, whose length is the swept volume, and an actuator that pulls at it."""
    tendons, actuators, sensors = parts
    names = [f"{prefix}{COORDINATES[kind]}_{link + 1}" for link in range(chain.links) for kind in chain.kinds]
    for place, pressure in enumerate(pressure_names(chain)):
        name = prefix + pressure
        tendon = Xml.SubElement(tendons, "fixed", name=f"{name}_swept")
        for joint, gain in zip(names, chain.gains[place], strict=True):
            if gain:
                Xml.SubElement(tendon, "joint", joint=joint, coef=numbers(gain))
        Xml.SubElement(
            actuators, "general", name=name, tendon=f"{name}_swept", gaintype="affine", biastype="none",
            gainprm=numbers([1.0, chain.growth[place], 0.0]),
            ctrlrange=numbers([chain.low[place], chain.high[place]]),
        )  # fmt: skip
    Xml.SubElement(sensors, "framepos", name=f"{prefix}tip_place", objtype="site", objname=f"{prefix}tip")
    Xml.SubElement(sensors, "framequat", name=f"{prefix}tip_turn", objtype="site", objname=f"{prefix}tip")


def pressure_names(chain: Chain) -> list[str]:
    """Names of the pressures without points."""
    return [name.replace(".", "_") for name in chain.names]


def _add_skin(root: Xml.Element, fitted: FittedChain) -> None:
    """The surface of the whole actuator; each vertex follows the two links between whose middles it lies."""
    surface, chain = closed_surface(fitted.reduced.model.mesh), fitted.chain
    used, faces = np.unique(surface.triangles, return_inverse=True)
    points = surface.points[used]
    skin = Xml.SubElement(
        Xml.SubElement(root, "deformable"), "skin", name="body", rgba="0.85 0.8 0.7 1",
        vertex=numbers(points), face=" ".join(map(str, faces.ravel())),
    )  # fmt: skip
    origins = np.cumsum(chain.pivots, axis=0)
    ends = np.append(origins[:, 0], origins[-1, 0] + chain.end[0])
    middles = np.concatenate([[points[:, 0].min()], (ends[:-1] + ends[1:]) / 2])
    place = np.interp(points[:, 0], middles, np.arange(len(middles)))
    for bone, origin in enumerate([np.zeros(3), *origins]):
        share = np.maximum(0.0, 1.0 - np.abs(place - bone))
        near = np.flatnonzero(share > 0)
        if len(near):
            Xml.SubElement(
                skin, "bone", body="base" if bone == 0 else f"link_{bone}", bindpos=numbers(origin),
                bindquat="1 0 0 0", vertid=" ".join(map(str, near)), vertweight=numbers(share[near]),
            )  # fmt: skip


def numbers(values: ArrayLike) -> str:
    """Write numbers with blanks between them."""
    return " ".join(f"{number:.9g}" for number in np.asarray(values, dtype=np.float64).ravel())
