"""Laws of materials: strain energies, viscoelasticity and softening, their curves, and the library of records."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.materials.crack_growth import CRACK_GROWTH as CRACK_GROWTH
    from turgor.core.materials.crack_growth import CrackGrowth as CrackGrowth
    from turgor.core.materials.crack_growth import tearing_energy_of_crack as tearing_energy_of_crack
    from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce as BergstromBoyce
    from turgor.core.materials.history.permanent_set import PermanentSet as PermanentSet
    from turgor.core.materials.history.softening import Mullins as Mullins
    from turgor.core.materials.history.stress_history import StressHistory as StressHistory
    from turgor.core.materials.history.stress_history import stress_history as stress_history
    from turgor.core.materials.history.viscoelastic import Prony as Prony
    from turgor.core.materials.laws.common import Law as Law
    from turgor.core.materials.laws.curves import Curve as Curve
    from turgor.core.materials.laws.curves import curve as curve
    from turgor.core.materials.laws.laws import ArrudaBoyce as ArrudaBoyce
    from turgor.core.materials.laws.laws import BlatzKo as BlatzKo
    from turgor.core.materials.laws.laws import CompressibleNeoHooke as CompressibleNeoHooke
    from turgor.core.materials.laws.laws import ExtendedTube as ExtendedTube
    from turgor.core.materials.laws.laws import GeneralizedRivlin as GeneralizedRivlin
    from turgor.core.materials.laws.laws import Gent as Gent
    from turgor.core.materials.laws.laws import HolzapfelGasserOgden as HolzapfelGasserOgden
    from turgor.core.materials.laws.laws import Hooke as Hooke
    from turgor.core.materials.laws.laws import Hyperfoam as Hyperfoam
    from turgor.core.materials.laws.laws import MooneyRivlin as MooneyRivlin
    from turgor.core.materials.laws.laws import NeoHooke as NeoHooke
    from turgor.core.materials.laws.laws import Ogden as Ogden
    from turgor.core.materials.laws.laws import Orthotropic as Orthotropic
    from turgor.core.materials.laws.laws import Woven as Woven
    from turgor.core.materials.laws.laws import Yeoh as Yeoh
    from turgor.core.materials.laws.laws import YeohN as YeohN
    from turgor.core.materials.laws.stability import first_instability as first_instability
    from turgor.core.materials.laws.stability import instabilities as instabilities
    from turgor.core.materials.library.choose import choose as choose
    from turgor.core.materials.library.choose import material_rows as material_rows
    from turgor.core.materials.library.doubts import doubts_of as doubts_of
    from turgor.core.materials.library.record_text import library_tables as library_tables
    from turgor.core.materials.library.records import library as library
    from turgor.core.materials.library.records import recommended as recommended
    from turgor.core.materials.library.records import records as records
    from turgor.core.materials.library.spread import spread_of as spread_of
    from turgor.core.materials.orientation import Orientation as Orientation
    from turgor.core.materials.oriented import oriented_stress as oriented_stress
    from turgor.core.materials.strength import Strength as Strength
    from turgor.foundation.source import Source as Source
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
