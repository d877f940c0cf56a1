"""Air and liquid: supplies, valves, tubes and chambers of an actuator, and what they do over time."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.systems.air.driven import driven as driven
    from turgor.systems.air.file.keys import AirKey as AirKey
    from turgor.systems.air.file.keys import AirTable as AirTable
    from turgor.systems.air.file.keys import file_tables as file_tables
    from turgor.systems.air.file.read import AirFile as AirFile
    from turgor.systems.air.file.read import read_air as read_air
    from turgor.systems.air.fluids import AIR as AIR
    from turgor.systems.air.fluids import FLUIDS as FLUIDS
    from turgor.systems.air.fluids import WATER as WATER
    from turgor.systems.air.fluids import Gas as Gas
    from turgor.systems.air.fluids import Liquid as Liquid
    from turgor.systems.air.history import History as History
    from turgor.systems.air.network import Network as Network
    from turgor.systems.air.nodes import Chamber as Chamber
    from turgor.systems.air.nodes import Supply as Supply
    from turgor.systems.air.nodes import junction as junction
    from turgor.systems.air.nodes import syringe as syringe
    from turgor.systems.air.parts.connection import CheckValve as CheckValve
    from turgor.systems.air.parts.connection import Connection as Connection
    from turgor.systems.air.parts.connection import leak as leak
    from turgor.systems.air.parts.long_line import LongLine as LongLine
    from turgor.systems.air.parts.long_line import speed_of_sound as speed_of_sound
    from turgor.systems.air.parts.part import Part as Part
    from turgor.systems.air.parts.passages import Leakage as Leakage
    from turgor.systems.air.parts.passages import Orifice as Orifice
    from turgor.systems.air.parts.passages import Restriction as Restriction
    from turgor.systems.air.parts.passages import Tubing as Tubing
    from turgor.systems.air.parts.pumps import FlowSource as FlowSource
    from turgor.systems.air.parts.pumps import Pump as Pump
    from turgor.systems.air.parts.regulator import Regulator as Regulator
    from turgor.systems.air.parts.valves import OnOffValve as OnOffValve
    from turgor.systems.air.parts.valves import ProportionalValve as ProportionalValve
    from turgor.systems.air.parts.valves import ThreeWayValve as ThreeWayValve
    from turgor.systems.air.performance import Performance as Performance
    from turgor.systems.air.performance import Wider as Wider
    from turgor.systems.air.performance import performance as performance
    from turgor.systems.air.signals import Pwm as Pwm
    from turgor.systems.air.signals import Signal as Signal
    from turgor.systems.air.signals import Sine as Sine
    from turgor.systems.air.simulate import simulate as simulate
    from turgor.systems.air.volumes.coupled import Coupled as Coupled
    from turgor.systems.air.volumes.curve import VolumeCurve as VolumeCurve
    from turgor.systems.air.volumes.moving import MovingActuator as MovingActuator
    from turgor.systems.air.volumes.rigid import Rigid as Rigid
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
