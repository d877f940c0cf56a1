"""Laws of materials: strain energies, viscoelasticity and softening, their curves, and the library of records."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.materials.history.softening import Mullins as Mullins
    from turgor.core.materials.history.stress_history import StressHistory as StressHistory
    from turgor.core.materials.history.stress_history import stress_history as stress_history
    from turgor.core.materials.history.viscoelastic import Prony as Prony
    from turgor.core.materials.laws.common import Law as Law
    from turgor.core.materials.laws.curves import Curve as Curve
    from turgor.core.materials.laws.curves import curve as curve
    from turgor.core.materials.laws.laws import ArrudaBoyce as ArrudaBoyce
    from turgor.core.materials.laws.laws import GeneralizedRivlin as GeneralizedRivlin
    from turgor.core.materials.laws.laws import Gent as Gent
    from turgor.core.materials.laws.laws import Hooke as Hooke
    from turgor.core.materials.laws.laws import MooneyRivlin as MooneyRivlin
    from turgor.core.materials.laws.laws import NeoHooke as NeoHooke
    from turgor.core.materials.laws.laws import Ogden as Ogden
    from turgor.core.materials.laws.laws import Woven as Woven
    from turgor.core.materials.laws.laws import Yeoh as Yeoh
    from turgor.core.materials.laws.laws import YeohN as YeohN
    from turgor.core.materials.laws.stability import first_instability as first_instability
    from turgor.core.materials.laws.stability import instabilities as instabilities
    from turgor.core.materials.library.choose import choose as choose
    from turgor.core.materials.library.choose import material_rows as material_rows
    from turgor.core.materials.library.doubts import doubts_of as doubts_of
    from turgor.core.materials.library.records import library as library
    from turgor.core.materials.library.records import recommended as recommended
    from turgor.core.materials.library.records import records as records
    from turgor.foundation.source import Source as Source
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
