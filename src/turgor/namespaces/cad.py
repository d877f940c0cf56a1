"""CAD files: read, looked through and named; written as STEP, and the mold to cast an actuator in."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.geometry.cad.cad_file import CadFile as CadFile
    from turgor.core.geometry.cad.inspection import Inspection as Inspection
    from turgor.core.geometry.cad.inspection import inspect_cad as inspect_cad
    from turgor.core.geometry.cad.read import read_cad as read_cad
    from turgor.core.geometry.cad.selectors import ByColor as ByColor
    from turgor.core.geometry.cad.selectors import ByName as ByName
    from turgor.core.geometry.cad.selectors import InBox as InBox
    from turgor.core.geometry.cad.selectors import NearestTo as NearestTo
    from turgor.core.geometry.cad.selectors import WithNormal as WithNormal
    from turgor.core.geometry.cad.split import SplitPlane as SplitPlane
    from turgor.core.geometry.molds.casting_mold import casting_mold as casting_mold
    from turgor.core.geometry.molds.mold import Mold as Mold
    from turgor.core.geometry.molds.mold import MoldSettings as MoldSettings
    from turgor.core.geometry.write_step import write_step as write_step
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
