"""URDF: a chain as a robot description of ROS, in SI units with x forward and z up (REP 103)."""

from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np

from turgor.foundation.store.atomic_files import whole
from turgor.systems.robots.backbone import Array
from turgor.systems.robots.chains.chain import SLIDE, Chain
from turgor.systems.robots.chains.chain_of import FittedChain
from turgor.systems.robots.chains.mjcf import COORDINATES, numbers

#: Mass [kg] and inertia [kg m²] of a body between two coordinates of one joint, which programs want to be positive.
BETWEEN = 1e-6, 1e-10

#: The largest speed of a coordinate: its range in this time [s].
FASTEST = 0.05


def write_urdf(fitted: FittedChain, path: str | Path, *, damping_time: float = 0.05) -> Path:
    """Write a chain as URDF.

    URDF has no springs and no pressures. A comment at each joint states its spring and its gains; ``limit`` has the
    range that was trained with half as much more, and the largest torque of the spring there; ``dynamics`` the damping.

    Parameters
    ----------
    fitted : FittedChain
        From `chain_of`.
    path : str or Path
        The file, such as ``finger.urdf``.
    damping_time : float [s]
        Damping over the stiffness at rest.

    Returns
    -------
    Path
    """
    root = robot_element(fitted.chain, fitted.reduced.model.mesh.name, damping_time)
    text = f"Chain of rigid links made by turgor. {fitted.text[0].upper()}{fitted.text[1:]}.".replace("--", "-")
    root.insert(0, Xml.Comment(f" {text} Springs (N m, N) and gains (m3 by coordinate) stand at the joints. "))
    Xml.indent(root)
    file = Path(path)
    with whole(file) as part:
        part.write_text('<?xml version="1.0"?>\n' + Xml.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    return file


def robot_element(chain: Chain, name: str, damping_time: float) -> Xml.Element:
    """Return a chain as the element ``robot``."""
    root = Xml.Element("robot", name="".join(c if c.isalnum() else "_" for c in name))
    Xml.SubElement(root, "link", name="base")
    parent, count = "base", len(chain.kinds)
    for link in range(chain.links):
        for place, kind in enumerate(chain.kinds):
            last = place == count - 1
            child = f"link_{link + 1}" if last else f"link_{link + 1}_{COORDINATES[kind]}"
            pivot = chain.pivots[link] if place == 0 else np.zeros(3)
            _add_joint(root, chain, (link * count + place, kind), (parent, child, pivot), damping_time)
            body = Xml.SubElement(root, "link", name=child)
            if last:
                _fill(body, chain, link)
            else:
                _add_inertia(body, BETWEEN[0], np.zeros(3), np.full(3, BETWEEN[1]))
            parent = child
    joint = Xml.SubElement(root, "joint", name="tip_joint", type="fixed")
    Xml.SubElement(joint, "parent", link=parent)
    Xml.SubElement(joint, "child", link="tip")
    Xml.SubElement(joint, "origin", xyz=numbers(chain.end), rpy="0 0 0")
    Xml.SubElement(root, "link", name="tip")
    return root


def _add_joint(
    root: Xml.Element, chain: Chain, which: tuple[int, int], ends: tuple[str, str, Array], damping_time: float
) -> None:
    """Add a coordinate as a joint from one link to another."""
    k, kind = which
    gains = "; ".join(f"{name} {numbers(chain.gains[p, k])}" for p, name in enumerate(chain.names))
    root.append(Xml.Comment(f" spring {numbers(chain.springs[k])}; gain of {gains} "))
    joint = Xml.SubElement(
        root, "joint", name=f"{COORDINATES[kind]}_{k // len(chain.kinds) + 1}",
        type="prismatic" if kind == SLIDE else "revolute",
    )  # fmt: skip
    Xml.SubElement(joint, "parent", link=ends[0])
    Xml.SubElement(joint, "child", link=ends[1])
    Xml.SubElement(joint, "origin", xyz=numbers(ends[2]), rpy="0 0 0")
    Xml.SubElement(joint, "axis", xyz=numbers(np.eye(3)[kind]))
    low, high = chain.limits[k]
    most = max(abs(x * (chain.springs[k] @ [1, x, x**2])) for x in (low, high))
    Xml.SubElement(
        joint, "limit", lower=numbers(low), upper=numbers(high), effort=numbers(most),
        velocity=numbers((high - low) / FASTEST),
    )  # fmt: skip
    Xml.SubElement(joint, "dynamics", damping=numbers(damping_time * chain.springs[k, 0]), friction="0")


def _fill(body: Xml.Element, chain: Chain, link: int) -> None:
    """Give a link its inertia, and its capsule as a cylinder."""
    _add_inertia(body, chain.masses[link], chain.centers[link], chain.inertias[link])
    first, last, radius = chain.capsules[link, :3], chain.capsules[link, 3:6], chain.capsules[link, 6]
    for name in ("visual", "collision"):
        part = Xml.SubElement(body, name)
        Xml.SubElement(part, "origin", xyz=numbers((first + last) / 2), rpy=numbers([0, np.pi / 2, 0]))
        size = float(np.linalg.norm(last - first))
        shape = Xml.SubElement(part, "geometry")
        Xml.SubElement(shape, "cylinder", radius=numbers(radius), length=numbers(max(size, 1e-4)))


def _add_inertia(body: Xml.Element, mass: float, center: Array, inertia: Array) -> None:
    part = Xml.SubElement(body, "inertial")
    Xml.SubElement(part, "origin", xyz=numbers(center), rpy="0 0 0")
    Xml.SubElement(part, "mass", value=numbers(mass))
    ixx, iyy, izz = (numbers(value) for value in inertia)
    Xml.SubElement(part, "inertia", ixx=ixx, iyy=iyy, izz=izz, ixy="0", ixz="0", iyz="0")
