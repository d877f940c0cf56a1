"""Laws: each is its strain energy, written once; every stress and tangent is derived from it.

Energies are per reference volume, in the isochoric invariants Ī₁, Ī₂ or the isochoric principal stretches, which equal
I₁, I₂ and the stretches of an incompressible solid. They use only arithmetic and a logarithm that is passed in, so
NumPy arrays and SymPy symbols go through them alike. All laws may be imported from here.
"""

from typing import Any

from turgor.core.materials.laws.common import FiberLaw as FiberLaw
from turgor.core.materials.laws.common import FoamLaw as FoamLaw
from turgor.core.materials.laws.common import InvariantLaw as InvariantLaw
from turgor.core.materials.laws.common import Law as Law
from turgor.core.materials.laws.common import StretchLaw as StretchLaw
from turgor.core.materials.laws.energies.arruda_boyce import ArrudaBoyce as ArrudaBoyce
from turgor.core.materials.laws.energies.blatz_ko import BlatzKo as BlatzKo
from turgor.core.materials.laws.energies.compressible_neo_hooke import CompressibleNeoHooke as CompressibleNeoHooke
from turgor.core.materials.laws.energies.extended_tube import ExtendedTube as ExtendedTube
from turgor.core.materials.laws.energies.generalized_rivlin import GeneralizedRivlin as GeneralizedRivlin
from turgor.core.materials.laws.energies.gent import Gent as Gent
from turgor.core.materials.laws.energies.holzapfel_gasser_ogden import HolzapfelGasserOgden as HolzapfelGasserOgden
from turgor.core.materials.laws.energies.hooke import Hooke as Hooke
from turgor.core.materials.laws.energies.hyperfoam import Hyperfoam as Hyperfoam
from turgor.core.materials.laws.energies.mooney_rivlin import MooneyRivlin as MooneyRivlin
from turgor.core.materials.laws.energies.neo_hooke import NeoHooke as NeoHooke
from turgor.core.materials.laws.energies.ogden import Ogden as Ogden
from turgor.core.materials.laws.energies.orthotropic import Orthotropic as Orthotropic
from turgor.core.materials.laws.energies.woven import Woven as Woven
from turgor.core.materials.laws.energies.yeoh import Yeoh as Yeoh
from turgor.core.materials.laws.energies.yeoh_n import YeohN as YeohN
from turgor.foundation.registry import Registry, class_of_file

#: Laws by the name that files use: the classes in the folder ``energies``.
LAWS: Registry[type[Any]] = Registry(
    "turgor.core.materials.laws.energies", class_of_file(lambda kind: hasattr(kind, "shear_modulus"))
)
