"""Robots: tables, chains and parameters of an actuator for simulators of robots, with their errors."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.systems.robots.chains.chain import Chain as Chain
    from turgor.systems.robots.chains.chain_of import FittedChain as FittedChain
    from turgor.systems.robots.chains.chain_of import chain_of as chain_of
    from turgor.systems.robots.chains.chain_of_rod import RodChain as RodChain
    from turgor.systems.robots.chains.chain_of_rod import chain_of_rod as chain_of_rod
    from turgor.systems.robots.chains.mjcf import MjcfOptions as MjcfOptions
    from turgor.systems.robots.chains.mjcf import write_mechanism as write_mechanism
    from turgor.systems.robots.chains.mjcf import write_mjcf as write_mjcf
    from turgor.systems.robots.chains.urdf import write_urdf as write_urdf
    from turgor.systems.robots.mechanisms.mechanism import Arm as Arm
    from turgor.systems.robots.mechanisms.mechanism import ArmState as ArmState
    from turgor.systems.robots.mechanisms.mechanism import Mechanism as Mechanism
    from turgor.systems.robots.mechanisms.mechanism import Segment as Segment
    from turgor.systems.robots.mechanisms.mechanism_file import MechanismFile as MechanismFile
    from turgor.systems.robots.mechanisms.mechanism_file import read_mechanism as read_mechanism
    from turgor.systems.robots.strains import StrainSegments as StrainSegments
    from turgor.systems.robots.strains import strain_segments as strain_segments
    from turgor.systems.robots.tables.polynomial import Polynomial as Polynomial
    from turgor.systems.robots.tables.tabulate import RobotTable as RobotTable
    from turgor.systems.robots.tables.tabulate import tabulate as tabulate
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
